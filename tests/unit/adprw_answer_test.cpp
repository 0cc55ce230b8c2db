#include "tests/unit/adprw_fixture.hpp"

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using plcgw::test::adprw_fixture;
using plcgw::test::preset;

namespace {

struct row {
    const char* name;
    const char* line;
    std::vector<preset> before;
    buffer answer;  // the PDU
    std::vector<preset> after;
};

const row rows[] = {
    {"01 into D, all bits",
     "ADPRW H5 H1 H0 K16 D100",
     {{"D99", 9}, {"D101", 9}},
     {0x01, 0x02, 0x34, 0x12},
     {{"D99", 9}, {"D100", 0x1234}, {"D101", 9}}},
    {"01 into D: only the bits asked for change",
     "ADPRW H5 H1 H0 K5 D100",
     {{"D100", 0xFFFF}, {"D101", 0xFFFF}},
     {0x01, 0x01, 0x0A},
     {{"D100", 0xFFEA}, {"D101", 0xFFFF}}},
    {"01 into D, other bits were 0", "ADPRW H5 H1 H0 K5 D100", {}, {0x01, 0x01, 0xFF}, {{"D100", 0x001F}, {"D101", 0}}},
    {"01 into two R",
     "ADPRW H5 H1 H0 K20 R0",
     {{"R0", 0xAAAA}, {"R1", 0xFFFF}, {"R2", 0x5555}},
     {0x01, 0x03, 0x78, 0x56, 0x04},
     {{"R0", 0x5678}, {"R1", 0xFFF4}, {"R2", 0x5555}}},
    {"01 into M",
     "ADPRW H5 H1 H0 K10 M15",
     {{"M14", 1}, {"M16", 1}, {"M25", 1}},
     {0x01, 0x02, 0x01, 0x02},
     {{"M14", 1}, {"M15", 1}, {"M16", 0}, {"M23", 0}, {"M24", 1}, {"M25", 1}}},
    {"01 into Y, octal",
     "ADPRW H5 H1 H0 K3 Y7",
     {{"Y12", 1}},
     {0x01, 0x01, 0x06},
     {{"Y7", 0}, {"Y10", 1}, {"Y11", 1}, {"Y12", 1}}},
    {"01 into S", "ADPRW H5 H1 H0 K1 S4095", {}, {0x01, 0x01, 0x01}, {{"S4095", 1}}},
    {"02 into D: only the bits asked for change",
     "ADPRW H5 H2 H0 K1 D0",
     {{"D0", 0xFFFF}},
     {0x02, 0x01, 0x00},
     {{"D0", 0xFFFE}}},
    {"03",
     "ADPRW H5 H3 H0 K2 D100",
     {{"D102", 9}},
     {0x03, 0x04, 0x12, 0x34, 0xAB, 0xCD},
     {{"D100", 0x1234}, {"D101", 0xABCD}, {"D102", 9}}},
    {"03 at the end of R", "ADPRW H5 H3 H0 K1 R32767", {}, {0x03, 0x02, 0xBE, 0xEF}, {{"R32767", 0xBEEF}}},
    {"04", "ADPRW H5 H4 H0 K1 D0", {}, {0x04, 0x02, 0x00, 0x01}, {{"D0", 1}}},
    {"05", "ADPRW H5 H5 H7 K0 M0", {{"M0", 1}}, {0x05, 0x00, 0x07, 0xFF, 0x00}, {{"M0", 1}, {"M1", 0}}},
    {"06", "ADPRW H5 H6 H7 K0 D0", {{"D0", 3}}, {0x06, 0x00, 0x07, 0x00, 0x03}, {{"D0", 3}, {"D1", 0}}},
    {"07", "ADPRW H5 H7 H0 K0 D0", {{"D0", 0xFFFF}}, {0x07, 0x6D}, {{"D0", 0x006D}}},
    {"08/00", "ADPRW H5 H8 H0 HA55A D0", {}, {0x08, 0x00, 0x00, 0xA5, 0x5A}, {{"D0", 0xA55A}}},
    {"08/01", "ADPRW H5 H8 H1 HFF00 D0", {}, {0x08, 0x00, 0x01, 0xFF, 0x00}, {{"D0", 0xFF00}}},
    {"08/02", "ADPRW H5 H8 H2 K0 D0", {}, {0x08, 0x00, 0x02, 0x01, 0x05}, {{"D0", 0x0105}}},
    {"08/03: the echo of S3", "ADPRW H5 H8 H3 H0D D0", {}, {0x08, 0x00, 0x03, 0x0D, 0x00}, {{"D0", 0x000D}}},
    {"08/0A", "ADPRW H5 H8 HA K0 D0", {{"D0", 5}}, {0x08, 0x00, 0x0A, 0x00, 0x00}, {{"D0", 0}}},
    {"08/0B", "ADPRW H5 H8 HB K0 D0", {}, {0x08, 0x00, 0x0B, 0x01, 0x02}, {{"D0", 0x0102}}},
    {"08/0C", "ADPRW H5 H8 HC K0 D0", {}, {0x08, 0x00, 0x0C, 0x01, 0x02}, {{"D0", 0x0102}}},
    {"08/0D", "ADPRW H5 H8 HD K0 D0", {}, {0x08, 0x00, 0x0D, 0x01, 0x02}, {{"D0", 0x0102}}},
    {"08/0E", "ADPRW H5 H8 HE K0 D0", {}, {0x08, 0x00, 0x0E, 0x01, 0x02}, {{"D0", 0x0102}}},
    {"08/0F", "ADPRW H5 H8 HF K0 D0", {}, {0x08, 0x00, 0x0F, 0x01, 0x02}, {{"D0", 0x0102}}},
    {"08/10", "ADPRW H5 H8 H10 K0 D0", {{"D0", 9}}, {0x08, 0x00, 0x10, 0x00, 0x00}, {{"D0", 0}}},
    {"08/11", "ADPRW H5 H8 H11 K0 D0", {{"D0", 9}}, {0x08, 0x00, 0x11, 0x00, 0x00}, {{"D0", 0}}},
    {"08/12", "ADPRW H5 H8 H12 K0 R0", {}, {0x08, 0x00, 0x12, 0xFF, 0xFF}, {{"R0", 0xFFFF}}},
    {"0B", "ADPRW H5 HB H0 K0 D0", {}, {0x0B, 0xFF, 0xFF, 0x01, 0x08}, {{"D0", 0xFFFF}, {"D1", 0x0108}}},
    {"0C: two events in a word, the newer one low",
     "ADPRW H4 HC H0 K0 D2000",
     {{"D2007", 9}},
     {0x0C, 0x0B, 0x00, 0x00, 0x01, 0x08, 0x01, 0x21, 0x20, 0x00, 0x40, 0x80, 0xC0},
     {{"D2000", 0},
      {"D2001", 0x0108},
      {"D2002", 0x0121},
      {"D2003", 5},
      {"D2004", 0x0020},
      {"D2005", 0x8040},
      {"D2006", 0x00C0},
      {"D2007", 9}}},
    {"0C, an empty log",
     "ADPRW H4 HC H0 K0 D2000",
     {{"D2003", 9}, {"D2004", 9}},
     {0x0C, 0x06, 0xFF, 0xFF, 0x00, 0x01, 0x00, 0x02},
     {{"D2000", 0xFFFF}, {"D2001", 1}, {"D2002", 2}, {"D2003", 0}, {"D2004", 9}}},
    {"0F", "ADPRW H5 HF H7 K3 D0", {{"D0", 5}}, {0x0F, 0x00, 0x07, 0x00, 0x03}, {{"D0", 5}}},
    {"10", "ADPRW H5 H10 H7 K1 D0", {{"D0", 5}}, {0x10, 0x00, 0x07, 0x00, 0x01}, {{"D0", 5}}},
    {"11", "ADPRW H5 H11 H0 K0 D0", {}, {0x11, 0x02, 0xF3, 0xFF}, {{"D0", 0x00F3}, {"D1", 0x00FF}}},
    {"11 with a name",
     "ADPRW H5 H11 H0 K0 D0",
     {{"D2", 9}},
     {0x11, 0x04, 0xB4, 0x00, 'L', 'M'},
     {{"D0", 0x00B4}, {"D1", 0}, {"D2", 9}}},
    {"11, one byte", "ADPRW H5 H11 H0 K0 D0", {{"D1", 9}}, {0x11, 0x01, 0x07}, {{"D0", 7}, {"D1", 0}}},
    {"16", "ADPRW H5 H16 H7 HF2 H25", {}, {0x16, 0x00, 0x07, 0x00, 0xF2, 0x00, 0x25}, {}},
    {"17: the read data follows the written",
     "ADPRW H5 H17 D10 D12 D100",
     {{"D12", 2}, {"D13", 3}, {"D100", 1}, {"D101", 2}, {"D105", 9}},
     {0x17, 0x06, 0x00, 0x0A, 0x00, 0x0B, 0x00, 0x0C},
     {{"D100", 1}, {"D101", 2}, {"D102", 10}, {"D103", 11}, {"D104", 12}, {"D105", 9}}},
};

}  // namespace

