#include "daemon/serial_port.hpp"

// termios2 for any baud rate. <asm/termbits.h> and <termios.h> cannot stand in one file, so Asio's serial port is not
// included here.
#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <linux/serial.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace plcgw {
namespace {

boost::system::error_code last_error() { return {errno, boost::system::system_category()}; }

boost::system::error_code set_character_format(int fd, const line_config& line)
{
    termios2 settings{};
    if (::ioctl(fd, TCGETS2, &settings) != 0)
        return last_error();
    settings.c_iflag = 0;  // raw: no flow control, no translation, parity errors are the checksum's business
    settings.c_oflag = 0;
    settings.c_lflag = 0;
    settings.c_cflag = CREAD | CLOCAL | BOTHER;
    settings.c_cflag |= line.data_bits == 7 ? CS7 : CS8;
    settings.c_cflag |= line.stop_bits == 2 ? CSTOPB : 0U;
    if (line.check != parity::none) {
        settings.c_cflag |= PARENB;
        settings.c_iflag |= INPCK | IGNPAR;  // a damaged character is left out, the checksum does the rest
    }
    if (line.protocol == line_protocol::general_purpose)
        settings.c_iflag = INPCK | PARMRK;  // no checksum: damaged characters have to be seen
    settings.c_cflag |= line.check == parity::odd ? PARODD : 0U;
    settings.c_ispeed = line.baud_rate;
    settings.c_ospeed = line.baud_rate;
    settings.c_cc[VMIN] = 1;
    settings.c_cc[VTIME] = 0;
    if (::ioctl(fd, TCSETS2, &settings) != 0)
        return last_error();
    return {};
}

// Empty when it worked or was not wanted.
std::string set_rs485(int fd, const rs485_config& wanted)
{
    if (!wanted.enabled)
        return {};
    serial_rs485 settings{};
    settings.flags = SER_RS485_ENABLED;
    settings.flags |= wanted.rts_on_send ? SER_RS485_RTS_ON_SEND : 0U;
    settings.flags |= wanted.rts_after_send ? SER_RS485_RTS_AFTER_SEND : 0U;
    settings.flags |= wanted.rx_during_tx ? SER_RS485_RX_DURING_TX : 0U;
    settings.delay_rts_before_send = static_cast<std::uint32_t>(wanted.delay_before_send.count());
    settings.delay_rts_after_send = static_cast<std::uint32_t>(wanted.delay_after_send.count());
    if (::ioctl(fd, TIOCSRS485, &settings) == 0)
        return {};
    return std::string("its driver cannot switch the RS-485 direction (TIOCSRS485: ") + std::strerror(errno) +
           "): the adapter has to do it itself";
}

}  // namespace

boost::system::result<int> open_serial_port(const line_config& line, std::string& warning)
{
    const int fd = ::open(line.device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0)
        return last_error();
    boost::system::error_code failed = set_character_format(fd, line);
    // TIOCEXCL refuses other users, the lock refuses a second gateway of root.
    if (!failed && (::flock(fd, LOCK_EX | LOCK_NB) != 0 || ::ioctl(fd, TIOCEXCL) != 0))
        failed = last_error();
    if (failed) {
        ::close(fd);
        return failed;
    }
    warning = set_rs485(fd, line.rs485);
    ::ioctl(fd, TCFLSH, TCIOFLUSH);  // what an earlier user left behind is no answer to us
    return fd;
}

std::optional<bit_errors> bit_errors_of(int fd)
{
    serial_icounter_struct counters{};
    if (::ioctl(fd, TIOCGICOUNT, &counters) != 0)
        return std::nullopt;
    return bit_errors{.overrun = static_cast<unsigned>(counters.overrun),
                      .framing = static_cast<unsigned>(counters.frame),
                      .parity = static_cast<unsigned>(counters.parity)};
}

std::optional<std::uint64_t> overruns_of(int fd)
{
    serial_icounter_struct counters{};
    if (::ioctl(fd, TIOCGICOUNT, &counters) != 0)
        return std::nullopt;
    return static_cast<std::uint64_t>(counters.overrun) + static_cast<std::uint64_t>(counters.buf_overrun);
}

void forget_output(int fd) { ::ioctl(fd, TCFLSH, TCOFLUSH); }

}  // namespace plcgw
