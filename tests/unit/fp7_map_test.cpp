// FP7 manual, table 8.2: which functions an FP7 answers, and where each number leads. Over TCP and on a serial line.
#include "bridge/plc/models/fp7.hpp"
#include "bridge/services/modbus_service.hpp"
#include "bridge/services/modbus_station.hpp"
#include "tests/support/print.hpp"

#include <string>

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using modbus::table;

namespace {

constexpr modbus::unit_id unit{5};

// Both servers must say the same.
class asked {
public:
    buffer operator()(const buffer& pdu)
    {
        const buffer over_tcp = serve_pdu(plc, pdu, "1.0");
        const auto serial = station.answer({unit, pdu});
        station.sent();
        REQUIRE(serial.has_value());
        CHECK(*serial == over_tcp);
        return over_tcp;
    }

    plc::place at(const char* device) const
    {
        return plc.memory().find(plc::parse_device(device, plc::fp7.names).value()).value();
    }
    bool bit(const char* device) const { return plc.memory().bit(at(device)); }
    unsigned word(const char* device) const { return plc.memory().word(at(device)); }

    plc::simulated_plc plc{"panel", plc::fp7, {}};
    modbus_station station{plc, unit, 1};
};

std::uint8_t high(unsigned number) { return static_cast<std::uint8_t>(number >> 8); }
std::uint8_t low(unsigned number) { return static_cast<std::uint8_t>(number & 0xFF); }

buffer pdu(unsigned function, unsigned first, unsigned second)
{
    return {low(function), high(first), low(first), high(second), low(second)};
}

struct printed_row {
    unsigned read;  // function
    unsigned first;
    unsigned last;
    const char* head;
    const char* end;
    bool hole_behind;
};

// clang-format off
const printed_row printed[] = {
    {0x01, 0x0000, 0x07FF, "Y0",  "Y127F",   false},  // R0 follows
    {0x01, 0x0800, 0x87FF, "R0",  "R2047F",  true},
    {0x02, 0x0000, 0x1FFF, "X0",  "X511F",   true},
    {0x03, 0x0000, 0xFFFF, "DT0", "DT65535", false},  // the last number that there is
    {0x04, 0x0000, 0x03FF, "WL0", "WL1023",  true},
    {0x04, 0x07D0, 0x47CF, "LD0", "LD16383", true},
};
// clang-format on

}  // namespace

TEST_CASE("fp7 map: first and last number of every row of table 8.2 lead to the printed devices, one behind nowhere")
{
    for (const printed_row& row : printed) {
        CAPTURE(row.head);
        asked ask;
        for (const auto& [number, device] : {std::pair{row.first, row.head}, std::pair{row.last, row.end}}) {
            CAPTURE(device);
            if (row.read <= 2) {
                CHECK(ask(pdu(row.read, number, 1)) == buffer{low(row.read), 1, 0x00});
                ask.plc.memory().set_bit(ask.at(device), true);
                CHECK(ask(pdu(row.read, number, 1)) == buffer{low(row.read), 1, 0x01});
            }
            else {
                ask.plc.memory().set_word(ask.at(device), 0x1234);
                CHECK(ask(pdu(row.read, number, 1)) == buffer{low(row.read), 2, 0x12, 0x34});
            }
        }
        if (row.hole_behind) {
            CHECK(ask(pdu(row.read, row.last + 1, 1)) == buffer{low(row.read | 0x80), 0x02});
            CHECK(ask(pdu(row.read, row.last, 2)) == buffer{low(row.read | 0x80), 0x02});
        }
    }
}

