// Requests of a serial client that stations of other lines answer: unit ids of a server line that lead there.
#pragma once

#include "daemon/forward_gate.hpp"

namespace plcgw {

// One request at a time: a serial client that asks again does not wait for the answer before.
class serial_forwarder {
public:
    struct way {
        modbus::unit_id unit{};  // as the client calls it
        forward_gate* line = nullptr;
        station_number station;  // on that line
    };
    explicit serial_forwarder(std::vector<way> ways) : ways_(std::move(ways)), as_(new_asker()) {}

    bool empty() const { return ways_.empty(); }
    std::vector<modbus::unit_id> units() const;

    // Asks the station behind this unit; a broadcast goes to all lines. answered: called when take_answer() has
    // something, not before this returns.
    void ask(const asio::any_io_executor& executor, const modbus::frame& question, std::function<void()> answered);

    void give_up();  // the client says something else

    // Nothing for a broadcast, and for units that lead nowhere.
    std::optional<modbus::frame> take_answer() { return std::exchange(answer_, std::nullopt); }

private:
    asio::awaitable<void> wait(forward_gate::handle asked, modbus::unit_id unit, modbus::request question,
                               std::function<void()> answered);

    std::vector<way> ways_;
    forward_asker as_;
    forward_gate* line_ = nullptr;  // that is asked
    forward_gate::handle under_way_;
    std::optional<modbus::frame> answer_;
};

}  // namespace plcgw
