#include "daemon/through_writes.hpp"

#include <algorithm>

namespace plcgw {

through_writes::handle through_writes::begin(const plc::simulated_plc& plc)
{
    handle begun;
    for (line& each : lines_)
        wait_for(begun, each, each.routes->write_through(plc));
    if (begun)
        deliver();
    return begun;
}

through_writes::handle through_writes::begin(const plc::simulated_plc& plc, const plc::change& written)
{
    handle begun;
    for (line& each : lines_)
        wait_for(begun, each, each.routes->order(plc, written));
    if (begun)
        deliver();
    return begun;
}

void through_writes::wait_for(handle& begun, line& of, const std::vector<std::uint64_t>& numbers)
{
    if (numbers.empty())
        return;
    if (!begun) {
        begun = std::make_shared<waiting>(executor_);
        begun->done.expires_at(std::chrono::steady_clock::time_point::max());
    }
    for (const std::uint64_t number : numbers) {
        of.waiting.emplace(number, begun);
        ++begun->open;
        ++begun->all;
    }
    of.driver->wake();
}

asio::awaitable<std::optional<modbus::exception_code>> through_writes::finish(handle begun)
{
    while (begun->open > 0)
        co_await begun->done.async_wait(no_throw);
    co_return begun->failed;
}

asio::awaitable<bool> through_writes::finish_or_expire(handle begun, time_point begin_by)
{
    bool may_expire = true;
    while (begun->open > 0) {
        if (may_expire && now() >= begin_by) {
            if (!has_begun(begun))
                co_return false;
            may_expire = false;
            begun->done.expires_at(std::chrono::steady_clock::time_point::max());
        }
        else if (may_expire)
            begun->done.expires_at(begin_by);
        co_await begun->done.async_wait(no_throw);
    }
    co_return true;
}

// Also when only one of several questions is out: the order has an effect by now.
bool through_writes::has_begun(const handle& begun) const
{
    const auto is_out = [&](const line& each) {
        return std::any_of(each.waiting.begin(), each.waiting.end(), [&](const auto& entry) {
            return entry.second == begun && each.routes->has_begun(entry.first);
        });
    };
    return begun->open != begun->all || std::any_of(lines_.begin(), lines_.end(), is_out);
}

void through_writes::withdraw(const handle& begun)
{
    for (line& each : lines_) {
        std::vector<std::uint64_t> numbers;
        for (const auto& [number, whose] : each.waiting)
            if (whose == begun)
                numbers.push_back(number);
        each.routes->withdraw(numbers);
        for (const std::uint64_t number : numbers)
            each.waiting.erase(number);
    }
}

void through_writes::deliver()
{
    for (line& each : lines_) {
        for (client_line::through_outcome& outcome : each.routes->take_through()) {
            const auto found = each.waiting.find(outcome.number);
            if (found == each.waiting.end())
                continue;
            waiting& of = *found->second;
            if (outcome.failed && !of.failed) {
                of.failed = outcome.failed;
                of.failure = std::move(outcome);
            }
            if (--of.open == 0)
                of.done.cancel();
            each.waiting.erase(found);
        }
    }
}

}  // namespace plcgw
