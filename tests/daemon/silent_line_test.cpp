// The driver of a pair's line on a pty: what it says and hears when it may not speak.
#include "daemon/mewtocol_line.hpp"
#include "daemon/serial_line.hpp"
#include "protocols/modbus/rtu.hpp"
#include "tests/support/plc_fixture.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <doctest/doctest.h>

#include <fcntl.h>
#include <termios.h>
#include <thread>

TEST_SUITE_BEGIN("serial");

using namespace plcgw;
using namespace std::chrono_literals;

namespace {

const modbus::unit_id pump{5};
const buffer asks = modbus::encode_rtu({pump, {0x03, 0x00, 0x10, 0x00, 0x01}});
const buffer answers = modbus::encode_rtu({pump, {0x03, 0x02, 0x00, 0x2A}});
const buffer others_ask = modbus::encode_rtu({pump, {0x03, 0x00, 0x0F, 0x00, 0x03}});
const buffer others_hear = modbus::encode_rtu({pump, {0x03, 0x06, 0x00, 0x01, 0x00, 0x02, 0x00, 0x03}});

// The other end of a serial port.
struct far_end {
    far_end() : fd(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC))
    {
        REQUIRE(fd >= 0);
        ::grantpt(fd);
        ::unlockpt(fd);
        device = ::ptsname(fd);
    }
    ~far_end() { ::close(fd); }
    far_end(const far_end&) = delete;
    far_end& operator=(const far_end&) = delete;

    void say(bytes what) const { REQUIRE(::write(fd, what.data(), what.size()) == static_cast<ssize_t>(what.size())); }
    buffer take() const
    {
        buffer room(1000);
        const auto size = ::read(fd, room.data(), room.size());
        room.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
        return room;
    }

    int fd;
    std::string device;
};

struct member : test::fx3u_fixture {
    member()
    {
        config.name = "line";
        config.device = port.device;
        config.check = parity::none;
        config.response_timeout = 100ms;
        routes.add_route(route_to("D100", modbus::table::holding_registers, 0x10, 1), 0, 100ms);
    }

    void run(line_driver& driver)
    {
        asio::co_spawn(loop, driver.run(), asio::detached);
        until([&] { return voice.heard.port_open; });
    }

    // Runs until that holds, for 20 seconds at most.
    template <class Condition>
    void until(Condition holds)
    {
        const time_point end = now() + 20s;
        while (!holds()) {
            REQUIRE(now() < end);
            loop.run_for(5ms);
        }
    }
    void run_for(duration how_long) { loop.run_for(how_long); }

    // Somebody else's exchange, and silence behind it.
    void others_talk()
    {
        port.say(others_ask);
        run_for(30ms);
        port.say(others_hear);
        run_for(30ms);
    }

    far_end port;
    line_config config;
    client_line routes{"line", {{"pump", pump, {.format = {}, .response_timeout = 100ms, .retries = 1}}}, {}};
    line_voice voice;
    asio::io_context loop;
};

}  // namespace

TEST_CASE("silent line: it says nothing, and what it hears fills the memory")
{
    member m;
    serial_line driver(m.loop, m.config, m.routes, [] {});
    driver.obey(m.voice);
    m.run(driver);
    CHECK(m.voice.heard.listens);
    m.run_for(400ms);  // several periods
    CHECK(m.port.take().empty());
    CHECK_FALSE(m.voice.heard.anything.has_value());
    m.until([&] {
        m.others_talk();
        return m.word("D100") == 2;
    });
    CHECK(m.routes.route_at(0).state == quality::good);
    CHECK(m.voice.heard.anything.has_value());
    CHECK(m.voice.heard.foreign_request.has_value());
    CHECK(m.port.take().empty());
}

TEST_CASE("silent line: it asks while it may, and not a byte after that")
{
    member m;
    serial_line driver(m.loop, m.config, m.routes, [] {});
    driver.obey(m.voice);
    m.run(driver);
    m.voice.speak_until(now() + 1h);
    driver.wake();
    buffer said;
    m.until([&] { return !(said = m.port.take()).empty(); });
    m.port.say(answers);
    m.until([&] { return m.word("D100") == 0x2A; });
    CHECK(said == asks);
    CHECK_FALSE(m.voice.heard.foreign_request.has_value());

    m.until([&] { return !m.port.take().empty(); });  // the next question, which has a repetition before it
    m.voice.be_silent();
    m.run_for(500ms);
    CHECK(m.port.take().empty());

    m.voice.speak_until(now() + 1h);  // without a wake-up
    m.until([&] { return !m.port.take().empty(); });
    m.voice.speak_until(now());
    m.run_for(500ms);
    CHECK(m.port.take().empty());
}

TEST_CASE("silent line: what others ask while we speak is heard")
{
    member m;
    serial_line driver(m.loop, m.config, m.routes, [] {});
    driver.obey(m.voice);
    m.run(driver);
    m.voice.speak_until(now() + 1h);
    driver.wake();
    m.until([&] { return !m.port.take().empty(); });
    CHECK_FALSE(m.voice.heard.foreign_request.has_value());
    m.until([&] {
        m.others_talk();
        return m.voice.heard.foreign_request.has_value();
    });
}

TEST_CASE("silent line: the same on a MEWTOCOL line")
{
    member m;
    m.config.protocol = line_protocol::mewtocol_com;
    route r = m.route_to("D200", modbus::table::holding_registers, 0, 1);
    r.there = *mewtocol::parse_device("DT1");
    client_line routes{"line", {{"press", station_number(1U), {.format = {}, .response_timeout = 100ms}}}, {}};
    routes.add_route(std::move(r), 0, 100ms);
    mewtocol_line driver(m.loop, m.config, routes, [] {});
    driver.obey(m.voice);
    m.run(driver);
    const std::string asked = "%01#RDD0000000002**\r";
    const std::string said = "%01$RD070008000900**\r";
    m.until([&] {
        m.port.say(buffer(asked.begin(), asked.end()));
        m.run_for(20ms);
        m.port.say(buffer(said.begin(), said.end()));
        m.run_for(20ms);
        return m.word("D200") == 8;
    });
    CHECK(m.voice.heard.foreign_request.has_value());
    m.run_for(300ms);
    CHECK(m.port.take().empty());
    m.voice.speak_until(now() + 1h);
    driver.wake();
    m.until([&] { return !m.port.take().empty(); });
}

TEST_CASE("silent line: what waited while this process stood still is no news")
{
    member m;
    serial_line driver(m.loop, m.config, m.routes, [] {});
    driver.obey(m.voice);
    m.run(driver);
    m.until([&] {
        m.others_talk();
        return m.word("D100") == 2;
    });
    const buffer old_answer = modbus::encode_rtu({pump, {0x03, 0x06, 0x00, 0x09, 0x00, 0x09, 0x00, 0x09}});
    m.port.say(others_ask);
    m.port.say(old_answer);
    std::this_thread::sleep_for(1100ms);  // SIGSTOP
    m.run_for(200ms);
    CHECK(m.word("D100") == 2);
    m.until([&] {  // and it hears on
        m.port.say(others_ask);
        m.port.say(old_answer);
        m.run_for(50ms);
        return m.word("D100") == 9;
    });
}

TEST_CASE("silent line: a port that is lost is said, and found again")
{
    member m;
    serial_line driver(m.loop, m.config, m.routes, [] {});
    driver.obey(m.voice);
    m.run(driver);
    ::close(m.port.fd);
    m.until([&] { return !m.voice.heard.port_open; });
    m.port.fd = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    CHECK(m.routes.route_at(0).state == quality::comm_error);
}

TEST_SUITE_END();
