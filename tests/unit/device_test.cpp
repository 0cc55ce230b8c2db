#include "bridge/plc/device.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("plc");

using namespace plcgw::plc;

namespace {

struct device_row {
    const char* text;
    device parsed;
};

const device_row rows[] = {
    {"D1000", {device_kind::d, 1000}},
    {"D0", {device_kind::d, 0}},
    {"R32767", {device_kind::r, 32767}},
    {"M8411", {device_kind::m, 8411}},
    {"S4095", {device_kind::s, 4095}},
    {"TS511", {device_kind::ts, 511}},
    {"CS255", {device_kind::cs, 255}},
    {"TN0", {device_kind::tn, 0}},
    {"CN200", {device_kind::cn, 200}},
    {"X0", {device_kind::x, 0}},
    {"X7", {device_kind::x, 7}},
    {"X10", {device_kind::x, 8}},
    {"X17", {device_kind::x, 15}},
    {"X377", {device_kind::x, 255}},
    {"Y20", {device_kind::y, 16}},
    {"Y377", {device_kind::y, 255}},
    {"D4294967295", {device_kind::d, 0xFFFFFFFF}},
};

}  // namespace

TEST_CASE("device: names are read and printed as the manuals write them")
{
    for (const device_row& row : rows) {
        CAPTURE(row.text);
        CHECK(parse_device(row.text) == row.parsed);
        CHECK(to_string(row.parsed) == row.text);
    }
}

TEST_CASE("device: lower case and leading zeros are read, upper case is printed")
{
    CHECK(parse_device("d1000") == device{device_kind::d, 1000});
    CHECK(parse_device("x17") == device{device_kind::x, 15});
    CHECK(parse_device("cn200") == device{device_kind::cn, 200});
    CHECK(parse_device("Tn5") == device{device_kind::tn, 5});
    CHECK(parse_device("Y001") == device{device_kind::y, 1});
    CHECK(to_string(*parse_device("ts007")) == "TS7");
}

TEST_CASE("device: what is no device name")
{
    for (const char* text : {"",    "D",    "17",    "X8", "X9",   "Y18", "X1A", "D-1", "D+1", "D 1", "D1 ",
                             " D1", "D1.0", "D0x10", "Q1", "C200", "T0",  "DD1", "D1D", "K10", "H10", "D4294967296"}) {
        CAPTURE(text);
        CHECK_FALSE(parse_device(text).has_value());
    }
}

TEST_CASE("device: contacts are bits, values are words")
{
    for (const char* text : {"X0", "Y0", "M0", "S0", "TS0", "CS0"})
        CHECK(is_bit_kind(parse_device(text)->kind));
    for (const char* text : {"D0", "R0", "TN0", "CN0"})
        CHECK_FALSE(is_bit_kind(parse_device(text)->kind));
}

TEST_SUITE_END();
