// What is said on a line where we are server, RTU or ASCII.
#pragma once

#include "protocols/modbus/ascii.hpp"
#include "protocols/modbus/framing.hpp"
#include "protocols/modbus/rtu_bus.hpp"

#include <variant>

namespace plcgw::modbus {

class bus_framer {
public:
    using frame_type = bus_event;

    // max_silence: of RTU, see rtu_bus_framer.
    bus_framer(framing mode, std::vector<unit_id> own, duration max_silence);

    void feed(time_point now, bytes received);

    // ASCII does not tell requests from responses: every frame is a question, and only its station knows that it is.
    std::optional<bus_event> next(time_point now);
    time_point deadline() const;
    time_point heard() const;  // last byte

    // Of ASCII; RTU has none.
    void set_delimiters(buffer any_of);
    std::uint8_t delimiter() const;  // of the last frame

private:
    std::variant<rtu_bus_framer, ascii_framer> in_;
};

}  // namespace plcgw::modbus
