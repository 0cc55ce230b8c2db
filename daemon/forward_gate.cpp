#include "daemon/forward_gate.hpp"

namespace plcgw {

asio::awaitable<std::optional<result<modbus::response>>> forward_gate::ask(modbus::unit_id unit,
                                                                           modbus::request request,
                                                                           std::optional<modbus::serial_options> timing,
                                                                           on_fault heard)
{
    const auto ticket = line_.forward(unit, std::move(request), std::move(timing));
    if (!ticket)
        co_return std::nullopt;
    const auto entry = std::make_shared<waiting>(executor_);
    entry->heard = std::move(heard);
    entry->done.expires_at(std::chrono::steady_clock::time_point::max());
    waiting_.emplace(*ticket, entry);
    driver_.wake();
    deliver();
    while (!entry->answer)
        co_await entry->done.async_wait(no_throw);
    co_return std::move(entry->answer);
}

void forward_gate::deliver()
{
    for (const forward_fault& each : line_.take_forward_faults())
        if (const auto found = waiting_.find(each.ticket); found != waiting_.end() && found->second->heard)
            found->second->heard(each.why);
    for (forward_answer& each : line_.take_forwarded()) {
        const auto found = waiting_.find(each.ticket);
        if (found == waiting_.end())
            continue;
        found->second->answer = std::move(each.response);
        found->second->done.cancel();
        waiting_.erase(found);
    }
}

modbus::response as_response(const std::optional<result<modbus::response>>& answer)
{
    if (!answer)
        return modbus::exception_code::server_device_busy;
    if (*answer)
        return **answer;
    return answer->error() == errc::port_absent ? modbus::exception_code::gateway_path_unavailable
                                                : modbus::exception_code::gateway_target_failed_to_respond;
}

}  // namespace plcgw
