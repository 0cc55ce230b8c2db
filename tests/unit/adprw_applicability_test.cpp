#include "tests/unit/adprw_fixture.hpp"

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using namespace plcgw::plc;
using plcgw::test::adprw_fixture;
using plcgw::test::preset;

namespace {

constexpr std::uint16_t wrong_device = 6705;
constexpr std::uint16_t out_of_range = 6706;

struct refusal {
    unsigned operand = 0;  // 0: the instruction is sent
    std::uint16_t why = 0;
    bool operator==(const refusal&) const = default;
};

std::ostream& operator<<(std::ostream& to, const refusal& r) { return to << "operand " << r.operand << ", " << r.why; }

refusal tried(const std::string& line, const std::vector<preset>& devices = {}, const char* model = "FX3U")
{
    auto f = adprw_fixture::always(line, model);
    f.set(devices);
    if (!f.next().empty()) {
        f.check({{"M8401", 1}, {"M8402", 0}, {"M8067", 0}});
        return {};
    }
    f.check({{"M8401", 0}, {"M8402", 1}, {"M8403", 1}, {"M8029", 0}});
    if (std::string(model).starts_with("LS"))
        return {f.read("D8402") - 2180U, 0};
    f.check({{"D8402", 218}, {"M8067", 1}});
    return {f.read("D8403"), f.read("D8067")};
}

// S2 and S3 of each command code, and what S4/D may be: section 8.3, and 6-3 of the LS manual.
struct command {
    const char* code;
    const char* s2;
    const char* s3;
    const char* fx3u;
    const char* ls;  // "": not asked by an LS
};

// clang-format off
const command commands[] = {
    // S1   S2     S3     S4/D of an FX3U    of an LS
    {"H1",  "H0",  "K1",  "D R M Y S",       "D R M Y S"},
    {"H2",  "H0",  "K1",  "D R M Y S",       "D R M Y S"},
    {"H3",  "H0",  "K1",  "D R",             "D R"},
    {"H4",  "H0",  "K1",  "D R",             "D R"},
    {"H5",  "H0",  "K0",  "D R K H M X Y S", "D R"},
    {"H6",  "H0",  "K0",  "D R K H",         "D R"},
    {"H7",  "H0",  "K0",  "D R",             ""},
    {"H8",  "H0",  "K0",  "D R",             ""},
    {"H8",  "H1",  "H0",  "D R",             ""},
    {"H8",  "H2",  "H0",  "D R",             ""},
    {"H8",  "H3",  "H0",  "D R",             ""},
    {"H8",  "H4",  "H0",  "D R K H",         ""},  // K0 and H0: "0 (fixed)"
    {"H8",  "HA",  "H0",  "D R",             ""},
    {"H8",  "HB",  "H0",  "D R",             ""},
    {"H8",  "HC",  "H0",  "D R",             ""},
    {"H8",  "HD",  "H0",  "D R",             ""},
    {"H8",  "HE",  "H0",  "D R",             ""},
    {"H8",  "HF",  "H0",  "D R",             ""},
    {"H8",  "H10", "H0",  "D R",             ""},
    {"H8",  "H11", "H0",  "D R",             ""},
    {"H8",  "H12", "H0",  "D R",             ""},
    {"HB",  "H0",  "K0",  "D R",             ""},
    {"HC",  "H0",  "K0",  "D R",             ""},
    {"HF",  "H0",  "K1",  "D R K H M X Y S", "D R M Y S"},
    {"H10", "H0",  "K1",  "D R K H",         "D R"},
    {"H11", "H0",  "K0",  "D R",             ""},
    {"H16", "H0",  "K0",  "D R K H",         ""},
    {"H17", "D10", "D12", "D R",             "D R"},
};
// clang-format on

const std::vector<preset> counts{{"D12", 1}, {"D13", 1}};

bool allows(const char* list, char kind) { return std::string(list).find(kind) != std::string::npos; }

std::string line_of(const command& c, const std::string& s4)
{
    return std::string("ADPRW H5 ") + c.code + " " + c.s2 + " " + c.s3 + " " + s4;
}

}  // namespace

TEST_CASE("adprw table: which devices S4/D may be, command code by command code")
{
    for (const command& c : commands) {
        for (const char kind : std::string("KHDRMXYS")) {
            const std::string line = line_of(c, std::string(1, kind) + "0");
            CAPTURE(line);
            CHECK(tried(line, counts) == (allows(c.fx3u, kind) ? refusal{} : refusal{5, wrong_device}));
            if (*c.ls != '\0')
                CHECK(tried(line, counts, "LS22") == (allows(c.ls, kind) ? refusal{} : refusal{5}));
            else
                CHECK(tried(line, counts, "LS32") == refusal{2});
        }
    }
}

