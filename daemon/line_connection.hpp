// What carries the bytes of a serial line: a port of this machine, or a serial device server at the other end of a TCP
// connection. It is opened again when it comes back: absence is a normal state.
#pragma once

#include "bridge/port_meter.hpp"
#include "daemon/bit_errors.hpp"
#include "daemon/config/config.hpp"
#include "daemon/read_before.hpp"
#include "protocols/bytes.hpp"
#include "protocols/modbus/framing.hpp"

#include <boost/asio/io_context.hpp>

#include <memory>

namespace plcgw {

class line_connection {
public:
    explicit line_connection(const std::string& line) : meter_(line) {}
    virtual ~line_connection() = default;
    line_connection(const line_connection&) = delete;
    line_connection& operator=(const line_connection&) = delete;

    // State and bytes are counted here, frames by who knows them.
    port_meter& meter() { return meter_; }
    const port_meter& meter() const { return meter_; }

    // True when it is open now; false after a failed attempt and the pause behind it, so that the caller can say so.
    virtual asio::awaitable<bool> open() = 0;
    virtual void close(const boost::system::error_code& why) = 0;
    virtual void rest() = 0;  // closed on purpose: open() comes at once

    // Fails with asio::error::timed_out when it takes far longer than the bytes need: driver or network hang.
    virtual asio::awaitable<boost::system::error_code> write(bytes adu) = 0;

    // At least a byte; asio::error::timed_out when the deadline came first, or interrupt().
    virtual asio::awaitable<boost::system::result<std::size_t>> read(time_point deadline,
                                                                     asio::mutable_buffer into) = 0;
    virtual void interrupt() = 0;

    // Since the last call; none where nobody counts them.
    virtual bit_errors take_bit_errors() { return {}; }

    // Characters that the port lost since it exists; nothing where that is not known.
    virtual std::optional<std::uint64_t> overruns() { return std::nullopt; }

    // A question went without an answer. A device server or MODBUS TCP server that has lost its mind, or its power,
    // may hold a connection on which nothing comes any more: then it is deaf, and to be closed and opened again.
    virtual void missed_answer() {}
    virtual bool deaf() const { return false; }

    // For the quality of what came over it.
    virtual std::string absence() const = 0;

protected:
    port_meter meter_;
};

// By whether the line has a device or a host.
std::unique_ptr<line_connection> make_connection(asio::io_context& loop, const line_config& line);

// Of the serial line, also of that behind a device server.
character_format format_of(const line_config& line);
modbus::framing framing_of(const line_config& line);

// The silence that ends a damaged frame: longer where a network is between, which may tear frames apart.
duration silence_of(const line_config& line);
local_echo echo_of(const line_config& line);

// From now, when so many bytes are sent, to the last byte of their echo at the latest.
duration echo_time(const line_config& line, std::size_t size);

}  // namespace plcgw
