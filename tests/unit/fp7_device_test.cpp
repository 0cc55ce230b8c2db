// Device names and memory of an FP7: contacts by word and bit, and the same bits as words.
#include "bridge/plc/memory.hpp"
#include "bridge/plc/models/fp7.hpp"
#include "tests/support/print.hpp"

#include <string>

TEST_SUITE_BEGIN("plc");

using namespace plcgw::plc;

namespace {

struct device_row {
    const char* text;
    device parsed;
};

// clang-format off
const device_row rows[] = {
    {"X0",      {device_kind::x, 0}},
    {"XA",      {device_kind::x, 10}},
    {"X10",     {device_kind::x, 16}},
    {"X1F",     {device_kind::x, 31}},
    {"X511F",   {device_kind::x, 8191}},
    {"Y127F",   {device_kind::y, 2047}},
    {"R2047F",  {device_kind::relay, 32767}},
    {"L1023F",  {device_kind::link_relay, 16383}},
    {"LD",      {device_kind::link_relay, 13}},  // bit D of word 0: link registers have a number behind LD
    {"LD0",     {device_kind::ld, 0}},
    {"LD16383", {device_kind::ld, 16383}},
    {"WX511",   {device_kind::wx, 511}},
    {"WY511",   {device_kind::wy, 511}},
    {"WR2047",  {device_kind::wr, 2047}},
    {"WL1023",  {device_kind::wl, 1023}},
    {"DT65535", {device_kind::d, 65535}},
    {"T4095",   {device_kind::ts, 4095}},
    {"C1023",   {device_kind::cs, 1023}},
    {"TS5",     {device_kind::timer_set, 5}},
    {"TE5",     {device_kind::tn, 5}},
    {"CS5",     {device_kind::counter_set, 5}},
    {"CE5",     {device_kind::cn, 5}},
    {"UM126",   {device_kind::um, 126}},
};
// clang-format on

std::optional<device> parsed(const char* text) { return parse_device(text, fp7.names); }

place at(const memory& m, const char* text) { return m.find(parsed(text).value()).value(); }

}  // namespace

TEST_CASE("fp7 device: names are read and printed as the manual writes them")
{
    for (const device_row& row : rows) {
        CAPTURE(row.text);
        CHECK(parsed(row.text) == row.parsed);
        CHECK(to_string(row.parsed, fp7.names) == row.text);
        CHECK(exists(fp7, row.parsed));
    }
}

TEST_CASE("fp7 device: lower case, leading zeros and the other names of timer values are read")
{
    CHECK(parsed("x001f") == device{device_kind::x, 31});
    CHECK(parsed("R0012") == device{device_kind::relay, 18});
    CHECK(parsed("dt00100") == device{device_kind::d, 100});
    CHECK(parsed("TSV5") == parsed("TS5"));
    CHECK(parsed("tev5") == parsed("TE5"));
    CHECK(parsed("CSV5") == parsed("CS5"));
    CHECK(parsed("CEV5") == parsed("CE5"));
}

TEST_CASE("fp7 device: what is no device name")
{
    for (const char* text :
         {"",    "X",    "R",  "DT", "WR",  "X1G", "XG",  "R1.5", "X-1", "WR1F",         "DT1F",       "LD1F",
          "T1F", "D100", "M0", "S0", "TN5", "Z5",  "FL5", "X 1",  "X1 ", "DT4294967296", "R2684354560"}) {
        CAPTURE(text);
        CHECK_FALSE(parsed(text).has_value());
    }
    CHECK(parsed("R268435455F") == device{device_kind::relay, 0xFFFFFFFF});
    CHECK_FALSE(parse_device("DT5").has_value());  // of an FX3
    CHECK_THROWS_AS(to_string(device{device_kind::relay, 0}), std::logic_error);
}

TEST_CASE("fp7 device: one behind the last does not exist")
{
    const memory m(fp7);
    for (const char* text : {"X5120", "Y5120", "R20480", "L10240", "WX512", "WY512", "WR2048", "WL1024", "DT65536",
                             "LD16384", "T4096", "C1024", "TS4096", "TE4096", "CS1024", "CE1024", "UM300"}) {
        CAPTURE(text);
        REQUIRE(parsed(text).has_value());
        CHECK_FALSE(exists(fp7, *parsed(text)));
        CHECK_FALSE(m.find(*parsed(text)).has_value());
    }
}

TEST_CASE("fp7 device: contacts and their words are the same memory")
{
    const std::pair<const char*, const char*> contacts[] = {
        {"X1F", "WX1"}, {"Y511F", "WY511"}, {"R2047F", "WR2047"}, {"L3F", "WL3"}};
    memory m(fp7);
    for (const auto& [contact, word] : contacts) {
        CAPTURE(contact);
        m.set_bit(at(m, contact), true);
        CHECK(m.word(at(m, word)) == 0x8000);
        m.set_word(at(m, word), 0x0001);
        CHECK_FALSE(m.bit(at(m, contact)));
    }
    CHECK(m.bit(at(m, "R20470")));
    CHECK(m.bits_from(at(m, "WR2047")) == 16);
    CHECK(is_bit_kind(parsed("R0")->kind));
    CHECK_FALSE(is_bit_kind(parsed("WR0")->kind));
}

TEST_CASE("fp7 device: values of timers and counters have 32 bits, low word first, apart from their contacts")
{
    memory m(fp7);
    CHECK(m.bits_from(at(m, "TS4095")) == 32);
    CHECK(m.bits_from(at(m, "CE1023")) == 32);
    const place elapsed = at(m, "TE1");
    CHECK(elapsed.bit == 32);
    m.set_word(elapsed, 99);
    CHECK(m.word(at(m, "TS1")) == 0);
    CHECK_FALSE(m.bit(at(m, "T1")));
}

TEST_SUITE_END();
