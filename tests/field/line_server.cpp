#include "tests/field/line_server.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <poll.h>
#include <stdexcept>
#include <termios.h>

namespace plcgw::field {

namespace {

constexpr unsigned byte_timeout_us = 50'000;  // a longer pause inside a request ends it; libmodbus's default is 500 ms
constexpr int silence_ms = 5;                 // more than 3.5 characters from 9600 baud on

// libmodbus measures requests by their function code and takes the others for frames without data.
bool has_known_length(int function)
{
    static constexpr int known[] = {1, 2, 3, 4, 5, 6, 7, 11, 12, 15, 16, 17, 22, 23};
    return std::ranges::find(known, function) != std::end(known);
}

}  // namespace

line_server::line_server(const std::string& port, int baud, int unit)
    : port_(port), baud_(baud), unit_(unit), nowhere_(check(::open("/dev/null", O_RDWR | O_CLOEXEC), "/dev/null"))
{
    renew_context();
    if (modbus_connect(context_.get()) == -1)
        throw std::runtime_error(port + ": " + modbus_strerror(errno));
    fd_ = unique_fd(modbus_get_socket(context_.get()));
}

request line_server::receive()
{
    const int size = modbus_receive(context_.get(), room_.data());
    if (size > 0)
        return request(room_).first(static_cast<std::size_t>(size));
    if (size == -1) {
        discard_until_silence();
        return {};
    }

    // A request to another unit. libmodbus would now take the next frame, whatever it is, for that unit's answer, which
    // is not heard on this line: a new context knows nothing about it.
    renew_context();
    if (!has_known_length(room_[1]))
        discard_until_silence();
    return {};
}

bool line_server::reply(request to, modbus_mapping_t& registers)
{
    return modbus_reply(context_.get(), to.data(), static_cast<int>(to.size()), &registers) > 0;
}

void line_server::serve_without_reply(request to, modbus_mapping_t& registers)
{
    modbus_set_socket(context_.get(), nowhere_.get());
    reply(to, registers);
    modbus_set_socket(context_.get(), fd());
}

void line_server::renew_context()
{
    context_.reset(modbus_new_rtu(port_.c_str(), baud_, 'N', 8, 1));
    if (!context_ || modbus_set_slave(context_.get(), unit_) == -1)
        throw std::runtime_error(port_ + ": " + modbus_strerror(errno));
    modbus_set_socket(context_.get(), fd());
    modbus_set_byte_timeout(context_.get(), 0, byte_timeout_us);
    // A server sleeps this long before some exception responses; the default of 500 ms would be over the client's
    // timeout.
    modbus_set_response_timeout(context_.get(), 0, 1000);
}

void line_server::discard_until_silence()
{
    // Only silence shows where the next RTU frame begins. A line that is never silent must not hold up the side door.
    pollfd line{.fd = fd(), .events = POLLIN, .revents = 0};
    for (int turns = 0; turns < 200 && ::poll(&line, 1, silence_ms) > 0; ++turns)
        ::tcflush(fd(), TCIFLUSH);
}

}  // namespace plcgw::field
