#include "bridge/plc/adprw_runner.hpp"

#include <algorithm>

namespace plcgw::plc {
namespace {

using std::chrono::milliseconds;

// M8000 to M8003: RUN, not RUN, first scan, not first scan.
constexpr std::uint32_t run_monitor = 8000;
constexpr std::uint32_t initial_pulse = 8002;

constexpr std::uint8_t line_feed = 0x0A;
constexpr unsigned most_retries = 20;
constexpr std::uint16_t longest_timeout = 32767;        // ms, D8409 and D8410
constexpr std::uint16_t longest_message_delay = 16382;  // ms, D8411
constexpr milliseconds default_response_timeout{3000};
constexpr milliseconds default_turnaround{400};

// How long an instruction rests that the PLC refused, or that found no port: looking again at once would change
// nothing.
constexpr milliseconds refused_rest{100};
constexpr milliseconds no_port_rest{1000};

adprw_error error_of(const adprw_failure& f, const adprw_question& q, const channel& of)
{
    switch (f.code) {
    case modbus_error::invalid_hardware: return {f.code, 0, static_cast<std::uint8_t>(of.number)};
    case modbus_error::station_mismatch: return {f.code, static_cast<std::uint8_t>(q.unit), f.received};
    case modbus_error::function_mismatch:
        return {f.code, static_cast<std::uint8_t>(function_of(q.request)), f.received};
    default: return {f.code};
    }
}

// 212: the function code as it came, with its 80H.
adprw_error error_of(modbus::exception_code exception, const adprw_question& q)
{
    return {modbus_error::exception_response,
            static_cast<std::uint8_t>(static_cast<unsigned>(function_of(q.request)) | 0x80U),
            static_cast<std::uint8_t>(exception)};
}

duration time_of(std::uint16_t setting, std::uint16_t most, milliseconds at_zero)
{
    return setting == 0 ? at_zero : milliseconds(std::min(setting, most));
}

}  // namespace

adprw_runner::adprw_runner(adprw_program program, simulated_plc& plc, unsigned channel)
    : program_(std::move(program)), plc_(&plc), channel_(plc.channel_at(channel).row), status_(plc, *channel_),
      states_(program_.instructions.size()), starts_(plc.starts())
{
}

// STOP forgets the question that is out. RUN begins the program anew.
void adprw_runner::follow_switch()
{
    const bool stopped = plc_->state() == run_state::stop;
    const bool started = starts_ != plc_->starts();
    if ((stopped || started) && asked_) {
        asked_.reset();
        status_.program_stopped();
    }
    if (!started)
        return;
    starts_ = plc_->starts();
    states_.assign(states_.size(), {});
    position_ = 0;
    first_scan_ = true;
    status_.program_started();
}

bool adprw_runner::closed(const contact& of) const
{
    const bool inverted = of.how == contact::kind::closed;
    if (of.at.kind == device_kind::m && of.at.number >= run_monitor && of.at.number <= initial_pulse + 1) {
        const bool on = of.at.number < initial_pulse || first_scan_;
        return (on != (of.at.number % 2 != 0)) != inverted;
    }
    const auto at = plc_->memory().find(of.at);
    return (at && plc_->memory().bit(*at)) != inverted;
}

void adprw_runner::scan()
{
    follow_switch();
    if (plc_->state() == run_state::stop)
        return;
    for (std::size_t i = 0; i < states_.size(); ++i) {
        const contact& drives = program_.instructions[i].driven_by;
        state& of = states_[i];
        const bool before = std::exchange(of.contact, closed(drives));
        const bool edge = drives.how == contact::kind::falling ? before && !of.contact : !before && of.contact;
        of.pending = of.pending || (edge && program_.instructions[i].once);
    }
    first_scan_ = false;
}

bool adprw_runner::is_due(std::size_t index) const
{
    return program_.instructions[index].once ? states_[index].pending : states_[index].contact;
}

std::optional<adprw_question> adprw_runner::next(time_point now)
{
    scan();
    if (plc_->state() == run_state::stop || asked_)
        return std::nullopt;
    const std::size_t count = states_.size();
    const std::size_t begin = std::exchange(position_, 0);
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t index = (begin + n) % count;
        if (!is_due(index))
            continue;
        if (const auto* moved = std::get_if<mov>(&program_.instructions[index].what)) {
            run_move(*moved);
            states_[index] = {states_[index].contact, false, now + refused_rest};
        }
        else if (states_[index].not_before <= now) {
            states_[index].pending = false;
            if (auto question = ask(index, now)) {
                position_ = index + 1;
                return question;
            }
        }
    }
    return std::nullopt;
}

