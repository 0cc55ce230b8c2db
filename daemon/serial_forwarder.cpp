#include "daemon/serial_forwarder.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>

#include <algorithm>
#include <set>

namespace plcgw {

std::vector<modbus::unit_id> serial_forwarder::units() const
{
    std::vector<modbus::unit_id> all;
    for (const way& each : ways_)
        all.push_back(each.unit);
    return all;
}

void serial_forwarder::ask(const asio::any_io_executor& executor, const modbus::frame& question,
                           std::function<void()> answered)
{
    const auto request = modbus::parse_request(question.pdu);
    if (question.unit == modbus::unit_id::broadcast) {
        std::set<forward_gate*> lines;
        for (const way& each : ways_)
            if (request && lines.insert(each.line).second)
                each.line->begin(as_, station_number(question.unit), *request);
        return;
    }
    const auto to =
        std::find_if(ways_.begin(), ways_.end(), [&](const way& each) { return each.unit == question.unit; });
    if (to == ways_.end())
        return;
    if (!request) {
        answer_ = modbus::frame{question.unit, modbus::encode_exception(question.pdu[0], request.error())};
        return;
    }
    line_ = to->line;
    under_way_ = line_->begin(as_, to->station, *request);
    if (under_way_)
        asio::co_spawn(executor, wait(under_way_, question.unit, *request, std::move(answered)), asio::detached);
    else
        answer_ = modbus::frame{question.unit, modbus::encode_response(*request, as_response(std::nullopt))};
}

asio::awaitable<void> serial_forwarder::wait(forward_gate::handle asked, modbus::unit_id unit, modbus::request question,
                                             std::function<void()> answered)
{
    auto outcome = co_await forward_gate::finish(asked);
    if (asked != under_way_)
        co_return;
    under_way_ = nullptr;
    buffer pdu = modbus::encode_response(question, as_response(std::move(outcome)));
    if (pdu.empty())
        co_return;
    answer_ = modbus::frame{unit, std::move(pdu)};
    answered();
}

void serial_forwarder::give_up()
{
    answer_.reset();
    if (const forward_gate::handle asked = std::exchange(under_way_, nullptr))
        line_->cancel(asked);
}

}  // namespace plcgw
