// What others ask the stations of a line, beside its routes.
#include "bridge/routes/client_line.hpp"

namespace plcgw {

std::optional<forward_ticket> client_line::forward(station_number unit, modbus::request request,
                                                   std::optional<modbus::serial_options> timing, forward_asker asker)
{
    const auto ticket = forwards_.add(asker, unit, std::move(request), std::move(timing));
    if (!port_open_)
        forwards_.answer_all(errc::port_absent);
    else
        forwards_came_ = true;
    return ticket;
}

void client_line::look_at_forwarded(time_point now)
{
    if (!forwards_.empty())
        forwards_.look(now, [&](const forward_request& each) { return verdict_of(each, now); });
}

forward_queue::verdict client_line::verdict_of(const forward_request& r, time_point now)
{
    const std::size_t station = station_of(r.unit);
    // A PLC's program, which says how long it waits, finds out for itself who does not answer.
    if (r.timing && stations_[station].name.empty())
        return {.not_before = schedule_.quiet_until(station), .failed = {}};
    if (schedule_.is_given_up(station, now))
        return {.not_before = {}, .failed = errc::timed_out};  // at once: the line is for the living
    return {.not_before = schedule_.forward_at(station), .failed = {}};
}

std::optional<client_line::question> client_line::next_forward(time_point now)
{
    auto taken = forwards_.take(now, [&](const forward_request& each) { return verdict_of(each, now); });
    if (!taken)
        return std::nullopt;
    const modbus::serial_options timing = taken->timing ? *taken->timing : timing_of(station_of(taken->unit));
    return question{taken->ticket, taken->unit, std::move(taken->request), timing, now};
}

bool client_line::attempt_failed(const question& q, const modbus::answer_fault& why)
{
    statistics_.unanswered(station_of(q.unit), why.why == errc::timed_out);
    const auto* const forwarded = std::get_if<forward_ticket>(&q.origin);
    if (forwarded != nullptr)
        forwards_.note_fault(*forwarded, why);
    return forwarded != nullptr;
}

}  // namespace plcgw
