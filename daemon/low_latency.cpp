#include "daemon/low_latency.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <linux/serial.h>
#include <optional>
#include <sys/ioctl.h>

namespace plcgw {
namespace {

class open_port final : public serial_driver {
public:
    explicit open_port(int fd) : fd_(fd) {}
    int get(serial_struct& settings) override { return ::ioctl(fd_, TIOCGSERIAL, &settings) == 0 ? 0 : errno; }
    int set(const serial_struct& settings) override { return ::ioctl(fd_, TIOCSSERIAL, &settings) == 0 ? 0 : errno; }

private:
    int fd_;
};

// What drivers answer that do not know the call.
bool is_unknown(int error) { return error == ENOTTY || error == EINVAL || error == ENOSYS || error == EOPNOTSUPP; }

bool is_low(const serial_struct& settings) { return (static_cast<unsigned>(settings.flags) & ASYNC_LOW_LATENCY) != 0; }

std::filesystem::path timer_of(const std::filesystem::path& device, const std::filesystem::path& sysfs)
{
    std::error_code ignored;
    std::filesystem::path port = std::filesystem::canonical(device, ignored);
    if (ignored)
        port = device;
    return sysfs / "class" / "tty" / port.filename() / "device" / "latency_timer";
}

std::optional<unsigned> milliseconds_in(const std::filesystem::path& timer)
{
    std::ifstream file(timer);
    unsigned value = 0;
    if (file >> value)
        return value;
    return std::nullopt;
}

}  // namespace

latency_report set_low_latency(serial_driver& driver)
{
    serial_struct settings{};
    if (const int error = driver.get(settings))
        return is_unknown(error) ? latency_report{} : latency_report{low_latency::refused, error};
    if (is_low(settings))
        return {low_latency::set};
    settings.flags = static_cast<int>(static_cast<unsigned>(settings.flags) | ASYNC_LOW_LATENCY);
    if (const int error = driver.set(settings))
        return is_unknown(error) ? latency_report{} : latency_report{low_latency::refused, error};
    serial_struct kept{};
    return {driver.get(kept) == 0 && is_low(kept) ? low_latency::set : low_latency::forgotten};
}

latency_report set_low_latency(int port)
{
    open_port driver(port);
    return set_low_latency(driver);
}

latency_text describe(const latency_report& report, const std::filesystem::path& device,
                      const std::filesystem::path& sysfs)
{
    const std::filesystem::path timer = timer_of(device, sysfs);
    const auto waits = milliseconds_in(timer);
    latency_text said;
    switch (report.outcome) {
    case low_latency::set: said.text = "low latency is set"; break;
    case low_latency::absent: said.text = "its driver has no low-latency mode"; break;
    case low_latency::forgotten: said.text = "its driver does not keep the low-latency mode"; break;
    case low_latency::refused:
        said.text = std::string("its driver refuses the low-latency mode (") + std::strerror(report.error) + ")";
        break;
    }
    said.to_be_cured = waits && *waits > 1;
    if (said.to_be_cured)
        said.text += ", and the adapter keeps received bytes for " + std::to_string(*waits) + " ms: write 1 to " +
                     timer.string() +
                     ", for good by a udev rule: ACTION==\"add\", SUBSYSTEM==\"usb-serial\", "
                     "DRIVER==\"ftdi_sio\", ATTR{latency_timer}=\"1\"";
    return said;
}

}  // namespace plcgw
