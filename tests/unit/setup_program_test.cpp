#include "bridge/plc/setup_program.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("plc");

using namespace plcgw::plc;

namespace {

using registers = std::map<std::uint32_t, std::uint16_t>;

// A program of one MOV.
setup_program one_move(const std::string& move) { return parse_setup_program("LD M8411\n" + move); }

}  // namespace

TEST_CASE("setup program: instructions, comments, step numbers, either case, either line end")
{
    const setup_program p = parse_setup_program("; communication setup of the mixing plant\r\n"
                                                "0 LD M8411\r\n"
                                                "\r\n"
                                                "  1 MOV H1097 D8400   // RS-485, 19200, 8E1\r\n"
                                                "6\tmov\th1, d8401\r\n"
                                                "MOV K2000 D8409; timeout\r\n"
                                                "// MOV K1 D8410\r\n"
                                                "MOV K-1 D8416\n"
                                                "17\n"
                                                "END");
    CHECK(p.mistakes.empty());
    CHECK_FALSE(p.fault.has_value());
    CHECK(p.registers == registers{{8400, 0x1097}, {8401, 1}, {8409, 2000}, {8416, 0xFFFF}});
    CHECK(p.lines == std::map<std::uint32_t, std::size_t>{{8400, 4}, {8401, 5}, {8409, 6}, {8416, 8}});
}

TEST_CASE("setup program: an empty one sets nothing and is no mistake")
{
    for (const char* text : {"", "\n\n", "; nothing\n", "END\n", "LD M8411\nEND\n"}) {
        const setup_program p = parse_setup_program(text);
        CHECK(p.mistakes.empty());
        CHECK(p.registers.empty());
        CHECK_FALSE(p.fault.has_value());
    }
}

TEST_CASE("setup program: constants and their limits")
{
    struct {
        const char* text;
        std::uint16_t value;
    } const valid[] = {{"K0", 0}, {"K32767", 32767}, {"K65535", 65535}, {"K-1", 0xFFFF}, {"K-32768", 0x8000},
                       {"H0", 0}, {"HFFFF", 0xFFFF}, {"h5002", 0x5002}, {"H00A1", 0xA1}, {"k10", 10}};
    for (const auto& row : valid) {
        CAPTURE(row.text);
        const setup_program p = one_move(std::string("MOV ") + row.text + " D8470");
        CHECK(p.mistakes.empty());
        CHECK(p.registers == registers{{8470, row.value}});
    }
    for (const char* text : {"K65536", "K-32769", "H10000", "H-1", "HG", "K1A", "K", "H", "K1.5", "10", "#5", "K+1"}) {
        CAPTURE(text);
        const setup_program p = one_move(std::string("MOV ") + text + " D8470");
        REQUIRE(p.mistakes.size() == 1);
        CHECK(p.mistakes[0].line == 2);
        CHECK(p.registers.empty());
    }
}

TEST_CASE("setup program: with two LD M8411 only the last counts")
{
    const setup_program p = parse_setup_program("LD M8411\nMOV K5 D8414\nMOV K0 D8434\n"
                                                "LD M8000\nMOV K1 D100\n"
                                                "LD M8411\nMOV K7 D8414\nEND\n");
    CHECK(p.mistakes.empty());
    CHECK(p.registers == registers{{8414, 7}});
    CHECK_FALSE(p.fault.has_value());  // that of the first block is forgotten with it
    CHECK(p.lines.at(8414) == 7);

    const setup_program mended = parse_setup_program("LD M8411\nAND M0\nMOV K5 D8414\nLD M8411\nMOV K7 D8414\n");
    CHECK(mended.registers == registers{{8414, 7}});
    CHECK_FALSE(mended.fault.has_value());

    const setup_program emptied = parse_setup_program("LD M8411\nMOV K5 D8414\nLD M8411\nEND\n");
    CHECK(emptied.registers.empty());
}

TEST_CASE("setup program: a contact or coil between LD M8411 and the MOVs voids the block")
{
    for (const char* contact : {"AND M0", "ANI X1", "OR M8000", "OUT Y0", "SET M1", "RST M1", "LDI M2"}) {
        CAPTURE(contact);
        const setup_program p =
            parse_setup_program(std::string("LD M8411\nMOV K1 D8401\n") + contact + "\nMOV K5 D8414\n");
        CHECK(p.mistakes.empty());
        REQUIRE(p.fault.has_value());
        CHECK(p.fault->detail == 8411);
        CHECK(p.fault->line == 3);
        CHECK(p.registers.empty());
        CHECK(p.lines.empty());
    }
}