TEST_CASE("adprw table: special M and D are no operands, in any place")
{
    for (const command& c : commands) {
        CHECK(tried(line_of(c, "D8000"), counts) == refusal{5, wrong_device});
        CHECK(tried(line_of(c, "D8511"), counts) == refusal{5, wrong_device});
        CHECK(tried(line_of(c, "D9000"), counts) == refusal{5, wrong_device});
        CHECK(tried(line_of(c, "M8000"), counts) == refusal{5, wrong_device});
    }
    CHECK(tried("ADPRW D8000 H3 H0 K1 D0") == refusal{1, wrong_device});
    CHECK(tried("ADPRW H1 D8000 H0 K1 D0") == refusal{2, wrong_device});
    CHECK(tried("ADPRW H1 H3 D8000 K1 D0") == refusal{3, wrong_device});
    CHECK(tried("ADPRW H1 H3 H0 D8000 D0") == refusal{4, wrong_device});
}

TEST_CASE("adprw table: S to S3 are K, H, D or R")
{
    const char* const places[] = {"ADPRW * H3 H0 K1 D0", "ADPRW H1 * H0 K1 D0", "ADPRW H1 H3 * K1 D0",
                                  "ADPRW H1 H3 H0 * D0"};
    for (unsigned i = 0; i < 4; ++i) {
        for (const char* device : {"K3", "H3", "D3", "R3", "M3", "X3", "Y3", "S3"}) {
            std::string line = places[i];
            line.replace(line.find('*'), 1, device);
            CAPTURE(line);
            const bool allowed = allows("KHDR", device[0]);
            CHECK(tried(line, {{"D3", 3}, {"R3", 3}}) == (allowed ? refusal{} : refusal{i + 1, wrong_device}));
        }
    }
}

TEST_CASE("adprw table: S2 and S3 of 17H are two registers each")
{
    struct {
        const char* line;
        refusal expected;
    } const rows[] = {
        {"ADPRW H1 H17 R32766 D12 D100", {}},
        {"ADPRW H1 H17 R32767 D12 D100", {3, out_of_range}},
        {"ADPRW H1 H17 D7998 D12 D100", {}},
        {"ADPRW H1 H17 D7999 D12 D100", {3, out_of_range}},
        {"ADPRW H1 H17 K0 D12 D100", {3, wrong_device}},
        {"ADPRW H1 H17 M0 D12 D100", {3, wrong_device}},
        {"ADPRW H1 H17 D10 K1 D100", {4, wrong_device}},
        {"ADPRW H1 H17 D10 H1 D100", {4, wrong_device}},
        {"ADPRW H1 H17 D10 D7999 D100", {4, out_of_range}},
        {"ADPRW H1 H17 D10 D12 D7998", {}},
        {"ADPRW H1 H17 D10 D12 D7999", {5, out_of_range}},
    };
    for (const auto& row : rows) {
        CAPTURE(row.line);
        CHECK(tried(row.line, counts) == row.expected);
    }
    struct {
        std::uint16_t write_count;
        std::uint16_t read_count;
        bool valid;
    } const pairs[] = {{1, 1, true},    {121, 125, true}, {0, 1, false},     {1, 0, false},
                       {122, 1, false}, {1, 126, false},  {65535, 1, false}, {1, 65535, false}};
    for (const auto& each : pairs) {
        CAPTURE(each.write_count);
        CAPTURE(each.read_count);
        CHECK(tried("ADPRW H1 H17 D10 D12 D100", {{"D12", each.write_count}, {"D13", each.read_count}}) ==
              (each.valid ? refusal{} : refusal{4, out_of_range}));
    }
}