TEST_CASE("fp7 map: holes are exception 02")
{
    asked ask;
    for (const auto& [function, number] : {std::pair{1U, 0x8800U},
                                           {1U, 0xFFFFU},
                                           {2U, 0x2000U},
                                           {2U, 0xFFFFU},
                                           {4U, 0x0400U},
                                           {4U, 0x07CFU},
                                           {4U, 0x47D0U},
                                           {4U, 0xFFFFU}}) {
        CAPTURE(function);
        CAPTURE(number);
        CHECK(ask(pdu(function, number, 1)) == buffer{low(function | 0x80), 0x02});
    }
    CHECK(ask(pdu(4, 0x07CF, 2)) == buffer{0x84, 0x02});  // before LD0
    CHECK(ask(pdu(3, 0xFFFF, 2)) == buffer{0x83, 0x02});
    CHECK(ask(pdu(5, 0x8800, 0xFF00)) == buffer{0x85, 0x02});
}

TEST_CASE("fp7 map: a read goes from Y127F on to R0")
{
    asked ask;
    ask.plc.memory().set_bit(ask.at("Y127F"), true);
    ask.plc.memory().set_bit(ask.at("R1"), true);
    CHECK(ask(pdu(1, 0x07FE, 4)) == buffer{0x01, 1, 0b1010});
}

TEST_CASE("fp7 map: functions 05, 06, 15 and 16 write what the table says")
{
    asked ask;
    CHECK(ask(pdu(0x05, 0x0000, 0xFF00)) == pdu(0x05, 0x0000, 0xFF00));
    CHECK(ask.bit("Y0"));
    CHECK(ask(pdu(0x05, 0x87FF, 0xFF00)) == pdu(0x05, 0x87FF, 0xFF00));
    CHECK(ask.word("WR2047") == 0x8000);
    CHECK(ask(pdu(0x06, 0xFFFF, 0xBEEF)) == pdu(0x06, 0xFFFF, 0xBEEF));
    CHECK(ask.word("DT65535") == 0xBEEF);
    CHECK(ask({0x0F, 0x08, 0x1C, 0x00, 0x05, 0x01, 0x1A}) == buffer{0x0F, 0x08, 0x1C, 0x00, 0x05});  // from R1C
    CHECK(ask.word("WR1") == 0xA000);
    CHECK(ask.bit("R20"));
    CHECK(ask({0x10, 0x00, 0x64, 0x00, 0x02, 0x04, 0x00, 0x05, 0x00, 0x06}) == buffer{0x10, 0x00, 0x64, 0x00, 0x02});
    CHECK(ask.word("DT100") == 5);
    CHECK(ask.word("DT101") == 6);
}

TEST_CASE("fp7 map: what the table does not mark is exception 01")
{
    const buffer whole_requests[] = {
        {0x08, 0x00, 0x00, 0x12, 0x34},                                            // listed, without a mark
        {0x16, 0x00, 0x00, 0xFF, 0xFF, 0x00, 0x00},                                // likewise
        {0x17, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x02, 0x00, 0x01},  // likewise
        {0x07},
        {0x0B},
        {0x0C},
        {0x11},
        {0x2B, 0x0E, 0x01, 0x00},
    };
    asked ask;
    for (const buffer& request : whole_requests)
        CHECK(ask(request) == buffer{low(request[0] | 0x80U), 0x01});
    for (unsigned function = 1; function < 0x80; ++function) {
        CAPTURE(function);
        const bool marked = (function >= 1 && function <= 6) || function == 15 || function == 16;
        CHECK((ask({low(function)}) == buffer{low(function | 0x80), 0x01}) == !marked);
    }
}

TEST_CASE("fp7 map: every port of the CPU can be a station, no other")
{
    plc::simulated_plc plc("panel", plc::fp7, {});
    for (const unsigned com : {0U, 1U, 2U})
        CHECK(modbus_station(plc, unit, com).answer({unit, pdu(3, 0, 1)}) == buffer{0x03, 2, 0, 0});
    CHECK_THROWS(modbus_station(plc, unit, 3));
    plc.stop();
    plc.run();
    plc.power_cycle();
    CHECK(plc.faults().empty());
    CHECK(plc.memory().take_changes().empty());  // no special devices
}

TEST_SUITE_END();