TEST_CASE("setup program: a source that is no constant voids the block")
{
    const setup_program p = parse_setup_program("LD M8411\nMOV H1097 D8400\nMOV D100 D8414\nMOV K1 D8401\n");
    CHECK(p.mistakes.empty());
    REQUIRE(p.fault.has_value());
    CHECK(p.fault->detail == 8411);
    CHECK(p.fault->line == 3);
    CHECK(p.registers.empty());
}

TEST_CASE("setup program: what the parameter registers take, FX3 manual 6.1")
{
    struct {
        std::uint32_t number;
        int value;
        bool valid;
    } const rows[] = {
        {8409, 0, true},     {8409, 32767, true},  {8409, 32768, false}, {8409, -1, false},    {8429, 32768, false},
        {8410, 0, true},     {8410, 32767, true},  {8410, 32768, false}, {8430, 40000, false}, {8411, 0, true},
        {8411, 16382, true}, {8411, 16383, false}, {8431, 16383, false}, {8414, 0, false},     {8414, 1, true},
        {8414, 247, true},   {8414, 248, false},   {8434, 0, false},     {8434, 247, true},    {8434, 248, false},
        {8412, 20, true},    {8412, 99, true},  // more than 20 retries count as 20
    };
    for (const auto& row : rows) {
        CAPTURE(row.number);
        CAPTURE(row.value);
        const setup_program p = one_move("MOV K" + std::to_string(row.value) + " D" + std::to_string(row.number));
        CHECK(p.mistakes.empty());
        CHECK(p.registers.contains(row.number) == row.valid);
        REQUIRE(p.fault.has_value() == !row.valid);
        if (p.fault) {
            CHECK(p.fault->detail == row.number);
            CHECK(p.fault->line == 2);
        }
    }
}

TEST_CASE("setup program: the first wrong parameter is reported, the others are set")
{
    const setup_program p = parse_setup_program("LD M8411\nMOV K248 D8414\nMOV K40000 D8409\nMOV K3 D8412\n");
    REQUIRE(p.fault.has_value());
    CHECK(p.fault->detail == 8414);
    CHECK(p.fault->reason == "D8414 = 248 is not within 1 to 247");
    CHECK(p.registers == registers{{8412, 3}});
}

TEST_CASE("setup program: what is no setup program is reported with its line")
{
    struct {
        const char* text;
        std::size_t line;
    } const rows[] = {
        {"LD M8411\nMOV K1 D8401\nADD K1 D0\n", 3},  // unknown instruction
        {"LD M8411\nMOVP K1 D8401\n", 2},
        {"LD M8411\nMOV K1 D100\n", 2},   // no setting
        {"LD M8411\nMOV K1 D8402\n", 2},  // an error code is no setting
        {"LD M8411\nMOV K1 D8486\n", 2},
        {"LD M8411\nMOV K1 R8470\n", 2},
        {"LD M8411\nMOV K1\n", 2},
        {"LD M8411\nMOV K1 D8401 D8402\n", 2},
        {"LD M8411\nMOV K1 D8401X\n", 2},
        {"LD\n", 1},
        {"LD M8411 M1\n", 1},
        {"LD 8411\n", 1},
        {"\nMOV K1 D8401\nLD M8411\n", 2},  // above LD M8411
        {"LD M8411\nAND\n", 2},
        {"LD M8411\n\n\nMOV Z9 D8401\n", 4},
    };
    for (const auto& row : rows) {
        CAPTURE(row.text);
        const setup_program p = parse_setup_program(row.text);
        REQUIRE(p.mistakes.size() == 1);
        CHECK(p.mistakes[0].line == row.line);
        CHECK_FALSE(p.mistakes[0].text.empty());
    }
}

TEST_CASE("setup program: every mistake is reported at once")
{
    const setup_program p = parse_setup_program("LD M8411\nMOV K99999 D8401\nFOO\nMOV K1 D1\nMOV H1 D8401\n");
    REQUIRE(p.mistakes.size() == 3);
    CHECK(p.mistakes[0].line == 2);
    CHECK(p.mistakes[1].line == 3);
    CHECK(p.mistakes[2].line == 4);
}

TEST_CASE("setup program: ordinary program below another contact is none of our business")
{
    const setup_program p = parse_setup_program("LD M8411\nMOV K1 D8401\nLD X0\nAND X1\nOUT Y0\nMOV D1 D2\nEND\n");
    CHECK(p.mistakes.empty());
    CHECK_FALSE(p.fault.has_value());
    CHECK(p.registers == registers{{8401, 1}});
}

TEST_SUITE_END();
