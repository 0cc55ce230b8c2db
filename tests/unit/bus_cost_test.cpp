// How long an exchange keeps the bus busy.
#include "bridge/routes/bus_cost.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::test;

namespace {

station_question registers(std::uint16_t count)
{
    return read_question(modbus_place{modbus::table::holding_registers, modbus::address{0}}, count);
}
station_question words(std::uint32_t count)
{
    return read_question(mewtocol::word_device{mewtocol::word_area::dt, 100}, count);
}

constexpr character_format at_9600{.baud_rate = 9600, .data_bits = 8, .check = parity::none, .stop_bits = 1};
constexpr character_format at_115200{.baud_rate = 115'200, .data_bits = 8, .check = parity::even, .stop_bits = 1};
constexpr duration none{};

}  // namespace

TEST_CASE("bus cost: request, turnaround, response and the silence behind it")
{
    const struct {
        const char* name;
        bus_timing bus;
        station_question asked;
        duration expected;
    } rows[] = {
        // 8 + 5 + 2 n characters of 10 bits, and 3.5 more
        {"RTU, one register", {.format = at_9600, .turnaround = none}, registers(1), 8334us + 7292us + 3646us},
        {"RTU, ten", {.format = at_9600, .turnaround = none}, registers(10), 8334us + 26042us + 3646us},
        {"RTU above 19200: 1.75 ms", {.format = at_115200, .turnaround = none}, registers(1), 764us + 669us + 1750us},
        {"RTU, turnaround and a longer gap",
         {.format = at_115200, .gap = 5ms, .turnaround = 3ms},
         registers(1),
         764us + 669us + 8ms},
        // ":" and two characters for each of 6 + LRC bytes, CR LF
        {"ASCII",
         {.protocol = bus_protocol::modbus_ascii, .format = at_9600, .turnaround = none},
         registers(1),
         17709us + 15625us + 3646us},
        {"TCP", {.protocol = bus_protocol::modbus_tcp, .turnaround = 5ms}, registers(10), 41us + 5ms},
        // %01#RDD0010000100** and CR, %01$RD0000** and CR, one character
        {"MEWTOCOL",
         {.protocol = bus_protocol::mewtocol_com, .format = at_9600, .turnaround = none},
         words(1),
         20834us + 13542us + 1042us},
        {"two frames of MEWTOCOL",
         {.protocol = bus_protocol::mewtocol_com,
          .format = at_9600,
          .turnaround = none,
          .headers = mewtocol::headers::normal},
         words(28),
         2 * (20834us + 1042us) + 117709us + 17709us},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        CHECK(exchange_time(row.bus, row.asked) == row.expected);
    }
}

TEST_CASE("bus cost: the turnaround is what is left of the time until the answer was there")
{
    const bus_timing bus{.format = at_9600};
    CHECK(turnaround_in(bus, registers(1), 10ms) == 10ms - 7292us);
    CHECK(turnaround_in(bus, registers(1), 7ms) == none);
    const bus_timing com{.protocol = bus_protocol::mewtocol_com, .format = at_9600};
    CHECK(turnaround_in(com, words(1), 20ms) == 20ms - 13542us);
}

TEST_CASE("bus cost: what one exchange carries")
{
    const bus_timing rtu;
    CHECK(is_one_exchange(rtu, registers(125)));
    CHECK_FALSE(is_one_exchange(rtu, registers(126)));
    const bus_timing com{.protocol = bus_protocol::mewtocol_com};
    CHECK(is_one_exchange(com, words(509)));
    CHECK_FALSE(is_one_exchange(com, words(510)));
    const bus_timing normal{.protocol = bus_protocol::mewtocol_com, .headers = mewtocol::headers::normal};
    CHECK(is_one_exchange(normal, words(27)));
    CHECK_FALSE(is_one_exchange(normal, words(28)));
    const bus_timing seven{.protocol = bus_protocol::mewtocol7_com};
    CHECK(is_one_exchange(seven, words(1000)));
    CHECK_FALSE(is_one_exchange(seven, words(1024)));
}

TEST_CASE("bus cost: a longer read never costs less")
{
    for (const bus_protocol protocol :
         {bus_protocol::modbus_rtu, bus_protocol::modbus_ascii, bus_protocol::modbus_tcp}) {
        const bus_timing bus{.protocol = protocol};
        for (std::uint16_t n = 1; n < 125; ++n)
            CHECK(exchange_time(bus, registers(n)) <= exchange_time(bus, registers(n + 1)));
    }
    for (const bus_protocol protocol : {bus_protocol::mewtocol_com, bus_protocol::mewtocol7_com}) {
        const bus_timing bus{.protocol = protocol};
        for (std::uint32_t n = 1; n < 1000; ++n)
            CHECK(exchange_time(bus, words(n)) <= exchange_time(bus, words(n + 1)));
    }
}

TEST_SUITE_END();