TEST_CASE("adprw: what each answer does to the devices")
{
    for (const row& r : rows) {
        CAPTURE(r.name);
        auto f = adprw_fixture::always(r.line);
        f.set(r.before);
        REQUIRE_FALSE(f.next().empty());
        f.answer(r.answer);
        f.check(r.after);
        f.check({{"M8029", 1},
                 {"M8401", 0},
                 {"M8402", 0},
                 {"M8403", 0},
                 {"M8408", 0},
                 {"M8409", 0},
                 {"D8402", 0},
                 {"D8403", 0},
                 {"D8404", 0},
                 {"D8407", 1},
                 {"M8063", 0},
                 {"D8063", 0}});
    }
}

TEST_CASE("adprw: 64 events and more fill 32 words")
{
    for (const std::size_t events : {63U, 64U, 65U, 240U}) {
        CAPTURE(events);
        auto f = adprw_fixture::always("ADPRW H4 HC H0 K0 D2000");
        f.set("D2036", 9);
        REQUIRE_FALSE(f.next().empty());
        f.finish(modbus::response{modbus::event_log_read{0, 1, 2, buffer(events, 0x5A)}});
        f.check({{"D2003", static_cast<std::uint16_t>(std::min<std::size_t>(events, 64))},
                 {"D2004", 0x5A5A},
                 {"D2035", static_cast<std::uint16_t>(events == 63 ? 0x005A : 0x5A5A)},
                 {"D2036", 9},
                 {"M8402", 0}});
    }
}

