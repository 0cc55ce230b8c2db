// A serial driver that keeps received bytes for a while costs that time on every answer: FTDI adapters wait 16 ms for
// more. ASYNC_LOW_LATENCY (TIOCSSERIAL) tells the driver not to.
#pragma once

#include <filesystem>
#include <string>

struct serial_struct;

namespace plcgw {

// TIOCGSERIAL and TIOCSSERIAL of an open port. A seam: ptys have neither.
class serial_driver {
public:
    virtual ~serial_driver() = default;
    virtual int get(serial_struct& settings) = 0;  // 0 or errno
    virtual int set(const serial_struct& settings) = 0;
};

enum class low_latency : unsigned char {
    set,        // now, or it was already
    absent,     // the driver has no such mode, as that of a pty
    forgotten,  // the driver took it and did not keep it: most USB adapters other than FTDI
    refused,    // not permitted, or it failed
};

struct latency_report {
    low_latency outcome = low_latency::absent;
    int error = 0;  // errno, when refused
};

latency_report set_low_latency(serial_driver& driver);
latency_report set_low_latency(int port);

// What there is to say. `to_be_cured`: an FTDI adapter goes on waiting, and somebody can change that.
struct latency_text {
    std::string text;
    bool to_be_cured = false;
};

// device: its path, links are followed. An FTDI adapter is one that has a latency_timer (milliseconds) in sysfs.
latency_text describe(const latency_report& report, const std::filesystem::path& device,
                      const std::filesystem::path& sysfs = "/sys");

}  // namespace plcgw
