#include "protocols/serial_timing.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

TEST_SUITE_BEGIN("serial");

using namespace plcgw;
using namespace plcgw::test;

namespace {

struct timing_row {
    character_format format;
    unsigned bits;  // of one character
    duration one;   // character
    duration ten;   // characters
    duration gap;   // 3.5 characters, or 1750 us above 19200 bit/s
};

// clang-format off
const timing_row rows[] = {
    //   baud  data  parity        stop  bits    one       ten        gap
    {{   1200, 8,    parity::even, 1},   11,  9'167us,  91'667us,  32'084us},
    {{   9600, 8,    parity::none, 1},   10,  1'042us,  10'417us,   3'646us},
    {{   9600, 8,    parity::even, 1},   11,  1'146us,  11'459us,   4'011us},
    {{  19200, 8,    parity::even, 1},   11,    573us,   5'730us,   2'006us},
    {{  19200, 8,    parity::none, 2},   11,    573us,   5'730us,   2'006us},
    {{  19200, 7,    parity::odd,  1},   10,    521us,   5'209us,   1'823us},
    {{  38400, 8,    parity::even, 1},   11,    287us,   2'865us,   1'750us},
    {{ 115200, 8,    parity::none, 1},   10,     87us,     869us,   1'750us},
    {{    300, 8,    parity::even, 2},   12, 40'000us, 400'000us, 140'000us},
};
// clang-format on

}  // namespace

TEST_CASE("serial timing: bits, characters and the gap between frames, rounded up")
{
    for (const timing_row& row : rows) {
        CAPTURE(row.format.baud_rate);
        CHECK(bits_per_character(row.format) == row.bits);
        CHECK(character_time(row.format, 0) == 0us);
        CHECK(character_time(row.format, 1) == row.one);
        CHECK(character_time(row.format, 10) == row.ten);
        CHECK(frame_gap(row.format) == row.gap);
    }
}

TEST_CASE("serial timing: a megabyte at 300 bit/s does not overflow")
{
    CHECK(character_time({.baud_rate = 300}, 1'000'000) == 36'666'666'667us);
}

TEST_CASE("serial timing: the default is MODBUS's own, 19200 bit/s, 8 bits, even parity, one stop bit")
{
    CHECK(bits_per_character({}) == 11);
    CHECK(frame_gap({}) == 2006us);
}

TEST_SUITE_END();