TEST_CASE("adprw: 2000 coils into words and into relays")
{
    for (const char* line : {"ADPRW H5 H1 H0 K2000 R32643", "ADPRW H5 H1 H0 K2000 M5680"}) {
        CAPTURE(line);
        auto f = adprw_fixture::always(line);
        REQUIRE_FALSE(f.next().empty());
        modbus::bits_read all{std::vector<bool>(2000)};
        all.values[0] = all.values[1999] = true;
        f.finish(modbus::response{all});
        f.check({{"M8029", 1}, {"M8402", 0}});
        if (std::string(line).find('R', 6) != std::string::npos)
            f.check({{"R32642", 0}, {"R32643", 1}, {"R32644", 0}, {"R32767", 0x8000}});
        else
            f.check({{"M5679", 0}, {"M5680", 1}, {"M5681", 0}, {"M7679", 1}});
    }
}

TEST_CASE("adprw: broadcast and listen-only complete without an answer")
{
    for (const char* line : {"ADPRW H0 H6 H0 K0 K5", "ADPRW H5 H8 H4 K0 D0", "ADPRW H0 H3 H0 K1 D0"}) {
        CAPTURE(line);
        auto f = adprw_fixture::always(line);
        f.set("D0", 7);
        REQUIRE_FALSE(f.next().empty());
        f.finish(modbus::response{modbus::no_response{}});
        f.check({{"D0", 7}, {"M8029", 1}, {"M8401", 0}, {"M8402", 0}});
    }
}

TEST_CASE("adprw: an answer to something else is a malformed one, and changes nothing")
{
    const modbus::response all[] = {modbus::bits_read{{true}},         modbus::registers_read{{1}},
                                    modbus::registers_read{{1, 2, 3}}, modbus::written{},
                                    modbus::exception_status_read{1},  modbus::diagnostics_answered{{0, 1}},
                                    modbus::event_counter_read{1, 2},  modbus::event_log_read{},
                                    modbus::server_id_read{{1, 2}},    modbus::device_identification_read{}};
    for (const char* line : {"ADPRW H5 H3 H0 K2 D0", "ADPRW H5 H1 H0 K2 D0"}) {
        for (const modbus::response& each : all) {
            CAPTURE(line);
            CAPTURE(each.index());
            auto f = adprw_fixture::always(line);
            REQUIRE_FALSE(f.next().empty());
            f.finish(each);
            f.check({{"D0", 0}, {"D1", 0}, {"D2", 0}, {"M8402", 1}, {"D8402", 207}});
        }
    }
}

TEST_SUITE_END();
