// Lets a coroutine ask a station of a line, and wait for its answer while the line does its other work.
#pragma once

#include "bridge/routes/client_line.hpp"
#include "daemon/line_driver.hpp"
#include "daemon/read_before.hpp"

#include <functional>
#include <map>
#include <memory>

namespace plcgw {

class forward_gate {
public:
    forward_gate(asio::any_io_executor executor, client_line& line, line_driver& driver)
        : executor_(std::move(executor)), line_(line), driver_(driver)
    {
    }

    using on_fault = std::function<void(const modbus::answer_fault&)>;

    struct waiting {
        waiting(const asio::any_io_executor& executor, forward_ticket t) : done(executor), ticket(t) {}
        asio::steady_timer done;  // never expires, cancelled when the answer is there
        forward_ticket ticket;
        std::optional<result<modbus::response>> answer;
        on_fault heard;
    };
    using handle = std::shared_ptr<waiting>;

    // Nothing when too many requests wait already. timing: of the station or line, if absent. heard: called for each
    // attempt that failed, when it did.
    asio::awaitable<std::optional<result<modbus::response>>>
    ask(station_number unit, modbus::request request, std::optional<modbus::serial_options> timing, on_fault heard);

    // The same in parts, for who may have to leave before the answer. Null when too many wait. Askers take turns.
    handle begin(forward_asker asker, station_number unit, modbus::request request,
                 std::optional<modbus::serial_options> timing = {}, on_fault heard = {});
    static asio::awaitable<result<modbus::response>> finish(handle asked);
    // Waits for the answer, or until the deadline if it is not asked by then: true.
    asio::awaitable<bool> expires(handle asked, time_point deadline);
    void cancel(const handle& asked);  // finish() ends with asio::error::operation_aborted

    void deliver();  // faults and answers that the line has by now

private:
    asio::any_io_executor executor_;
    client_line& line_;
    line_driver& driver_;
    std::map<forward_ticket, handle> waiting_;
};

forward_asker new_asker();  // another each time

// What a gateway tells its client (V1.1b3 chapter 7): the answer, 06 when too many wait, 0A when the port is absent or
// no such station can be on the line, 0B when nobody answers.
modbus::response as_response(const std::optional<result<modbus::response>>& answer);

}  // namespace plcgw
