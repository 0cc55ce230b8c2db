// Messages that somebody outside orders, by DDS or a command, beside the sendings of the configuration.
#include "bridge/messages/line_messages.hpp"
#include "protocols/general_purpose/encode.hpp"

#include <algorithm>

namespace plcgw::messages {
namespace {

constexpr std::size_t most_waiting = 16;

}  // namespace

bool line_messages::can_send(bytes content) const
{
    return general_purpose::encode(content, options_.form).has_value();
}

std::optional<std::uint64_t> line_messages::order(buffer content, time_point now)
{
    if (ordered_.size() == most_waiting)
        return std::nullopt;
    if (!orders_) {
        orders_ = sends_.size();
        sends_.emplace_back();
        schedule_.add_triggered();
    }
    const std::uint64_t number = ++last_order_;
    if (!open_) {
        tell(number, "is out of reach: the port is absent");
        return number;
    }
    ordered_.push_back({number, std::move(content)});
    schedule_.request(*orders_, now);
    return number;
}

bool line_messages::has_begun(std::uint64_t number) const
{
    return std::none_of(ordered_.begin(), ordered_.end(), [number](const ordered& o) { return o.number == number; });
}

void line_messages::withdraw(std::uint64_t number)
{
    std::erase_if(ordered_, [number](const ordered& o) { return o.number == number; });
}

// The first one that waits is what this sending sends now. False when nobody waits any more.
bool line_messages::begin_ordered(std::size_t send)
{
    if (send != orders_)
        return true;
    if (ordered_.empty())
        return false;
    order_out_ = ordered_.front().number;
    sends_[send].row.text = std::move(ordered_.front().content);
    ordered_.pop_front();
    return true;
}

void line_messages::ordered_ended(std::size_t send, time_point now, const std::string& failed)
{
    if (send != orders_ || !order_out_)
        return;
    tell(*std::exchange(order_out_, {}), failed);
    if (!ordered_.empty())
        schedule_.request(*orders_, now);
}

void line_messages::lose_ordered()
{
    for (const ordered& each : std::exchange(ordered_, {}))
        tell(each.number, "is out of reach: the port is absent");
}

void line_messages::tell(std::uint64_t number, const std::string& failed)
{
    client_line::through_outcome& outcome = order_outcomes_.emplace_back();
    outcome.number = number;
    if (failed.empty())
        return;
    outcome.failed = modbus::exception_code::gateway_path_unavailable;
    outcome.reason = "line " + name() + " " + failed;
}

}  // namespace plcgw::messages
