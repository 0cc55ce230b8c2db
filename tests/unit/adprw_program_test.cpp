#include "bridge/plc/adprw_program.hpp"
#include "bridge/plc/setup_program.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("plc");

using namespace plcgw::plc;

namespace {

constexpr device_kind d = device_kind::d;
constexpr device_kind m = device_kind::m;

operand constant(std::uint16_t value) { return value; }

const adprw& asked(const adprw_program& p, std::size_t index) { return std::get<adprw>(p.instructions.at(index).what); }

std::string rung(const std::string& line) { return "LD M8000\n" + line + "\n"; }

}  // namespace

TEST_CASE("adprw program: operands, contacts, lines and steps")
{
    const adprw_program p = parse_adprw_program("LD M8411\n"         // step 0
                                                "MOV H1097 D8400\n"  // 1
                                                "; polling\n"
                                                "ld m8000\n"                       // 6
                                                "adprw h5, h3, h0, k10, d100\n"    // 7
                                                "ADPRW K6 K4 D8 R9 R32767 // x\n"  // 18
                                                "LDP M0\n"                         // 29
                                                "MOV K500 D8409\n"                 // 31
                                                "MOV D1 R2\n"                      // 36
                                                "ADPRW H5 H5 H1F K0 X17\n"         // 41
                                                "LDI Y7\n"                         // 52
                                                "ADPRWP H0 H6 K-1 K0 HFFFF\n"      // 53
                                                "END\n");
    CHECK(p.mistakes.empty());
    CHECK(p.asks());
    using kind = contact::kind;
    const std::vector<instruction> expected{
        {5,
         7,
         {kind::open, {m, 8000}},
         false,
         adprw{{constant(5), constant(3), constant(0), constant(10), device{d, 100}}}},
        {6,
         18,
         {kind::open, {m, 8000}},
         false,
         adprw{{constant(6), constant(4), device{d, 8}, device{device_kind::r, 9}, device{device_kind::r, 32767}}}},
        {8, 31, {kind::rising, {m, 0}}, true, mov{constant(500), {d, 8409}}},
        {9, 36, {kind::rising, {m, 0}}, true, mov{device{d, 1}, {device_kind::r, 2}}},
        {10,
         41,
         {kind::rising, {m, 0}},
         true,
         adprw{{constant(5), constant(5), constant(0x1F), constant(0), device{device_kind::x, 15}}}},
        {12,
         53,
         {kind::closed, {device_kind::y, 7}},
         true,
         adprw{{constant(0), constant(6), constant(0xFFFF), constant(0), constant(0xFFFF)}}},
    };
    REQUIRE(p.instructions.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CAPTURE(i);
        CHECK(p.instructions[i] == expected[i]);
    }
}

TEST_CASE("adprw program: a printed step number wins, and the count goes on from it")
{
    const adprw_program p = parse_adprw_program("100 LD M0\n101 ADPRW H1 H3 H0 K1 D0\nADPRW H2 H3 H0 K1 D0\n"
                                                "33000 ADPRW H3 H3 H0 K1 D0\n");
    REQUIRE(p.instructions.size() == 3);
    CHECK(p.instructions[0].step == 101);
    CHECK(p.instructions[1].step == 112);
    CHECK(p.instructions[2].step == 33000);
}

TEST_CASE("adprw program: other instructions take their steps and are not run")
{
    struct {
        const char* text;
        std::uint16_t steps;
    } const rows[] = {{"LD X0\nAND X1\nANI M2\nOR Y0\nORI S0\nOUT Y0", 6},
                      {"LDP X0\nOUT M7", 3},
                      {"LDF X0\nANDP X1\nORF X2\nSET S1", 8},
                      {"LD X0\nOUT M8034", 3},
                      {"LD X0\nOUT TS0", 4},
                      {"LD X0\nRST D7", 4},
                      {"LD X0\nRST CS7", 3},
                      {"LD M0\nMOV K1 TN0", 6},
                      {"LD M0\nMOV X0 D0", 6}};
    for (const auto& row : rows) {
        CAPTURE(row.text);
        const adprw_program p = parse_adprw_program(std::string(row.text) + "\nLD M0\nADPRW H1 H3 H0 K1 D0\n");
        CHECK(p.mistakes.empty());
        REQUIRE(p.instructions.size() == 1);
        CHECK(p.instructions[0].step == row.steps + 1);
    }
}

TEST_CASE("adprw program: what makes an instruction run once")
{
    struct {
        const char* text;
        bool once;
    } const rows[] = {{"LD M0\nADPRW", false},   {"LDI M0\nADPRW", false},    {"LDP M0\nADPRW", true},
                      {"LDF M0\nADPRW", true},   {"LD M0\nADPRWP", true},     {"LD M8000\nADPRW", false},
                      {"LD M8002\nADPRW", true}, {"LDI M8002\nADPRW", false}, {"LDP X7\nADPRWP", true}};
    for (const auto& row : rows) {
        CAPTURE(row.text);
        const adprw_program p = parse_adprw_program(std::string(row.text) + " H1 H3 H0 K1 D0\n");
        REQUIRE(p.instructions.size() == 1);
        CHECK(p.instructions[0].once == row.once);
    }
}

TEST_CASE("adprw program: constants")
{
    struct {
        const char* text;
        std::uint16_t value;
    } const rows[] = {{"K0", 0}, {"K65535", 65535}, {"K-32768", 0x8000}, {"HFFFF", 0xFFFF}, {"H0", 0}, {"h00a", 10}};
    for (const auto& row : rows) {
        CAPTURE(row.text);
        const adprw_program p = parse_adprw_program(rung(std::string("ADPRW H1 H6 H0 K0 ") + row.text));
        REQUIRE(p.instructions.size() == 1);
        CHECK(asked(p, 0).operands[4] == constant(row.value));
    }
}