time_point adprw_runner::wake_at(time_point now) const
{
    time_point earliest = time_point::max();
    if (plc_->state() == run_state::stop || asked_)
        return earliest;
    for (std::size_t i = 0; i < states_.size(); ++i)
        if (is_due(i))
            earliest = std::min(earliest, std::max(now, states_[i].not_before));
    return earliest;
}

void adprw_runner::run_move(const mov& of)
{
    memory& devices = plc_->memory();
    const auto to = devices.find(of.to);
    const auto* constant = std::get_if<std::uint16_t>(&of.from);
    const auto from = constant == nullptr ? devices.find(std::get<device>(of.from)) : std::nullopt;
    if (to && (constant != nullptr || from))
        devices.set_word(*to, constant != nullptr ? *constant : devices.word(*from));
}

std::optional<adprw_question> adprw_runner::ask(std::size_t index, time_point now)
{
    const instruction& of = program_.instructions[index];
    states_[index].not_before = now + refused_rest;
    if (status_.is_server()) {
        status_.refused_in_server(of.step);
        return std::nullopt;
    }
    auto asked = evaluate(std::get<adprw>(of.what), plc_->memory());
    if (!asked) {
        status_.refused(asked.error(), of.step);
        return std::nullopt;
    }
    states_[index].not_before = {};
    status_.started(of.step);
    asked_ = ++questions_;
    failed_attempts_ = 0;
    return adprw_question{asked->unit, std::move(asked->request), timing(), of.step, *asked_, asked->target, index};
}

adprw_timing adprw_runner::timing() const
{
    const channel_registers& d = channel_->registers;
    return {time_of(status_.setting(d.response_timeout), longest_timeout, default_response_timeout),
            time_of(status_.setting(d.turnaround_delay), longest_timeout, default_turnaround),
            time_of(status_.setting(d.message_delay), longest_message_delay, {}),
            std::min<unsigned>(status_.setting(d.retries), most_retries),
            d.delimiter == 0 ? line_feed : static_cast<std::uint8_t>(status_.setting(d.delimiter))};
}

void adprw_runner::attempt_failed(const adprw_question& q, const modbus::answer_fault& why)
{
    follow_switch();
    if (!is_out(q))
        return;
    status_.count_fault(why);
    if (++failed_attempts_ <= q.timing.retries)
        status_.retrying(failed_attempts_);
}

void adprw_runner::finished(const adprw_question& q, const adprw_outcome& outcome, time_point now)
{
    follow_switch();
    if (!is_out(q))
        return;
    asked_.reset();
    if (const auto* failure = std::get_if<adprw_failure>(&outcome)) {
        if (failure->code == modbus_error::invalid_hardware)
            states_[q.instruction].not_before = now + no_port_rest;
        status_.failed(error_of(*failure, q, *channel_), q.step);
        return;
    }
    const auto& answer = std::get<modbus::response>(outcome);
    status_.count_answer(answer);
    if (const auto* exception = std::get_if<modbus::exception_code>(&answer))
        status_.failed(error_of(*exception, q), q.step);
    else if (!store_answer({q.unit, q.request, q.target}, answer, plc_->memory()))
        status_.failed({modbus_error::length_mismatch}, q.step);
    else
        status_.completed();
}

}  // namespace plcgw::plc
