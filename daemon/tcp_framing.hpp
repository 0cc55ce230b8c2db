// How requests stand in the byte stream of a TCP client: what a session needs to know of MBAP, or of RTU and ASCII over
// TCP.
#pragma once

#include "protocols/modbus/mbap.hpp"
#include "protocols/time.hpp"

#include <string_view>

namespace plcgw {

// Turns received bytes into questions and answers into bytes. One for each connection.
class tcp_framing {
public:
    virtual ~tcp_framing() = default;

    virtual std::string_view name() const = 0;  // for the log

    virtual void feed(time_point now, bytes received) = 0;

    // Nothing yet, a question, or an error: the stream cannot be trusted any more and is closed. Whatever may be left
    // out without closing is left out within. A framing without transaction ids gives id 0.
    virtual std::optional<result<modbus::tcp_frame>> next(time_point now) = 0;

    virtual bool empty() const = 0;  // no part of a question waits for its rest

    // When to call next() although nothing came: silence that ends a frame.
    virtual time_point deadline() const { return time_point::max(); }

    // As on a serial line: one question at a time, for answers do not name theirs; unit 0 is a broadcast.
    virtual bool is_serial() const = 0;

    virtual void append(buffer& to, const modbus::tcp_frame& answer) const = 0;
};

class mbap_framing final : public tcp_framing {
public:
    std::string_view name() const override { return "MODBUS TCP"; }
    void feed(time_point, bytes received) override { in_.feed(received); }
    std::optional<result<modbus::tcp_frame>> next(time_point) override { return in_.next(); }
    bool empty() const override { return in_.empty(); }
    bool is_serial() const override { return false; }
    void append(buffer& to, const modbus::tcp_frame& answer) const override { modbus::append_mbap(to, answer); }

private:
    modbus::mbap_framer in_;
};

}  // namespace plcgw
