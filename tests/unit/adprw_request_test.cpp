#include "tests/unit/adprw_fixture.hpp"

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using plcgw::test::adprw_fixture;
using plcgw::test::preset;

namespace {

struct row {
    const char* name;
    const char* line;
    std::vector<preset> devices;
    buffer asked;  // unit, then the PDU
};

const std::vector<preset> ten_relays{{"M3", 1}, {"M4", 1}, {"M10", 1}};
const std::vector<preset> parameters{{"D10", 90}, {"D11", 150},     {"D12", 2},
                                     {"D13", 31}, {"D100", 0x1234}, {"D101", 0xABCD}};

const row rows[] = {
    {"01", "ADPRW H5 H1 H10 K20 D100", {}, {0x05, 0x01, 0x00, 0x10, 0x00, 0x14}},
    {"01, most", "ADPRW HF7 H1 HFFFF K2000 M0", {}, {0xF7, 0x01, 0xFF, 0xFF, 0x07, 0xD0}},
    {"02", "ADPRW K1 H2 K256 K1 Y0", {}, {0x01, 0x02, 0x01, 0x00, 0x00, 0x01}},
    {"03", "ADPRW H5 H3 H0 K10 D100", {}, {0x05, 0x03, 0x00, 0x00, 0x00, 0x0A}},
    {"03, most", "ADPRW H5 H3 H0 K125 R0", {}, {0x05, 0x03, 0x00, 0x00, 0x00, 0x7D}},
    {"03, all from devices",
     "ADPRW D0 D1 D2 R3 D100",
     {{"D0", 9}, {"D1", 3}, {"D2", 0xBEEF}, {"R3", 2}},
     {0x09, 0x03, 0xBE, 0xEF, 0x00, 0x02}},
    {"04", "ADPRW H5 H4 H7 K3 D0", {}, {0x05, 0x04, 0x00, 0x07, 0x00, 0x03}},
    {"05, K1", "ADPRW H5 H5 H7 K0 K1", {}, {0x05, 0x05, 0x00, 0x07, 0xFF, 0x00}},
    {"05, H0", "ADPRW H5 H5 H7 K0 H0", {}, {0x05, 0x05, 0x00, 0x07, 0x00, 0x00}},
    {"05, D", "ADPRW H5 H5 H7 K0 D5", {{"D5", 1}}, {0x05, 0x05, 0x00, 0x07, 0xFF, 0x00}},
    {"05, R", "ADPRW H5 H5 H7 K0 R5", {{"R5", 0}}, {0x05, 0x05, 0x00, 0x07, 0x00, 0x00}},
    {"05, M", "ADPRW H5 H5 H7 K0 M7679", {{"M7679", 1}}, {0x05, 0x05, 0x00, 0x07, 0xFF, 0x00}},
    {"05, X", "ADPRW H5 H5 H7 K0 X17", {{"X17", 1}}, {0x05, 0x05, 0x00, 0x07, 0xFF, 0x00}},
    {"05, Y", "ADPRW H5 H5 H7 K0 Y377", {{"Y377", 1}}, {0x05, 0x05, 0x00, 0x07, 0xFF, 0x00}},
    {"05, S", "ADPRW H5 H5 H7 K0 S4095", {}, {0x05, 0x05, 0x00, 0x07, 0x00, 0x00}},
    {"06, K", "ADPRW H5 H6 H7 K0 K-2", {}, {0x05, 0x06, 0x00, 0x07, 0xFF, 0xFE}},
    {"06, H", "ADPRW H5 H6 H7 K0 H1234", {}, {0x05, 0x06, 0x00, 0x07, 0x12, 0x34}},
    {"06, D", "ADPRW H5 H6 H7 K0 D7999", {{"D7999", 0xABCD}}, {0x05, 0x06, 0x00, 0x07, 0xAB, 0xCD}},
    {"06, broadcast", "ADPRW K0 H6 H7 K0 R0", {{"R0", 1}}, {0x00, 0x06, 0x00, 0x07, 0x00, 0x01}},
    {"07", "ADPRW H5 H7 H0 K0 D0", {}, {0x05, 0x07}},
    {"08/00", "ADPRW H5 H8 H0 HA55A D0", {}, {0x05, 0x08, 0x00, 0x00, 0xA5, 0x5A}},
    {"08/01", "ADPRW HA H8 H1 HFF00 R0", {}, {0x0A, 0x08, 0x00, 0x01, 0xFF, 0x00}},  // section 10.2
    {"08/01, keeps the log", "ADPRW HA H8 H1 H0 R0", {}, {0x0A, 0x08, 0x00, 0x01, 0x00, 0x00}},
    {"08/02", "ADPRW H5 H8 H2 K0 D0", {}, {0x05, 0x08, 0x00, 0x02, 0x00, 0x00}},
    {"08/03", "ADPRW H5 H8 H3 H0D D0", {}, {0x05, 0x08, 0x00, 0x03, 0x0D, 0x00}},
    {"08/04, K0", "ADPRW H5 H8 H4 K0 K0", {}, {0x05, 0x08, 0x00, 0x04, 0x00, 0x00}},
    {"08/04, D", "ADPRW H5 H8 H4 K0 D0", {{"D0", 7}}, {0x05, 0x08, 0x00, 0x04, 0x00, 0x00}},
    {"08/0A", "ADPRW H5 H8 HA K0 D0", {}, {0x05, 0x08, 0x00, 0x0A, 0x00, 0x00}},
    {"08/0B", "ADPRW H5 H8 HB K0 D0", {}, {0x05, 0x08, 0x00, 0x0B, 0x00, 0x00}},
    {"08/0C", "ADPRW H5 H8 HC K0 D0", {}, {0x05, 0x08, 0x00, 0x0C, 0x00, 0x00}},
    {"08/0D", "ADPRW H5 H8 HD K0 D0", {}, {0x05, 0x08, 0x00, 0x0D, 0x00, 0x00}},
    {"08/0E", "ADPRW H5 H8 HE K0 D0", {}, {0x05, 0x08, 0x00, 0x0E, 0x00, 0x00}},
    {"08/0F", "ADPRW H5 H8 HF K0 D0", {}, {0x05, 0x08, 0x00, 0x0F, 0x00, 0x00}},
    {"08/10", "ADPRW H5 H8 H10 K0 D0", {}, {0x05, 0x08, 0x00, 0x10, 0x00, 0x00}},
    {"08/11", "ADPRW H5 H8 H11 K0 D0", {}, {0x05, 0x08, 0x00, 0x11, 0x00, 0x00}},
    {"08/12", "ADPRW H5 H8 H12 K0 D0", {}, {0x05, 0x08, 0x00, 0x12, 0x00, 0x00}},
    {"0B", "ADPRW H5 HB H0 K0 D0", {}, {0x05, 0x0B}},
    {"0C", "ADPRW H4 HC H0 K0 D2000", {}, {0x04, 0x0C}},
    {"0F, M", "ADPRW H5 HF H7 K10 M3", ten_relays, {0x05, 0x0F, 0x00, 0x07, 0x00, 0x0A, 0x02, 0x83, 0x00}},
    {"0F, X octal",
     "ADPRW H5 HF H7 K3 X7",
     {{"X7", 1}, {"X10", 0}, {"X11", 1}},
     {0x05, 0x0F, 0x00, 0x07, 0x00, 0x03, 0x01, 0x05}},
    {"0F, Y", "ADPRW H5 HF H7 K1 Y0", {{"Y0", 1}}, {0x05, 0x0F, 0x00, 0x07, 0x00, 0x01, 0x01, 0x01}},
    {"0F, S", "ADPRW H5 HF H7 K2 S1", {{"S2", 1}}, {0x05, 0x0F, 0x00, 0x07, 0x00, 0x02, 0x01, 0x02}},
    {"0F, D",
     "ADPRW H5 HF H7 K20 D0",
     {{"D0", 0x8001}, {"D1", 0xFFFA}},
     {0x05, 0x0F, 0x00, 0x07, 0x00, 0x14, 0x03, 0x01, 0x80, 0x0A}},
    {"0F, R at the end",
     "ADPRW H5 HF H7 K16 R32767",
     {{"R32767", 0x1234}},
     {0x05, 0x0F, 0x00, 0x07, 0x00, 0x10, 0x02, 0x34, 0x12}},
    {"0F, K", "ADPRW H5 HF H7 K18 H8003", {}, {0x05, 0x0F, 0x00, 0x07, 0x00, 0x12, 0x03, 0x03, 0x80, 0x03}},
    {"10, D",
     "ADPRW H5 H10 H7 K2 D0",
     {{"D0", 0x1234}, {"D1", 0xABCD}},
     {0x05, 0x10, 0x00, 0x07, 0x00, 0x02, 0x04, 0x12, 0x34, 0xAB, 0xCD}},
    {"10, K for every register",
     "ADPRW H5 H10 H7 K3 K-1",
     {},
     {0x05, 0x10, 0x00, 0x07, 0x00, 0x03, 0x06, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}},
    {"11", "ADPRW H5 H11 H0 K0 D0", {}, {0x05, 0x11}},
    {"16", "ADPRW H5 H16 H7 HF2 H25", {}, {0x05, 0x16, 0x00, 0x07, 0x00, 0xF2, 0x00, 0x25}},
    {"16 from devices",
     "ADPRW H5 H16 D0 D1 D2",
     {{"D0", 4}, {"D1", 0xFFFF}, {"D2", 0xBEEF}},
     {0x05, 0x16, 0x00, 0x04, 0xFF, 0xFF, 0xBE, 0xEF}},
    {"17",
     "ADPRW H5 H17 D10 D12 D100",
     parameters,
     {0x05, 0x17, 0x00, 0x96, 0x00, 0x1F, 0x00, 0x5A, 0x00, 0x02, 0x04, 0x12, 0x34, 0xAB, 0xCD}},
};

}  // namespace

