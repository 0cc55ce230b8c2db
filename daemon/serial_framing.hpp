// RTU or ASCII over TCP: a serial device server connects to us and passes on what is said on its line.
#pragma once

#include "daemon/tcp_framing.hpp"
#include "protocols/modbus/bus_framer.hpp"

namespace plcgw {

// Requests to other units than ours, answers of the line's other stations and damaged frames are left out.
class serial_framing final : public tcp_framing {
public:
    // silence: ends a frame of unknown length; the network must not tear frames apart for longer.
    serial_framing(modbus::framing mode, std::vector<modbus::unit_id> own, duration silence);

    std::string_view name() const override;
    void feed(time_point now, bytes received) override { in_.feed(now, received); }
    std::optional<result<modbus::tcp_frame>> next(time_point now) override;
    bool empty() const override { return true; }  // a line may stop in the middle of a frame: that is not the end of it
    time_point deadline() const override { return in_.deadline(); }
    bool is_serial() const override { return true; }
    void append(buffer& to, const modbus::tcp_frame& answer) const override;

private:
    modbus::framing mode_;
    std::vector<modbus::unit_id> own_;
    modbus::bus_framer in_;
};

}  // namespace plcgw
