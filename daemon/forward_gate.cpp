#include "daemon/forward_gate.hpp"

namespace plcgw {

asio::awaitable<std::optional<result<modbus::response>>> forward_gate::ask(station_number unit, modbus::request request,
                                                                           std::optional<modbus::serial_options> timing,
                                                                           on_fault heard)
{
    const handle asked = begin(forward_asker::nobody, unit, std::move(request), std::move(timing), std::move(heard));
    if (!asked)
        co_return std::nullopt;
    auto answer = co_await finish(asked);
    co_return std::move(answer);
}

forward_gate::handle forward_gate::begin(forward_asker asker, station_number unit, modbus::request request,
                                         std::optional<modbus::serial_options> timing, on_fault heard)
{
    const auto ticket = line_.forward(unit, std::move(request), std::move(timing), asker);
    if (!ticket)
        return nullptr;
    const auto entry = std::make_shared<waiting>(executor_, *ticket);
    entry->heard = std::move(heard);
    entry->done.expires_at(std::chrono::steady_clock::time_point::max());
    waiting_.emplace(*ticket, entry);
    line_.look_at_forwarded(now());
    driver_.wake();
    deliver();
    return entry;
}

asio::awaitable<result<modbus::response>> forward_gate::finish(handle asked)
{
    while (!asked->answer)
        co_await asked->done.async_wait(no_throw);
    co_return std::move(*asked->answer);
}

asio::awaitable<bool> forward_gate::expires(handle asked, time_point deadline)
{
    asked->done.expires_at(deadline);
    while (!asked->answer) {
        const auto [cancelled] = co_await asked->done.async_wait(no_throw);
        if (!cancelled && !asked->answer && !line_.is_asked(asked->ticket))
            co_return true;
        if (!cancelled)
            asked->done.expires_at(std::chrono::steady_clock::time_point::max());
    }
    co_return false;
}

void forward_gate::cancel(const handle& asked)
{
    line_.cancel(asked->ticket);
    waiting_.erase(asked->ticket);
    if (asked->answer)
        return;
    asked->answer = boost::system::error_code(asio::error::operation_aborted);
    asked->done.cancel();
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

forward_asker new_asker()
{
    static std::uint64_t last = 0;
    return forward_asker{++last};
}

modbus::response as_response(const std::optional<result<modbus::response>>& answer)
{
    if (!answer)
        return modbus::exception_code::server_device_busy;
    if (*answer)
        return **answer;
    const bool no_path = answer->error() == errc::port_absent || answer->error() == errc::not_expressible;
    return no_path ? modbus::exception_code::gateway_path_unavailable
                   : modbus::exception_code::gateway_target_failed_to_respond;
}

}  // namespace plcgw
