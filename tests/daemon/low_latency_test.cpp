#include "daemon/low_latency.hpp"

#include <doctest/doctest.h>

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <linux/serial.h>
#include <unistd.h>

TEST_SUITE_BEGIN("serial");

using namespace plcgw;

namespace {

// A driver that keeps what it is told, or does not, or says no.
struct fake_driver final : serial_driver {
    int get_error = 0;
    int set_error = 0;
    bool keeps = true;
    serial_struct now{};
    int sets = 0;

    int get(serial_struct& settings) override
    {
        settings = now;
        return get_error;
    }
    int set(const serial_struct& settings) override
    {
        ++sets;
        if (set_error == 0 && keeps)
            now = settings;
        return set_error;
    }
};

// The parts of sysfs that an FTDI adapter has.
struct fake_sysfs {
    fake_sysfs()
    {
        std::string name = "/tmp/low_latency.XXXXXX";
        root = ::mkdtemp(name.data());
        std::filesystem::create_directories(root / "class/tty/ttyUSB7/device");
        std::filesystem::create_directories(root / "dev");
        std::ofstream(root / "dev/ttyUSB7");
        std::filesystem::create_symlink(root / "dev/ttyUSB7", root / "dev/pump");
    }
    ~fake_sysfs() { std::filesystem::remove_all(root); }
    fake_sysfs(const fake_sysfs&) = delete;
    fake_sysfs& operator=(const fake_sysfs&) = delete;

    void wait_for(unsigned milliseconds) const
    {
        std::ofstream(root / "class/tty/ttyUSB7/device/latency_timer") << milliseconds << "\n";
    }
    latency_text say(low_latency outcome, int error = 0) const
    {
        return describe({outcome, error}, root / "dev/pump", root);
    }

    std::filesystem::path root;
};

}  // namespace

TEST_CASE("low latency: the flag is added to what the driver has")
{
    fake_driver driver;
    driver.now.flags = ASYNC_SKIP_TEST;
    driver.now.close_delay = 50;
    CHECK(set_low_latency(driver).outcome == low_latency::set);
    CHECK(driver.now.flags == (ASYNC_SKIP_TEST | ASYNC_LOW_LATENCY));
    CHECK(driver.now.close_delay == 50);
    CHECK(driver.sets == 1);
    CHECK(set_low_latency(driver).outcome == low_latency::set);
    CHECK(driver.sets == 1);  // was set already
}

TEST_CASE("low latency: what drivers answer")
{
    const struct {
        int get_error;
        int set_error;
        bool keeps;
        low_latency outcome;
        int error;
    } rows[] = {
        // clang-format off
        {ENOTTY, 0,      true,  low_latency::absent,    0},
        {EINVAL, 0,      true,  low_latency::absent,    0},
        {EIO,    0,      true,  low_latency::refused,   EIO},
        {0,      ENOTTY, true,  low_latency::absent,    0},
        {0,      EINVAL, true,  low_latency::absent,    0},
        {0,      EPERM,  true,  low_latency::refused,   EPERM},
        {0,      0,      false, low_latency::forgotten, 0},
        // clang-format on
    };
    for (const auto& row : rows) {
        INFO(row.get_error << " " << row.set_error << " " << row.keeps);
        fake_driver driver;
        driver.get_error = row.get_error;
        driver.set_error = row.set_error;
        driver.keeps = row.keeps;
        const latency_report report = set_low_latency(driver);
        CHECK(report.outcome == row.outcome);
        CHECK(report.error == row.error);
    }
}

TEST_CASE("low latency: a pty has no such mode, and nothing has to be done about it")
{
    const int pty = ::posix_openpt(O_RDWR | O_NOCTTY);
    REQUIRE(pty >= 0);
    ::grantpt(pty);
    ::unlockpt(pty);
    const int port = ::open(::ptsname(pty), O_RDWR | O_NOCTTY);
    REQUIRE(port >= 0);
    const latency_report report = set_low_latency(port);
    CHECK(report.outcome == low_latency::absent);
    CHECK_FALSE(describe(report, ::ptsname(pty)).to_be_cured);
    ::close(port);
    ::close(pty);
}

TEST_CASE("low latency: an FTDI adapter that goes on waiting is told with its cure")
{
    const fake_sysfs sysfs;
    CHECK_FALSE(sysfs.say(low_latency::forgotten).to_be_cured);  // no FTDI adapter
    sysfs.wait_for(1);
    CHECK_FALSE(sysfs.say(low_latency::set).to_be_cured);
    CHECK(sysfs.say(low_latency::set).text == "low latency is set");
    sysfs.wait_for(16);
    for (const low_latency outcome : {low_latency::set, low_latency::absent, low_latency::forgotten}) {
        CHECK(sysfs.say(outcome).to_be_cured);
        CHECK(sysfs.say(outcome).text.find("16 ms: write 1 to " + sysfs.root.string() +
                                           "/class/tty/ttyUSB7/device/latency_timer") != std::string::npos);
    }
    const latency_text refused = sysfs.say(low_latency::refused, EPERM);
    CHECK(refused.text.find("(Operation not permitted)") != std::string::npos);
    CHECK(refused.text.find("udev") != std::string::npos);
}

TEST_SUITE_END();
