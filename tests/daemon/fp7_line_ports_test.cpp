// What a line tells the COM port of an FP7 that it stands for: FP7 manual 4.1 and 10.3.2.
#include "bridge/plc/models/fp7.hpp"
#include "daemon/fp7_line_ports.hpp"
#include "daemon/fp7_ports.hpp"
#include "daemon/read_before.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("serial");

using namespace plcgw;
using namespace std::chrono_literals;

namespace {

struct bench {
    bench()
    {
        unit.open(now(), 1, {.mode = plc::com_mode::general_purpose}, plc::com_card::rs485);
        ports.add(nullptr, 0);  // of no FP7
        ports.add(&unit, 1);
    }

    bool is(plc::device_kind kind, std::uint32_t number) const
    {
        return plc.memory().bit(*plc.memory().find({kind, number}));
    }

    plc::simulated_plc plc{"panel", plc::fp7, {}};
    fp7_unit unit{plc};
    fp7_line_ports ports;
};

}  // namespace

TEST_CASE("com ports: why a message was dropped, as bits of the receive error code")
{
    const struct {
        errc why;
        unsigned code;   // D+2
        unsigned count;  // D+3
    } rows[] = {
        {errc::overrun, 1U << 0, 1},    {errc::bad_stop_bit, 1U << 1, 1},
        {errc::bad_parity, 1U << 2, 1}, {errc::overlong, 1U << 8, 0},  // the count is of the low byte
        {errc::restarted, 0, 0},        {errc::incomplete, 0, 0},
    };
    for (const auto& row : rows) {
        CAPTURE(row.code);
        bench b;
        b.ports.note(row.why);
        CHECK(b.unit.monitor(1).receive_errors == row.code);
        CHECK(b.unit.monitor(1).receive_error_count == row.count);
    }
    bench b;
    b.ports.note(bit_errors{.overrun = 1, .framing = 2, .parity = 3});
    CHECK(b.unit.monitor(1).receive_errors == 0b111);
    CHECK(b.unit.monitor(1).receive_error_count == 6);
}

TEST_CASE("com ports: what happens on the line, as contacts")
{
    using kind = plc::device_kind;
    bench b;
    CHECK_FALSE(b.ports.empty());
    CHECK(fp7_line_ports().empty());
    b.ports.show({.message_waits = true});
    CHECK(b.is(kind::x, 0x0));
    b.ports.copied();
    CHECK(b.is(kind::x, 0x4));
    b.ports.sends(now() + 1h);
    CHECK(b.is(kind::y, 0x8));
    b.ports.note(plc::setting_error::send_count);
    CHECK(b.unit.monitor(1).setting_errors == 1U << 9);
    b.ports.reset_done();
    for (const unsigned x : {0x0U, 0x4U, 0x10U})
        CHECK_FALSE(b.is(kind::x, x));  // X10: nobody asked for it by Y10
    CHECK_FALSE(b.is(kind::y, 0x8));
    CHECK(b.unit.monitor(1).setting_errors == 0);
}

TEST_CASE("com ports: the parameters of a general-purpose line")
{
    line_config line;
    line.protocol = line_protocol::general_purpose;
    line.baud_rate = 230'400;
    line.gap = 7ms;  // not of the PLC
    line.messages.send_wait = 100ms;
    line.messages.start = general_purpose::start_code::stx;
    const struct {
        general_purpose::end_code end;
        unsigned code;  // D+9
    } rows[] = {{general_purpose::end_code::cr, 0},
                {general_purpose::end_code::cr_lf, 1},
                {general_purpose::end_code::silence, 2},
                {general_purpose::end_code::etx, 3}};
    for (const auto& row : rows) {
        line.messages.end = row.end;
        line.messages.end_silence = 20us;
        const auto words = plc::parameter_words(com_parameters_of(line, 1));
        const unsigned expected[] = {8, 1, 10, 1, 2, 0, 0, 10'000, 1, row.code, 2};
        for (std::size_t i = 0; i < std::size(expected); ++i)
            CHECK(words[i] == expected[i]);
    }
    line.protocol = line_protocol::mewtocol_com;
    const auto words = plc::parameter_words(com_parameters_of(line, 1));
    CHECK(words[0] == 0);
    CHECK(words[7] == 700);
    CHECK(words[8] == 0);
}

TEST_SUITE_END();
