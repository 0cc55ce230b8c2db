#include "bridge/services/fp7_unit.hpp"

#include "bridge/plc/models/fp7.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace plcgw {
namespace {

using plc::device_kind;

// Contacts of COM.1; COM.2 and COM.0 have the next two.
constexpr unsigned message_waits = 0x0;
constexpr unsigned message_copied = 0x4;
constexpr unsigned general_ready = 0x8;
constexpr unsigned master_ready = 0xC;
constexpr unsigned reset_ready = 0x10;
constexpr unsigned cts = 0x14;

constexpr unsigned send_failed = 0x0;
constexpr unsigned general_sending = 0x8;
constexpr unsigned master_sending = 0xC;
constexpr unsigned reset_request = 0x10;
constexpr unsigned rts = 0x14;

constexpr unsigned com_with_rs_cs = 1;

unsigned offset_of(unsigned com) { return com == 0 ? 2 : com - 1; }

}  // namespace

fp7_unit::fp7_unit(plc::simulated_plc& plc, duration scan) : plc_(&plc), scan_(scan), power_ons_(plc.power_ons())
{
    if (&plc.model() != &plc::fp7)
        throw std::invalid_argument(plc.name() + " is no FP7");
}

void fp7_unit::open(time_point now, unsigned com, const plc::com_parameters& set, plc::com_card card)
{
    if (com > 2)
        throw std::out_of_range("an FP7 CPU has no COM." + std::to_string(com));
    port& p = ports_[com];
    p = port{};
    p.set = set;
    p.monitor.mode = set.mode;
    p.monitor.card = card;
    p.requested = is_set(device_kind::y, reset_request + offset_of(com));
    show(now, com, {});
}

void fp7_unit::show(time_point now, unsigned com, const com_state& state)
{
    port& p = ports_.at(com);
    if (state.sending && !p.state.sending)
        p.sending_until = now + scan_;
    p.state = state;
    write_contacts(com, p);
    write_words(com, p);
}

void fp7_unit::sends(time_point now, unsigned com, time_point until)
{
    port& p = ports_.at(com);
    p.sending_until = std::max(until, now + scan_);
    write_contacts(com, p);
}

void fp7_unit::copied(time_point now, unsigned com)
{
    port& p = ports_.at(com);
    p.copied_until = now + scan_;
    write_contacts(com, p);
}

void fp7_unit::note(unsigned com, plc::receive_error what)
{
    port& p = ports_.at(com);
    plc::note(p.monitor, what);
    write_words(com, p);
}

void fp7_unit::note(unsigned com, plc::setting_error what, std::uint16_t wrong_parameter)
{
    port& p = ports_.at(com);
    plc::note(p.monitor, what, wrong_parameter);
    write_words(com, p);
}

std::vector<unsigned> fp7_unit::run(time_point now)
{
    const bool restarted = std::exchange(power_ons_, plc_->power_ons()) != plc_->power_ons();
    std::vector<unsigned> to_reset;
    for (auto& [com, p] : ports_) {
        if (restarted) {
            plc::clear_errors(p.monitor);
            p.requested = p.done = false;
        }
        const bool requested = is_set(device_kind::y, reset_request + offset_of(com));
        if (requested && !p.requested)
            to_reset.push_back(com);
        p.requested = requested;
        p.done = p.done && requested;
        for (auto* const until : {&p.copied_until, &p.sending_until})
            if (*until && **until <= now)
                until->reset();
        write_contacts(com, p);
        write_words(com, p);
    }
    return to_reset;
}

void fp7_unit::reset_done(time_point now, unsigned com)
{
    port& p = ports_.at(com);
    plc::clear_errors(p.monitor);
    p.copied_until.reset();
    p.sending_until.reset();
    p.done = is_set(device_kind::y, reset_request + offset_of(com));
    show(now, com, {.cts_off = p.state.cts_off});
}

bool fp7_unit::rts_off(unsigned com) const { return com == com_with_rs_cs && is_set(device_kind::y, rts); }

std::optional<time_point> fp7_unit::deadline() const
{
    std::optional<time_point> first;
    for (const auto& [com, p] : ports_)
        for (const auto& until : {p.copied_until, p.sending_until})
            if (until && (!first || *until < *first))
                first = until;
    return first;
}

void fp7_unit::write_contacts(unsigned com, const port& p)
{
    const unsigned offset = offset_of(com);
    const bool general = p.set.mode == plc::com_mode::general_purpose;
    const bool master = plc::is_master_mode(p.set.mode);
    const bool sending = p.state.sending || p.sending_until;
    const bool running = plc_->state() == plc::run_state::run;
    set(device_kind::x, message_waits + offset, general && (p.state.message_waits || p.copied_until));
    set(device_kind::x, message_copied + offset, general && p.copied_until.has_value());
    set(device_kind::x, general_ready + offset, general);
    set(device_kind::x, master_ready + offset, master && running);
    set(device_kind::x, reset_ready + offset, p.done);
    set(device_kind::y, send_failed + offset, p.state.send_failed);
    set(device_kind::y, general_sending + offset, general && sending);
    set(device_kind::y, master_sending + offset, master && sending);
    if (com == com_with_rs_cs)
        set(device_kind::x, cts, p.set.rs_cs && p.state.cts_off);
}

void fp7_unit::write_words(unsigned com, const port& p)
{
    const auto write = [&](std::uint32_t number, std::span<const std::uint16_t> words) {
        for (const std::uint16_t each : words)
            plc_->memory().set_word(*plc_->memory().find({device_kind::um, number++}), each);
    };
    write(plc::pmget_step * com, plc::parameter_words(p.set));
    write(plc::pmget_step * com + plc::pmget_monitor, plc::monitor_words(p.monitor));
}

void fp7_unit::set(device_kind kind, unsigned number, bool on)
{
    plc_->memory().set_bit(*plc_->memory().find({kind, number}), on);
}

bool fp7_unit::is_set(device_kind kind, unsigned number) const
{
    return plc_->memory().bit(*plc_->memory().find({kind, number}));
}

}  // namespace plcgw