TEST_CASE("adprw table: ranges")
{
    struct {
        const char* line;
        refusal expected;
    } const rows[] = {
        {"ADPRW K0 H3 H0 K1 D0", {}},
        {"ADPRW K247 H3 H0 K1 D0", {}},
        {"ADPRW K248 H3 H0 K1 D0", {1, out_of_range}},
        {"ADPRW K-1 H3 H0 K1 D0", {1, out_of_range}},
        {"ADPRW K1 H0 H0 K1 D0", {2, out_of_range}},
        {"ADPRW K1 H9 H0 K1 D0", {2, out_of_range}},
        {"ADPRW K1 H14 H0 K1 D0", {2, out_of_range}},
        {"ADPRW K1 H18 H0 K1 D0", {2, out_of_range}},
        {"ADPRW K1 H2B H0 K1 D0", {2, out_of_range}},
        {"ADPRW K1 H83 H0 K1 D0", {2, out_of_range}},
        {"ADPRW K1 H103 H0 K1 D0", {2, out_of_range}},
        {"ADPRW K1 H1 HFFFF K2000 D0", {}},
        {"ADPRW K1 H1 H0 K0 D0", {4, out_of_range}},
        {"ADPRW K1 H1 H0 K2001 D0", {4, out_of_range}},
        {"ADPRW K1 H2 H0 K0 D0", {4, out_of_range}},
        {"ADPRW K1 H2 H0 K2001 D0", {4, out_of_range}},
        {"ADPRW K1 H3 H0 K125 D0", {}},
        {"ADPRW K1 H3 H0 K0 D0", {4, out_of_range}},
        {"ADPRW K1 H3 H0 K126 D0", {4, out_of_range}},
        {"ADPRW K1 H4 H0 K0 D0", {4, out_of_range}},
        {"ADPRW K1 H4 H0 K126 D0", {4, out_of_range}},
        {"ADPRW K1 H5 H0 K1 D0", {4, out_of_range}},
        {"ADPRW K1 H5 H0 K0 K2", {5, out_of_range}},
        {"ADPRW K1 H5 H0 K0 D500", {5, out_of_range}},  // holds 2
        {"ADPRW K1 H6 H0 K1 D0", {4, out_of_range}},
        {"ADPRW K1 H7 H1 K0 D0", {3, out_of_range}},
        {"ADPRW K1 H7 H0 K1 D0", {4, out_of_range}},
        {"ADPRW K1 H8 H5 K0 D0", {3, out_of_range}},
        {"ADPRW K1 H8 H9 K0 D0", {3, out_of_range}},
        {"ADPRW K1 H8 H13 K0 D0", {3, out_of_range}},
        {"ADPRW K1 H8 HFFFF K0 D0", {3, out_of_range}},
        {"ADPRW K1 H8 H0 HFFFF D0", {}},
        {"ADPRW K1 H8 H1 H1 D0", {4, out_of_range}},
        {"ADPRW K1 H8 H1 HFF01 D0", {4, out_of_range}},
        {"ADPRW K1 H8 H2 K1 D0", {4, out_of_range}},
        {"ADPRW K1 H8 H3 HFF D0", {}},
        {"ADPRW K1 H8 H3 H100 D0", {4, out_of_range}},
        {"ADPRW K1 H8 H4 K1 D0", {4, out_of_range}},
        {"ADPRW K1 H8 H4 K0 K1", {5, out_of_range}},
        {"ADPRW K1 H8 HA K1 D0", {4, out_of_range}},
        {"ADPRW K1 H8 HB K1 D0", {4, out_of_range}},
        {"ADPRW K1 H8 H12 K1 D0", {4, out_of_range}},
        {"ADPRW K1 HB H1 K0 D0", {3, out_of_range}},
        {"ADPRW K1 HB H0 K1 D0", {4, out_of_range}},
        {"ADPRW K1 HC H1 K0 D0", {3, out_of_range}},
        {"ADPRW K1 HC H0 K1 D0", {4, out_of_range}},
        {"ADPRW K1 HF H0 K1968 D0", {}},
        {"ADPRW K1 HF H0 K0 D0", {4, out_of_range}},
        {"ADPRW K1 HF H0 K1969 D0", {4, out_of_range}},
        {"ADPRW K1 H10 H0 K123 D0", {}},
        {"ADPRW K1 H10 H0 K0 D0", {4, out_of_range}},
        {"ADPRW K1 H10 H0 K124 D0", {4, out_of_range}},
        {"ADPRW K1 H11 H1 K0 D0", {3, out_of_range}},
        {"ADPRW K1 H11 H0 K1 D0", {4, out_of_range}},
        {"ADPRW K1 H16 HFFFF HFFFF HFFFF", {}},
    };
    for (const auto& row : rows) {
        CAPTURE(row.line);
        CHECK(tried(row.line, {{"D500", 2}}) == row.expected);
    }
}

