#include "protocols/modbus/bus_listener.hpp"

#include <algorithm>
#include <utility>

namespace plcgw::modbus {
namespace {

constexpr duration slack = std::chrono::milliseconds(20);  // of adapters and of whoever wakes us

}  // namespace

bus_listener::bus_listener(const serial_options& timing) : timing_(timing), in_(timing.mode, {}, timing.silence) {}

void bus_listener::feed(time_point now, bytes received)
{
    if (timing_.mode == framing::rtu)
        came_.emplace_back(fed_ += received.size(), now);
    in_.feed(now, received);
}

void bus_listener::spoke(time_point now, bytes adu)
{
    spoken_.assign(adu.begin(), adu.end());
    echoes_ = 2;  // as it is said now, and by the adapter
    feed(now, adu);
}

std::optional<heard_exchange> bus_listener::next(time_point now)
{
    while (heard_.empty()) {
        const auto event = in_.next(now);
        if (!event)
            break;
        take(*event, time_of(*event));
    }
    if (heard_.empty() && asked_ && now >= silence_is_clear_at())
        give_up(now);
    if (heard_.empty())
        return std::nullopt;
    heard_exchange first = std::move(heard_.front());
    heard_.pop_front();
    return first;
}

time_point bus_listener::deadline() const
{
    return asked_ ? std::min(in_.deadline(), silence_is_clear_at()) : in_.deadline();
}

// A long answer may be on its way when the timeout ends.
time_point bus_listener::silence_is_clear_at() const
{
    const auto own = timeouts_.find(asked_->unit);
    const duration timeout = own == timeouts_.end() ? timing_.response_timeout : own->second;
    return std::max(asked_->ended + timeout, in_.heard() + timing_.silence) + slack;
}

// The last byte of an event, which may have waited for what confirms it.
time_point bus_listener::time_of(const bus_event& event)
{
    if (timing_.mode == framing::ascii)
        return in_.heard();
    used_ += event.size;
    while (came_.size() > 1 && came_.front().first < used_)
        came_.pop_front();
    return came_.empty() ? in_.heard() : came_.front().second;
}

void bus_listener::take(const bus_event& event, time_point at)
{
    if (event.what == bus_event::kind::dropped)
        return;
    const bool repeats = asked_ && asked_->pdu == event.content.pdu;  // the framer has no time to tell them apart
    const bool may_answer = timing_.mode == framing::ascii || event.what == bus_event::kind::answer || repeats;
    if (may_answer && take_answer(event.content, at))
        return;
    const bool again = given_up_ && given_up_->unit == event.content.unit && given_up_->pdu == event.content.pdu;
    if (again && given_up_->ours)
        return;  // its answer, too late
    const bool asks = timing_.mode == framing::ascii ? parse_request(event.content.pdu).has_value()
                                                     : event.what == bus_event::kind::question;
    if (asks || again || is_repetition(event.content, at))
        take_question(event.content, at);
}

bool bus_listener::take_answer(const frame& f, time_point at)
{
    if (!asked_ || asked_->unit != f.unit || !asked_->asked || is_repetition(f, at))
        return false;
    auto answer = parse_response(*asked_->asked, f.pdu);
    if (!answer)
        return false;
    if (!asked_->ours)
        heard_.push_back({f.unit, std::move(*asked_->asked), std::move(*answer), at});
    asked_.reset();
    return true;
}

bool bus_listener::is_repetition(const frame& f, time_point at) const
{
    if (!asked_ || asked_->unit != f.unit || asked_->pdu != f.pdu)
        return false;
    const auto own = timeouts_.find(f.unit);
    const duration timeout = own == timeouts_.end() ? timing_.response_timeout : own->second;
    const duration on_wire = character_time(timing_.format, encode_adu(timing_.mode, f, ascii_delimiter).size());
    return at > asked_->ended + timeout + on_wire;
}

void bus_listener::take_question(const frame& f, time_point at)
{
    give_up(at);
    const bool ours = is_ours(f);
    if (!ours)
        foreign_ = at;
    auto parsed = parse_request(f.pdu);
    question now_asked{f.unit, std::nullopt, f.pdu, at, ours};
    if (parsed)
        now_asked.asked = std::move(*parsed);
    if (!now_asked.asked || expects_answer(f.unit, *now_asked.asked))
        asked_ = std::move(now_asked);
    else if (!ours)
        heard_.push_back({f.unit, std::move(*now_asked.asked), response{no_response{}}, at});
}

bool bus_listener::is_ours(const frame& f)
{
    if (echoes_ == 0 || encode_adu(timing_.mode, f, in_.delimiter()) != spoken_)
        return false;
    --echoes_;
    return true;
}

// What was asked is not answered any more.
void bus_listener::give_up(time_point at)
{
    if (asked_ && asked_->asked && !asked_->ours)
        heard_.push_back({asked_->unit, std::move(*asked_->asked), std::nullopt, at});
    if (asked_)
        given_up_ = std::move(asked_);
    asked_.reset();
}

}  // namespace plcgw::modbus
