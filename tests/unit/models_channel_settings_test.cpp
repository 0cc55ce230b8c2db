// Format registers taken apart: FX3 manual 6.1 and 6.2, LS manual 4-2 and the example of 8-3.
#include "bridge/plc/channel_settings.hpp"
#include "tests/support/print.hpp"

#include <string>

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using namespace plcgw::plc;

namespace {

constexpr std::uint16_t fx3_client = 0x0001;
constexpr std::uint16_t fx3_server = 0x0011;
constexpr std::uint16_t fx3_ascii_server = 0x0111;

struct character_row {
    unsigned bits;  // b3 to b0
    unsigned data_bits;
    parity check;
    unsigned stop_bits;
};

const character_row character_rows[] = {
    {0x0, 7, parity::none, 1}, {0x1, 8, parity::none, 1}, {0x2, 7, parity::odd, 1},  {0x3, 8, parity::odd, 1},
    {0x6, 7, parity::even, 1}, {0x7, 8, parity::even, 1}, {0x8, 7, parity::none, 2}, {0x9, 8, parity::none, 2},
    {0xA, 7, parity::odd, 2},  {0xB, 8, parity::odd, 2},  {0xE, 7, parity::even, 2}, {0xF, 8, parity::even, 2},
};

struct baud_row {
    unsigned code;
    unsigned fx3;  // 0: invalid
    unsigned ls;
};

const baud_row baud_rows[] = {
    {0x0, 0, 0},       {0x1, 0, 0},           {0x2, 0, 0},         {0x3, 300, 0},
    {0x4, 600, 600},   {0x5, 1200, 1200},     {0x6, 2400, 2400},   {0x7, 4800, 4800},
    {0x8, 9600, 9600}, {0x9, 19200, 19200},   {0xA, 38400, 38400}, {0xB, 57600, 56000},
    {0xC, 0, 57600},   {0xD, 115200, 115200}, {0xE, 0, 0},         {0xF, 0, 0},
};

std::uint16_t word(unsigned value) { return static_cast<std::uint16_t>(value); }

void check_format(const settings_result& s, const character_row& row, unsigned baud_rate)
{
    REQUIRE(s.has_value());
    CHECK(s->enabled);
    CHECK(s->format.data_bits == row.data_bits);
    CHECK(s->format.check == row.check);
    CHECK(s->format.stop_bits == row.stop_bits);
    CHECK(s->format.baud_rate == baud_rate);
}

bool says(const settings_result& s, settings_fault::in at, const char* part)
{
    return s.has_error() && s.error().at == at && s.error().reason.find(part) != std::string::npos;
}

using in = settings_fault::in;

}  // namespace

TEST_CASE("channel settings: H1097 is RS-485, 19200 bit/s, 8E1")
{
    const auto s = decode_fx3(0x1097, fx3_client);
    check_format(s, {0, 8, parity::even, 1}, 19200);
    CHECK(s->rs485);
    CHECK(s->as == role::client);
    CHECK(s->mode == framing::rtu);
    CHECK_FALSE(decode_fx3(0x0097, fx3_client)->rs485);
}

TEST_CASE("channel settings: LS 4081H is a MODBUS server, RTU, 9600 bit/s, 8N1")
{
    const auto s = decode_ls(0x4081);
    check_format(s, {0, 8, parity::none, 1}, 9600);
    CHECK(s->as == role::server);
    CHECK(s->mode == framing::rtu);
    CHECK(decode_ls(0xC081)->as == role::client);
    CHECK(decode_ls(0x5081)->mode == framing::ascii);
    CHECK(decode_ls(0x6081)->mode == framing::tcp);
}

TEST_CASE("channel settings: data bits, parity and stop bits")
{
    for (const character_row& row : character_rows) {
        CAPTURE(row.bits);
        check_format(decode_fx3(word(0x90 | row.bits), fx3_ascii_server), row, 19200);
        check_format(decode_ls(word(0x5090 | row.bits)), row, 19200);
    }
    for (const unsigned bits : {0x4U, 0x5U, 0xCU, 0xDU}) {
        CAPTURE(bits);
        CHECK(says(decode_fx3(word(0x90 | bits), fx3_ascii_server), in::format, "parity"));
        CHECK(says(decode_ls(word(0x5090 | bits)), in::format, "parity"));
    }
}

