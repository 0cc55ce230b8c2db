// What the gateway needs to know of whatever carries a line's requests: a serial port or a TCP connection.
#pragma once

#include "bridge/link_status.hpp"
#include "bridge/standby/line_voice.hpp"

#include <boost/asio/awaitable.hpp>

namespace plcgw {

class fp7_line_ports;

class line_driver {
public:
    virtual ~line_driver() = default;
    virtual boost::asio::awaitable<void> run() = 0;  // until the io_context ends
    virtual void wake() = 0;                         // something is due at once, or the voice has changed
    virtual const port_status& port() const = 0;     // what carries it

    // Before run(): asks only while that says so, and tells it what is heard. Server lines never ask.
    virtual void obey(line_voice&) {}

    // The ports of FP7s that it stands for, if it can, and their channel reset: what is under way is given up, and has
    // been when the call returns.
    virtual fp7_line_ports* com_ports() { return nullptr; }
    virtual void reset_channel() {}
};

}  // namespace plcgw
