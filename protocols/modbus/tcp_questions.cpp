#include "protocols/modbus/tcp_questions.hpp"

#include <algorithm>

namespace plcgw::modbus {

buffer tcp_questions::ask(key who, unit_id unit, const request& question, time_point deadline)
{
    const transaction_id id{++last_id_};
    open_.insert_or_assign(id, open_question{who, unit, question, deadline});
    buffer adu;
    append_mbap(adu, {id, {unit, encode_request(question)}});
    return adu;
}

std::optional<tcp_questions::outcome> tcp_questions::take(const tcp_frame& received)
{
    const auto found = open_.find(received.id);
    if (found == open_.end() || found->second.unit != received.content.unit) {
        ++strangers_;
        return std::nullopt;
    }
    outcome taken{found->second.who, parse_response(found->second.question, received.content.pdu)};
    open_.erase(found);
    return taken;
}

std::optional<tcp_questions::outcome> tcp_questions::take_expired(time_point now)
{
    const auto found =
        std::find_if(open_.begin(), open_.end(), [now](const auto& each) { return each.second.deadline <= now; });
    if (found == open_.end())
        return std::nullopt;
    outcome taken{found->second.who, make_error_code(errc::timed_out)};
    open_.erase(found);
    return taken;
}

time_point tcp_questions::deadline() const
{
    time_point first = time_point::max();
    for (const auto& [id, each] : open_)
        first = std::min(first, each.deadline);
    return first;
}

}  // namespace plcgw::modbus