TEST_CASE("adprw program: mistakes, with their lines and cures")
{
    struct {
        const char* text;
        std::size_t line;
        const char* says;
    } const rows[] = {
        {"ADPRW H1 H3 H0 K1 D0", 1, "no contact stands above it: put LD M8000 above it"},
        {"LD M8411\nMOV H1 D8401\nADPRW H1 H3 H0 K1 D0", 3, "LD M8411 is for the MOVs of the communication setup"},
        {"LD M0\nAND M1\nADPRW H1 H3 H0 K1 D0", 3, "AND stands above it, but one contact alone drives an ADPRW"},
        {"LD M0\nORI M1\nADPRW H1 H3 H0 K1 D0", 3, "ORI stands above it"},
        {"LD D0\nADPRW H1 H3 H0 K1 D0", 2, "the contact above it is none"},
        {"LD M0\nEND\nADPRW H1 H3 H0 K1 D0", 3, "END stands above it"},
        {"LD M0\n\nADPRW H1 H3 H0 K1", 3, "takes five operands, for example ADPRW H5 H3 H0 K10 D100"},
        {"LD M0\nADPRW H1 H3 H0 K1 D0 D1", 2, "takes five operands"},
        {"LD M0\nADPRWP", 2, "for example ADPRWP H5"},
        {"LD M0\nADPRW H1 H3 H0 K1 Q0", 2, "operand 5, Q0, is none of K, H, D, R, M, X, Y, S"},
        {"LD M0\nADPRW H1 H3 H0 K1 TN0", 2, "operand 5, TN0, is none of"},
        {"LD M0\nADPRW H1 H3 H0 K1 X8", 2, "operand 5, X8, is none of"},
        {"LD M0\nADPRW 1 H3 H0 K1 D0", 2, "operand 1, 1, is none of"},
        {"LD M0\nADPRW H10000 H3 H0 K1 D0", 2, "operand 1, H10000, is no constant: K-32768 to K65535 or H0 to HFFFF"},
        {"LD M0\nADPRW H1 K65536 H0 K1 D0", 2, "operand 2, K65536, is no constant"},
        {"LD M0\nADPRW H1 H3 H0 K1 K4M0", 2, "operand 5, K4M0, is no constant"},
        {"LD M0\nADPRW H1 H3 H0 K1 D100Z0", 2, "operand 5, D100Z0, has an index register, which is not simulated"},
        {"LD M0\nADPRW H1 H3 R0V7 K1 D0", 2, "operand 3, R0V7, has an index register"},
    };
    for (const auto& row : rows) {
        CAPTURE(row.text);
        const adprw_program p = parse_adprw_program(row.text);
        REQUIRE(p.mistakes.size() == 1);
        CHECK(p.mistakes[0].line == row.line);
        CAPTURE(p.mistakes[0].text);
        CHECK(p.mistakes[0].text.find(row.says) != std::string::npos);
        CHECK_FALSE(p.asks());
    }
    CHECK(parse_adprw_program("ADPRW Q1 H3 D0Z0 K1 TN5\n").mistakes.size() == 4);
}

TEST_CASE("adprw program: the setup parser reads the same text")
{
    struct {
        const char* text;
        std::size_t mistakes;
        bool faulty;
        std::size_t registers;
    } const rows[] = {
        {"LD M8411\nMOV H1 D8401\nLD M0\nADPRW H1 H3 H0 K1 D0\nEND", 0, false, 1},
        {"LD M8411\nMOV H1 D8401\nLDI M0\nADPRW H1 H3 H0 K1 D0\nMOV K5 D8409", 0, false, 1},
        {"LD M8411\nMOV H1 D8401\nLDI M0\nMOV K1 D10\nADPRW H1 H3 H0 K1 D0\n", 0, false, 1},
        {"LD M8411\nMOV H1 D8401\nLDI M0\nOUT Y0\nADPRW H1 H3 H0 K1 D0\n", 0, false, 1},
        {"LD M8411\nMOV H1 D8401\nLDP M0\nMOV K5 D8409\nADPRWP H1 H3 H0 K1 D0\n", 0, false, 1},
        {"LD M8411\nMOV H1 D8401\nLDI M0\nMOV K5 D8409\n", 0, true, 0},  // as before: between the MOVs
        {"LD M0\nMOV K90 D10\nADPRW H1 H3 H0 K1 D0\nLD M8411\nMOV H1 D8401\n", 0, false, 1},
        {"LD M0\nMOV K500 D8409\nADPRW H1 H3 H0 K1 D0\n", 0, false, 0},
        {"LD M0\nMOV K500 D8409\n", 1, false, 0},  // no LD M8411
        {"MOV K500 D8409\nLD M8411\n", 1, false, 0},
        {"LDP\nADPRW H1 H3 H0 K1 D0\n", 1, false, 0},
        {"LD M0\nFOR K5\nADPRW H1 H3 H0 K1 D0\nNEXT\n", 2, false, 0},  // 10.4: not in a loop
    };
    for (const auto& row : rows) {
        CAPTURE(row.text);
        const setup_program p = parse_setup_program(row.text);
        CHECK(p.mistakes.size() == row.mistakes);
        CHECK(p.fault.has_value() == row.faulty);
        CHECK(p.registers.size() == row.registers);
    }
}

TEST_SUITE_END();
