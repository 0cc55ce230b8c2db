// What others say on a client line, in the words of its routes, whatever the protocol.
#pragma once

#include "bridge/routes/station_question.hpp"
#include "protocols/mewtocol/bus_listener.hpp"
#include "protocols/modbus/bus_listener.hpp"

#include <deque>

namespace plcgw {

struct overheard_exchange {
    station_number unit;
    station_question asked;
    std::optional<station_answer> answer;  // nothing: silence
};

class line_listener {
public:
    explicit line_listener(modbus::bus_listener of) : in_(std::move(of)) {}
    explicit line_listener(mewtocol::bus_listener of) : in_(std::move(of)) {}

    void feed(time_point now, bytes received);
    void spoke(time_point now, bytes ours);  // it is no foreign question, nor are its echo and its answer

    // To be asked after feed() and at the deadline, until there is nothing. What routes have no words for is left out.
    // Words of MEWTOCOL that hold contacts come as words, and as contacts.
    std::optional<overheard_exchange> next(time_point now);
    time_point deadline() const;  // time_point::max(): none

    // When somebody else's last whole question ended.
    std::optional<time_point> foreign_question() const;

private:
    void take(modbus::heard_exchange heard);
    void take(mewtocol::heard_exchange heard);

    std::variant<modbus::bus_listener, mewtocol::bus_listener> in_;
    std::deque<overheard_exchange> waiting_;
};

}  // namespace plcgw
