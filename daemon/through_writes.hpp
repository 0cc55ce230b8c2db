// Clients that wait until a station has taken what they wrote into a PLC: of write-through routes, and of orders.
#pragma once

#include "bridge/routes/client_line.hpp"
#include "daemon/line_driver.hpp"
#include "daemon/read_before.hpp"

#include <map>
#include <memory>

namespace plcgw {

class through_writes {
public:
    explicit through_writes(asio::any_io_executor executor) : executor_(std::move(executor)) {}

    void add_line(client_line& routes, line_driver& driver) { lines_.push_back({&routes, &driver, {}}); }

    struct waiting {
        explicit waiting(const asio::any_io_executor& executor) : done(executor) {}
        asio::steady_timer done;  // never expires, cancelled when all answers are there
        std::size_t all = 0;
        std::size_t open = 0;
        std::optional<modbus::exception_code> failed;  // the first that did
        client_line::through_outcome failure{};        // the same with its reason
    };
    using handle = std::shared_ptr<waiting>;

    // After a client's write into this PLC. Null when no station is to take it.
    handle begin(const plc::simulated_plc& plc);
    static asio::awaitable<std::optional<modbus::exception_code>> finish(handle begun);

    // After an order's write of these devices: null when no route takes them to a station.
    handle begin(const plc::simulated_plc& plc, const plc::change& written);
    // Waits for the outcomes. False as soon as the deadline comes before any question was out; withdraw() then.
    asio::awaitable<bool> finish_or_expire(handle begun, time_point begin_by);
    void withdraw(const handle& begun);  // memory is as it was before

    void deliver();  // what the lines know by now

private:
    struct line {
        client_line* routes;
        line_driver* driver;
        std::map<std::uint64_t, handle> waiting;
    };
    void wait_for(handle& begun, line& of, const std::vector<std::uint64_t>& numbers);
    bool has_begun(const handle& begun) const;

    asio::any_io_executor executor_;
    std::vector<line> lines_;
};

}  // namespace plcgw
