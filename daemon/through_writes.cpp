#include "daemon/through_writes.hpp"

namespace plcgw {

through_writes::handle through_writes::begin(const plc::simulated_plc& plc)
{
    handle begun;
    for (line& each : lines_) {
        const auto numbers = each.routes->write_through(plc);
        if (numbers.empty())
            continue;
        if (!begun) {
            begun = std::make_shared<waiting>(executor_);
            begun->done.expires_at(std::chrono::steady_clock::time_point::max());
        }
        for (const std::uint64_t number : numbers) {
            each.waiting.emplace(number, begun);
            ++begun->open;
        }
        each.driver->wake();
    }
    if (begun)
        deliver();
    return begun;
}

asio::awaitable<std::optional<modbus::exception_code>> through_writes::finish(handle begun)
{
    while (begun->open > 0)
        co_await begun->done.async_wait(no_throw);
    co_return begun->failed;
}

void through_writes::deliver()
{
    for (line& each : lines_) {
        for (const client_line::through_outcome& outcome : each.routes->take_through()) {
            const auto found = each.waiting.find(outcome.number);
            if (found == each.waiting.end())
                continue;
            waiting& of = *found->second;
            if (outcome.failed && !of.failed)
                of.failed = outcome.failed;
            if (--of.open == 0)
                of.done.cancel();
            each.waiting.erase(found);
        }
    }
}

}  // namespace plcgw