TEST_CASE("channel settings: every baud rate, and every code that has none")
{
    for (const baud_row& row : baud_rows) {
        CAPTURE(row.code);
        const auto fx3 = decode_fx3(word(row.code << 4 | 1), fx3_server);
        const auto ls = decode_ls(word(0x4001 | row.code << 4));
        if (row.fx3 != 0)
            check_format(fx3, {0, 8, parity::none, 1}, row.fx3);
        else
            CHECK(says(fx3, in::format, "baud rate"));
        if (row.ls != 0)
            check_format(ls, {0, 8, parity::none, 1}, row.ls);
        else
            CHECK(says(ls, in::format, "baud rate"));
    }
    CHECK(says(decode_fx3(0x10C1, fx3_server), in::format, "1100"));
}

TEST_CASE("channel settings: protocol, role and frame mode of D8401")
{
    CHECK(decode_fx3(0x1097, fx3_server)->as == role::server);
    CHECK(decode_fx3(0x1097, fx3_ascii_server)->mode == framing::ascii);
    CHECK(decode_fx3(0x1097, 0x0101)->as == role::client);
}

TEST_CASE("channel settings: without MODBUS nothing else is looked at")
{
    for (const unsigned protocol : {0x0000, 0x0010, 0x0100, 0x0110}) {
        CHECK_FALSE(decode_fx3(0x0000, word(protocol))->enabled);
        CHECK_FALSE(decode_fx3(0xFFFF, word(protocol))->enabled);
    }
    for (const unsigned format : {0x0000, 0x0081, 0xB0F5, 0x8000})
        CHECK_FALSE(decode_ls(word(format))->enabled);
}

TEST_CASE("channel settings: reserved bits change nothing")
{
    check_format(decode_fx3(0xFF97, 0xFEFF), {0, 8, parity::even, 1}, 19200);
    check_format(decode_ls(0x4F81), {0, 8, parity::none, 1}, 9600);
}

TEST_CASE("channel settings: what cannot work is refused by its register")
{
    CHECK(says(decode_fx3(0x1096, fx3_server), in::format, "data length"));  // RTU with 7 bits
    CHECK(says(decode_ls(0x4080), in::format, "data length"));
    CHECK(says(decode_ls(0x7081), in::format, "mode (b13, b12)"));
    CHECK(decode_fx3(0x1096, fx3_ascii_server).has_value());
}

TEST_CASE("channel settings: a model refuses what it does not have")
{
    const model& fx3g = *find_model("FX3G");
    CHECK(says(decode(fx3g, fx3g.channels[0], 0x1097, fx3_ascii_server), in::protocol, "FX3G has RTU only"));
    CHECK(decode(fx3g, fx3g.channels[0], 0x1097, fx3_server).has_value());

    const model& fx3u = *find_model("FX3U");
    CHECK(decode(fx3u, fx3u.channels[1], 0x1097, fx3_ascii_server).has_value());
    CHECK(decode(fx3u, fx3u.channels[1], 0x1097, fx3_client)->as == role::client);

    const model& ls22 = *find_model("LS22");
    CHECK(decode(ls22, ls22.channels[0], 0xC081, 0)->as == role::client);
    CHECK(says(decode(ls22, ls22.channels[1], 0xC081, 0), in::format, "channel 2"));
    CHECK(says(decode(ls22, ls22.channels[2], 0xC081, 0), in::format, "channel 3"));
    CHECK(decode(ls22, ls22.channels[2], 0x5080, 0)->format.data_bits == 7);
    CHECK_FALSE(decode(ls22, ls22.channels[2], 0x8081, 0)->enabled);  // no MODBUS: its role does not matter
}

TEST_CASE("channel settings: encoded ones decode to the same")
{
    for (const baud_row& row : baud_rows)
        for (const character_row& characters : character_rows)
            for (const unsigned protocol : {0x001U, 0x011U, 0x101U, 0x111U}) {
                const auto fx3 = decode_fx3(word(0x1000 | row.code << 4 | characters.bits), word(protocol));
                if (fx3) {
                    CHECK(encode_fx3_format(*fx3) == (0x1000 | row.code << 4 | characters.bits));
                    CHECK(encode_fx3_protocol(*fx3) == protocol);
                }
                for (const unsigned high : {0x4000U, 0x5000U, 0x6000U, 0xC000U}) {
                    const auto ls = decode_ls(word(high | row.code << 4 | characters.bits));
                    if (ls)
                        CHECK(encode_ls(*ls) == (high | row.code << 4 | characters.bits));
                }
            }
    CHECK(encode_fx3_format(*decode_fx3(0x0097, fx3_client)) == 0x0097);
    channel_settings odd{.enabled = true};
    odd.format.baud_rate = 14400;
    CHECK_FALSE(encode_fx3_format(odd).has_value());
    CHECK_FALSE(encode_ls(odd).has_value());
}

TEST_SUITE_END();
