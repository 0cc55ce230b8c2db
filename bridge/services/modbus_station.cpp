#include "bridge/services/modbus_station.hpp"

#include "bridge/services/modbus_service.hpp"

namespace plcgw {
namespace {

using modbus::diagnostic;
using modbus::exception_code;
using modbus::function;
using plc::modbus_error;

constexpr std::uint8_t line_feed = 0x0A;

modbus_error error_of(errc why)
{
    switch (why) {
    case errc::overlong: return modbus_error::character_overrun;
    case errc::bad_character: return modbus_error::unconvertible_character;
    case errc::collision: return modbus_error::bit_level;
    default: return modbus_error::checksum;  // also too short, and broken off
    }
}

std::uint8_t send_event(exception_code e)
{
    const bool abort = e == exception_code::server_device_failure;
    return static_cast<std::uint8_t>(event::sent | (abort ? event::sent_abort : event::sent_read_exception));
}

// Requests about memory go to the PLC, the others are answered from the station's own state.
struct server {
    plc::simulated_plc& plc;
    diagnosed state;

    template <class Request>
    modbus::response operator()(const Request& r) const
    {
        if constexpr (requires { serve(state, r); })
            return serve(state, r);
        else
            return serve(plc, modbus::request{r});
    }
};

// Fetching the event counter or the log is no event (6.4, in the words of the Chinese edition).
bool is_event(const modbus::request& r)
{
    const function f = modbus::function_of(r);
    return f != function::get_comm_event_counter && f != function::get_comm_event_log;
}

// "Restart is performed after returning the response" (7.11.2), "after response" the delimiter changes (9.1).
bool waits_for_reply(diagnostic what)
{
    return what == diagnostic::restart_communications || what == diagnostic::change_ascii_delimiter;
}

void store(plc::memory& in, std::optional<plc::place> first, std::span<const std::uint16_t> values)
{
    for (std::size_t i = 0; first && i < values.size(); ++i)
        in.set_word({first->area, first->bit + 16 * i}, values[i]);
}

}  // namespace

modbus_station::modbus_station(plc::simulated_plc& plc, modbus::unit_id unit, unsigned channel)
    : plc_(&plc), unit_(unit), channel_(channel), delimiter_(line_feed), power_ons_(plc.power_ons()),
      starts_(plc.starts())
{
    plc.attach(channel, plc::role::server);
}

void modbus_station::bus_message()
{
    if (!follow_plc())
        return;
    count(counter::bus_message);
    show_status();
}

void modbus_station::bus_error(errc why) { damaged(error_of(why)); }

void modbus_station::bit_error() { damaged(modbus_error::bit_level); }

void modbus_station::port_absent()
{
    if (follow_plc())
        plc_->show_error(channel_, modbus_error::invalid_hardware, static_cast<std::uint16_t>(channel_));
}

// 6.4 does not list an unconvertible character as a communication error, but such a frame has no LRC that could match.
void modbus_station::damaged(modbus_error error)
{
    if (!follow_plc())
        return;
    const bool overrun = error == modbus_error::character_overrun;
    count(overrun ? counter::character_overrun : counter::bus_communication_error);
    log_.add(static_cast<std::uint8_t>(event::received | (overrun ? event::overrun : event::damaged) |
                                       (listen_only_ ? event::listening : 0)));
    plc_->show_error(channel_, error);
    show_status();
}

std::optional<buffer> modbus_station::answer(const modbus::frame& request)
{
    const cast to = request.unit == modbus::unit_id::broadcast ? cast::to_all : cast::to_one;
    if (!follow_plc() || (to == cast::to_one && request.unit != unit_) || request.pdu.empty())
        return std::nullopt;
    if (const auto unsent = std::exchange(pending_, std::nullopt); unsent && unsent->effect)
        take_effect(*unsent->effect);
    log_.add(static_cast<std::uint8_t>(event::received | (to == cast::to_all ? event::broadcast : 0) |
                                       (listen_only_ ? event::listening : 0)));
    std::optional<buffer> reply;
    if (listen_only_)
        listen(request.pdu);
    else
        reply = serve_request(request.pdu, to);
    show_status();
    return reply;
}

void modbus_station::sent()
{
    if (!follow_plc() || !pending_)
        return;
    const reply_pending done = *std::exchange(pending_, std::nullopt);
    log_.add(done.event);
    if (done.effect)
        take_effect(*done.effect);
    show_status();
}

std::optional<buffer> modbus_station::serve_request(bytes pdu, cast to)
{
    plc_->show_flag(plc_->channel_at(channel_).row->flags.error, false);  // 6.3, M8402: another command is triggered
    count(counter::server_message);
    if (to == cast::to_all)
        count(counter::server_no_response);

    const auto question = accept_request(plc_->model(), pdu, to);
    if (!question)
        return refuse(pdu[0], question.error(), to);
    const plc::channel& row = *plc_->channel_at(channel_).row;
    const modbus::response answer = std::visit(server{*plc_, {*plc_, row, counters_, log_}}, *question);
    if (const auto* no = std::get_if<exception_code>(&answer))
        return refuse(pdu[0], {*no, modbus_error::invalid_address}, to);
    if (is_event(*question))
        count(counter::event);

    const auto* const diagnosis = std::get_if<modbus::diagnostics>(&*question);
    const bool silent = to == cast::to_all || std::holds_alternative<modbus::no_response>(answer);
    const bool later = diagnosis != nullptr && !silent && waits_for_reply(diagnosis->what);
    if (diagnosis != nullptr && !later)
        take_effect(*diagnosis);
    if (silent)
        return std::nullopt;
    return reply_with(modbus::encode_response(*question, answer), event::sent,
                      later ? std::optional(*diagnosis) : std::nullopt);
}

std::optional<buffer> modbus_station::refuse(std::uint8_t function_code, const refusal& why, cast to)
{
    count(counter::exception_error);
    plc_->show_error(channel_, why.error, why.detail);
    if (to == cast::to_all)
        return std::nullopt;
    return reply_with(modbus::encode_exception(function_code, why.exception), send_event(why.exception), std::nullopt);
}

std::optional<buffer> modbus_station::reply_with(buffer pdu, std::uint8_t event,
                                                 std::optional<modbus::diagnostics> effect)
{
    pending_ = reply_pending{event, std::move(effect)};
    return pdu;
}

// In listen-only mode a restart is the only request that does something (7.11.5).
void modbus_station::listen(bytes pdu)
{
    const auto question = modbus::parse_request(pdu);
    const auto* const diagnosis = question ? std::get_if<modbus::diagnostics>(&*question) : nullptr;
    if (diagnosis != nullptr && diagnosis->what == diagnostic::restart_communications)
        restart(*diagnosis);
}

void modbus_station::take_effect(const modbus::diagnostics& d)
{
    switch (d.what) {
    case diagnostic::restart_communications: restart(d); break;
    case diagnostic::change_ascii_delimiter: set_delimiter(d.data[0]); break;
    case diagnostic::force_listen_only:
        set_listen_only(true);
        log_.add(event::entered_listen_only);
        break;
    case diagnostic::clear_counters: counters_.clear(); break;
    default: break;
    }
}

// V1.1b3 section 6.10: with "clear the log" its own byte is added and the rest is cleared. The delimiter stays: only
// power-on clears D8406 (6.1).
void modbus_station::restart(const modbus::diagnostics& d)
{
    counters_.clear();
    if (d.data[0] == 0xFF)
        log_.clear();
    log_.add(event::restarted);
    set_listen_only(false);
}

void modbus_station::set_listen_only(bool on)
{
    listen_only_ = on;
    plc_->show_flag(plc_->channel_at(channel_).row->flags.listen_only, on);
}

void modbus_station::set_delimiter(std::uint8_t character)
{
    delimiter_ = character;
    plc_->show_register(plc_->channel_at(channel_).row->registers.delimiter, character);
}

// 7.11.5: listen-only mode stops the counters, not the log.
void modbus_station::count(counter which)
{
    if (!listen_only_)
        counters_.count(which);
}

// Power-on clears all, STOP -> RUN counters and log (6.4, 9.5.2); the PLC's devices are clear then.
bool modbus_station::follow_plc()
{
    if (std::exchange(power_ons_, plc_->power_ons()) != plc_->power_ons()) {
        listen_only_ = false;
        delimiter_ = line_feed;
        pending_.reset();
    }
    if (std::exchange(starts_, plc_->starts()) != plc_->starts()) {
        counters_.clear();
        log_.clear();
    }
    return plc_->channel_at(channel_).operates;
}

void modbus_station::show_status()
{
    const plc::status_area& area = plc_->channel_at(channel_).status;
    store(plc_->memory(), area.counters, counters_.registers());
    store(plc_->memory(), area.log, log_.registers());
}

const comm_counters& modbus_station::counters()
{
    follow_plc();
    return counters_;
}

const event_log& modbus_station::log()
{
    follow_plc();
    return log_;
}

bool modbus_station::listen_only()
{
    follow_plc();
    return listen_only_;
}

std::uint8_t modbus_station::delimiter()
{
    follow_plc();
    return delimiter_;
}

}  // namespace plcgw