TEST_CASE("adprw: what each command code asks")
{
    for (const row& r : rows) {
        CAPTURE(r.name);
        auto f = adprw_fixture::always(r.line);
        f.set(r.devices);
        CHECK(f.next() == r.asked);
        f.check({{"M8401", 1}, {"M8029", 0}, {"M8402", 0}, {"M8403", 0}, {"M8067", 0}, {"D8402", 0}, {"D8407", 1}});
    }
}

TEST_CASE("adprw: every request of an LS")
{
    for (const char* line :
         {"ADPRW H5 H1 H10 K20 M100", "ADPRW H5 H2 H10 K20 D100", "ADPRW H5 H3 H0 K10 R100", "ADPRW H5 H4 H0 K10 D100",
          "ADPRW H5 H5 H0 K1 D0", "ADPRW H5 H5 H0 K0 D0", "ADPRW H5 H6 H0 K1 D0", "ADPRW H5 HF H0 K20 Y0",
          "ADPRW H5 H10 H0 K123 D0", "ADPRW H5 H17 D10 D12 D100"}) {
        CAPTURE(line);
        auto f = adprw_fixture::always(line, "LS32");
        f.set(parameters);
        CHECK_FALSE(f.next().empty());
        f.check({{"M8401", 1}, {"M8402", 0}});
    }
}

TEST_CASE("adprw: 17H at its largest: 121 registers out, 125 in")
{
    auto f = adprw_fixture::always("ADPRW H5 H17 D10 D12 D7754");
    f.set({{"D12", 121}, {"D13", 125}, {"D7754", 1}, {"D7874", 2}, {"D7875", 3}});
    const buffer asked = f.next();
    REQUIRE(asked.size() == 11 + 2 * 121);
    CHECK(asked[12] == 1);
    CHECK(asked.back() == 2);
}

TEST_CASE("adprw: the operands are those of the moment")
{
    auto f = adprw_fixture::always("ADPRW D0 H3 D1 D2 D100");
    f.set({{"D0", 1}, {"D1", 2}, {"D2", 3}});
    CHECK(f.next() == buffer{0x01, 0x03, 0x00, 0x02, 0x00, 0x03});
    f.set("D0", 77);  // too late for this question
    CHECK(f.question->unit == modbus::unit_id{1});
    f.finish(modbus::response{modbus::registers_read{{7, 8, 9}}});
    f.check({{"D100", 7}, {"D101", 8}, {"D102", 9}});
    CHECK(f.next() == buffer{77, 0x03, 0x00, 0x02, 0x00, 0x03});
}

TEST_SUITE_END();
