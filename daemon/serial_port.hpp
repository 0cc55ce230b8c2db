// Opens a serial port with the settings of a line. Everything that Asio's serial_port does not know: any baud rate,
// RS-485 direction, exclusive use.
#pragma once

#include "daemon/bit_errors.hpp"
#include "daemon/config/config.hpp"

#include <boost/system/result.hpp>

#include <optional>
#include <string>

namespace plcgw {

// The open port's descriptor, or why it could not be opened. On success `warning` may say what the driver could not do.
// A pty keeps no parity and knows no RS-485. On a general-purpose line what is read is marked: marked_characters.hpp.
boost::system::result<int> open_serial_port(const line_config& line, std::string& warning);

// Since the driver counts; nothing where it does not, on a pty for one.
std::optional<bit_errors> bit_errors_of(int fd);

// Characters that were lost because nobody took them from the port in time; nothing where the driver does not count.
std::optional<std::uint64_t> overruns_of(int fd);

// Before closing: the kernel would wait for output that a hung adapter does not take, up to 30 s.
void forget_output(int fd);

}  // namespace plcgw
