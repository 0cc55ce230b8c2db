// Why bytes were dropped or a request went without an answer. A device that answers "no" (a MODBUS exception, a
// MEWTOCOL error code) has answered: that is not an errc.
#pragma once

#include <boost/system/result.hpp>

#include <type_traits>

namespace plcgw {

enum class errc {
    bad_checksum = 1,   // CRC, LRC or BCC does not match the frame
    bad_header,         // the bytes cannot begin a frame of this protocol
    incomplete,         // the line fell silent in the middle of a frame
    too_short,          // the line fell silent after fewer characters than any frame has
    overlong,           // more characters than any frame has
    bad_character,      // ASCII: neither a hexadecimal digit nor the end of the frame
    timed_out,          // no byte of an answer came within the response timeout
    unexpected_answer,  // a whole frame came, but it does not fit the question
    collision,          // our own bytes came back from the line changed
    line_not_quiet,     // somebody else kept talking when it was our turn
    port_absent,        // the serial port is not there, or was unplugged during the exchange
    bad_parity,         // a character came with the wrong parity
    bad_stop_bit,       // a character came without its stop bit (framing error, break)
    overrun,            // characters came faster than the port was read
    restarted,          // a start code, or the header of a new frame, came in the middle
    not_expressible,    // the question does not fit into the fields of this protocol: nothing was sent
    bad_count,          // as many bytes as cannot be sent at once
};

const boost::system::error_category& protocol_category() noexcept;

inline boost::system::error_code make_error_code(errc e) noexcept { return {static_cast<int>(e), protocol_category()}; }

template <class T>
using result = boost::system::result<T>;

}  // namespace plcgw

template <>
struct boost::system::is_error_code_enum<plcgw::errc> : std::true_type {
};