TEST_CASE("adprw table: the block that S4/D occupies must exist")
{
    struct {
        const char* line;
        bool fits;
    } const rows[] = {
        {"ADPRW K1 H3 H0 K10 D7990", true},
        {"ADPRW K1 H3 H0 K10 D7991", false},
        {"ADPRW K1 H3 H0 K1 R32767", true},
        {"ADPRW K1 H3 H0 K2 R32767", false},
        {"ADPRW K1 H3 H0 K1 R32768", false},
        {"ADPRW K1 H1 H0 K16 D7999", true},
        {"ADPRW K1 H1 H0 K17 D7999", false},
        {"ADPRW K1 H1 H0 K33 D7998", false},
        {"ADPRW K1 H1 H0 K32 D7998", true},
        {"ADPRW K1 H1 H0 K10 M7670", true},
        {"ADPRW K1 H1 H0 K11 M7670", false},
        {"ADPRW K1 H1 H0 K1 M7680", false},  // between the user's relays and the system's
        {"ADPRW K1 H2 H0 K8 Y370", true},
        {"ADPRW K1 H2 H0 K9 Y370", false},
        {"ADPRW K1 H2 H0 K1 S4095", true},
        {"ADPRW K1 H2 H0 K2 S4095", false},
        {"ADPRW K1 H5 H0 K0 X377", true},
        {"ADPRW K1 H5 H0 K0 X400", false},
        {"ADPRW K1 H6 H0 K0 D7999", true},
        {"ADPRW K1 HB H0 K0 D7998", true},
        {"ADPRW K1 HB H0 K0 D7999", false},
        {"ADPRW K1 HC H0 K0 D7964", true},
        {"ADPRW K1 HC H0 K0 D7965", false},  // 36 registers
        {"ADPRW K1 HF H0 K9 X367", true},
        {"ADPRW K1 HF H0 K10 X367", false},
        {"ADPRW K1 HF H0 K17 R32767", false},
        {"ADPRW K1 H10 H0 K123 D7877", true},
        {"ADPRW K1 H10 H0 K123 D7878", false},
        {"ADPRW K1 H11 H0 K0 D7998", true},
        {"ADPRW K1 H11 H0 K0 D7999", false},
        {"ADPRW K1 H8 H4 K0 R32768", false},
    };
    for (const auto& row : rows) {
        CAPTURE(row.line);
        CHECK(tried(row.line) == (row.fits ? refusal{} : refusal{5, out_of_range}));
    }
}

TEST_CASE("adprw table: the first wrong operand counts")
{
    CHECK(tried("ADPRW K300 H99 M0 M0 M0") == refusal{1, out_of_range});
    CHECK(tried("ADPRW M0 H99 M0 M0 M0") == refusal{1, wrong_device});
    CHECK(tried("ADPRW K1 H99 M0 M0 M0") == refusal{2, out_of_range});
    CHECK(tried("ADPRW K1 H3 M0 K0 M0") == refusal{3, wrong_device});
    CHECK(tried("ADPRW K1 H3 H0 K0 M0") == refusal{4, out_of_range});
    CHECK(tried("ADPRW K1 H3 H0 K1 M0") == refusal{5, wrong_device});
}

TEST_CASE("adprw table: FX3S, FX3G and FX3GC ask the eight basic commands; an FX3S has no R")
{
    for (const char* model : {"FX3S", "FX3G", "FX3GC", "FX3U", "FX3UC"}) {
        const bool full = std::string(model).starts_with("FX3U");
        for (const command& c : commands) {
            const bool basic =
                allows("123456F", c.code[1]) && (std::string(c.code).size() == 2 || std::string(c.code) == "H10");
            const std::string line = line_of(c, "D100");
            CAPTURE(model);
            CAPTURE(line);
            CHECK(tried(line, counts, model) == (basic || full ? refusal{} : refusal{2, out_of_range}));
        }
    }
    CHECK(tried("ADPRW H1 H3 H0 K1 R0", {}, "FX3S") == refusal{5, wrong_device});
    CHECK(tried("ADPRW R0 H3 H0 K1 D0", {}, "FX3S") == refusal{1, wrong_device});
    CHECK(tried("ADPRW H1 H3 H0 K1 D3000", {}, "FX3S") == refusal{5, out_of_range});
}

TEST_CASE("adprw table: the last device of each model, and the one behind it")
{
    struct {
        const char* model;
        const char* last;
        const char* behind;
    } const rows[] = {
        {"FX3S", "D2999", "D3000"},    {"FX3S", "M1535", "M1536"}, {"FX3S", "S255", "S256"},
        {"FX3S", "Y15", "Y16"},        {"FX3S", "X17", "X20"},     {"FX3G", "R23999", "R24000"},
        {"FX3G", "Y177", "Y200"},      {"FX3GC", "X177", "X200"},  {"FX3GC", "D7999", "D8000"},
        {"FX3UC", "R32767", "R32768"}, {"FX3UC", "Y377", "Y400"},  {"LS22", "M3071", "M3072"},
        {"LS32", "S999", "S1000"},     {"LS22", "Y267", "Y270"},
    };
    for (const auto& row : rows) {
        CAPTURE(row.model);
        CAPTURE(row.last);
        const bool ls = std::string(row.model).starts_with("LS");
        const bool bits = allows("XYMS", row.last[0]);
        const std::string line = bits ? "ADPRW K1 HF H0 K1 " : "ADPRW K1 H3 H0 K1 ";
        CHECK(tried(line + row.last, {}, row.model) == refusal{});
        const bool special = std::string(row.behind) == "D8000";
        CHECK(tried(line + row.behind, {}, row.model) ==
              (ls ? refusal{5} : refusal{5, special ? wrong_device : out_of_range}));
    }
}

TEST_SUITE_END();
