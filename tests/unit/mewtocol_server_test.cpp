// A station's answers to what is wrong, and messages in several frames (the vectors M01 to M14).
#include "protocols/mewtocol/text.hpp"
#include "tests/unit/mewtocol_fake.hpp"

#include <numeric>

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol;
using namespace plcgw::test;

namespace {

std::string checked(std::string characters)
{
    append_hex(characters, bcc(characters), 2);
    return characters;
}

// DTn = n.
struct counting_bench : mewtocol_bench {
    counting_bench()
    {
        auto& dt = device.memory.at(word_area::dt);
        std::iota(dt.begin(), dt.end(), std::uint16_t{0});
    }
};

const std::string m01 = "%01#RDD000000005959";
const std::string m02 =
    "%01$RD00000100020003000400050006000700080009000A000B000C000D000E000F0010001100120013001400150016"
    "001700180019001A0061&";
const std::string m03 = "%0124&";
const std::string m04 =
    "%011B001C001D001E001F0020002100220023002400250026002700280029002A002B002C002D002E002F0030003100"
    "320033003400350054&";
const std::string m06 = "%0136003700380039003A003B0027";
const std::string m11 =
    "%01#WDD000000002900000100020003000400050006000700080009000A000B000C000D000E000F0010001100120013"
    "00140015001600170016C&";
const std::string m13 = "%0180019001A001B001C001D0010";

// What is wrong with a text, BCC added here.
struct refusal_row {
    const char* name;
    const char* text;
    const char* code;
};

// clang-format off
const refusal_row refusals[] = {
    {"nothing behind #",               "#",                 "41"},
    {"one letter",                     "#R",                "41"},
    {"no #",                           "RDD0000000000",     "41"},
    {"a response",                     "$RD0500",           "41"},
    {"lower-case command",             "#rdD0000000000",    "42"},
    {"unknown third letter",           "#RCX",              "42"},
    {"unknown third letter",           "#WCX",              "42"},
    {"unknown extended command",       "#EX00XX00",         "41"},
    {"third letter missing",           "#RC",               "41"},
    {"RCS: contact cut",               "#RCSX000",          "41"},
    {"RCS: left over",                 "#RCSX00000",        "41"},
    {"RCS: area",                      "#RCSD0000",         "60"},
    {"RCS: word not decimal",          "#RCSX0A00",         "61"},
    {"RCS: bit in lower case",         "#RCSX000a",         "61"},
    {"RCS: timer number not decimal",  "#RCST000A",         "61"},
    {"RCS: beyond the memory",         "#RCSX9990",         "61"},
    {"RCP: count 0",                   "#RCP0",             "61"},
    {"RCP: count no digit",            "#RCPAX0000",        "61"},
    {"RCP: nothing",                   "#RCP",              "41"},
    {"RCP: an item left over",         "#RCP1X0000X0001",   "41"},
    {"RCP: area of the second item",   "#RCP2X0000Z0001",   "60"},
    {"RCC: T",                         "#RCCT00000001",     "60"},
    {"RCC: last < first",              "#RCCX00010000",     "61"},
    {"RCC: left over",                 "#RCCX000000001",    "41"},
    {"WCS: no value",                  "#WCSY0000",         "41"},
    {"WCS: value 2",                   "#WCSY00002",        "61"},
    {"WCS: timer",                     "#WCST00001",        "60"},
    {"WCP: item cut",                  "#WCP1Y0000",        "41"},
    {"WCP: value",                     "#WCP1Y0000X",       "61"},
    {"WCP: X",                         "#WCP2Y00001X00001", "60"},
    {"WCC: X",                         "#WCCX000000000000", "60"},
    {"WCC: a word cut",                "#WCCY00000000000",  "41"},
    {"WCC: a word too many",           "#WCCY0000000000000000", "41"},
    {"RD: index register IZ",          "#RDIZ000000000",    "60"},
    {"RD: index register 1",           "#RDIX000000001",    "61"},
    {"RD: 100000 registers",           "#RDD0000099999",    "61"},
    {"WD: last < first",               "#WDD00001000001234", "61"},
    {"WD: no words",                   "#WDD0000000000",    "41"},
    {"WD: lower case",                 "#WDD000000000012ab", "61"},
    {"RS: cut",                        "#RS0000000",        "41"},
    {"WS: no words",                   "#WS00000000",       "41"},
    {"SC: X",                          "#SCX000000001234",  "60"},
    {"SC: two words",                  "#SCR0000000112341234", "41"},
    {"SD: index register",             "#SDIX0000000001234", "60"},
    {"SD: no word",                    "#SDD0000000000",    "41"},
    {"RR: no 0",                       "#RR1000000",        "60"},
    {"RR: beyond the memory",          "#RR0000999",        "61"},
    {"MC: nothing",                    "#MC",               "41"},
    {"MC: item cut",                   "#MCX0000Y000",      "41"},
    {"MC: area",                       "#MCD0000",          "60"},
    {"MC: number",                     "#MCX00G0",          "61"},
    {"MD: area",                       "#MDX00000",         "60"},
    {"MD: number",                     "#MDD0000A",         "61"},
    {"MD: beyond the memory",          "#MDD99999",         "61"},
    {"MG: left over",                  "#MG0",              "41"},
    {"RM: nothing",                    "#RM",               "41"},
    {"RM: neither R nor P",            "#RMX",              "60"},
    {"RT: left over",                  "#RT0",              "41"},
    {"AB: left over",                  "#AB0",              "41"},
    {"a request for a frame that is not there, as a command", "#&", "41"},
};
// clang-format on

}  // namespace

TEST_CASE("mewtocol server: each kind of bad input has its error code")
{
    for (const refusal_row& row : refusals) {
        CAPTURE(row.name);
        CAPTURE(std::string(row.text));
        mewtocol_bench b;
        CHECK(b.say(checked(std::string("%01") + row.text)) == checked(std::string("%01!") + row.code));
        CHECK(b.say(checked(std::string("<EE") + row.text)) == checked(std::string("<EE!") + row.code));
        CHECK(b.say(checked(std::string("%FF") + row.text)).empty());
        CHECK(b.say(checked(std::string("%02") + row.text)).empty());
        CHECK(b.device.writes == 0);
    }
}

TEST_CASE("mewtocol server: frames that nobody answers")
{
    mewtocol_bench b;
    CHECK(b.say(checked("%00#RT")).empty());  // not a station
    CHECK(b.say(checked("%A1#RT")).empty());
    CHECK(b.say("%01").empty());
    CHECK(b.say("%FF#RT99").empty());         // not even that its check is wrong
    CHECK(b.say(checked("%01!61")).empty());  // an error response: answered, it could go round for ever

    b.restart({.own = station_id{1}, .expansion = false});
    CHECK(b.say(checked("<01#RT")).empty());
    CHECK(b.say("<01#RT99").empty());
    CHECK(b.say("<01" + std::string(2100, '0')).empty());
    CHECK_FALSE(b.say(checked("%01#RT")).empty());
}

TEST_CASE("mewtocol server: a frame that is too long is answered with 27")
{
    mewtocol_bench b;
    const std::string zeros(2100, '0');
    CHECK(b.say("%01#WDD" + zeros.substr(0, 111)) == "%01!2700");  // V76: 119 characters
    CHECK(b.say("%EE#WDD" + zeros) == checked("%EE!27"));
    CHECK(b.say("<01#WDD" + zeros) == checked("<01!27"));
    CHECK(b.say("%FF#WDD" + zeros).empty());
    CHECK(b.say("%02#WDD" + zeros).empty());
    CHECK(b.say("%0" + zeros).empty());
    CHECK(b.say(checked("%01#WDD" + zeros.substr(0, 108))) != "%01!2700");  // 118
}

TEST_CASE("mewtocol server: a response of 60 words comes in three frames")
{
    counting_bench b;
    CHECK(b.say(m01) == m02);
    CHECK(b.say(m03) == m04);
    CHECK(b.say("%01**&") == m06);    // without a check, as most clients ask
    CHECK(b.say(m03) == "%01!4302");  // nothing more
    CHECK(b.say(checked("%01#RT")) != "%01!4302");
}

TEST_CASE("mewtocol server: another command in the middle is refused once, AB ends it without an answer")
{
    counting_bench b;
    CHECK(b.say(m01) == m02);
    CHECK(b.say("%01#RT01") == "%01!4302");
    CHECK(b.say("%01#RT01") == "%01$RT000000000000000006");
    CHECK(b.say(m01) == m02);
    CHECK(b.say("%01#AB04").empty());
    CHECK(b.say("%01#RT01") == "%01$RT000000000000000006");
    CHECK(b.say(m01) == m02);
    CHECK(b.say("%FF#WDD0000000000341255").empty());  // everybody is meant
    CHECK(b.device.memory.at(word_area::dt)[0] == 0x1234);
    CHECK(b.say(m03) == "%01!4302");
}

TEST_CASE("mewtocol server: a request for the next frame with a wrong check may be repeated")
{
    counting_bench b;
    CHECK(b.say(m01) == m02);
    CHECK(b.say("%0125&") == "%01!4001");
    CHECK(b.say(m03) == m04);
    CHECK(b.say(checked("%EE") + "&") == checked("%EE!43"));  // whoever that is, he did not ask for it
    CHECK(b.say(m03) == m06);
}

TEST_CASE("mewtocol server: the rest of a response is forgotten after its time")
{
    counting_bench b;
    CHECK(b.say(m01) == m02);
    b.now += b.options.rest_kept - 1us;
    CHECK(b.say(m03) == m04);
    b.now += b.options.rest_kept;
    CHECK(b.say("%01#RT01") == "%01$RT000000000000000006");
    CHECK(b.say(m03) == "%01!4302");
}

TEST_CASE("mewtocol server: 27 words fit into one frame, 28 do not; with `<` 509 and 510")
{
    counting_bench b;
    CHECK(b.say(checked("%01#RDD0000000026")).size() == 117 - 1);
    CHECK(b.say(checked("%01#RDD0000000027")).back() == '&');
    CHECK(b.say("%01#AB04").empty());
    CHECK(b.say(checked("<01#RDD0000000508")).size() == 2045 - 1);
    CHECK(b.say(checked("<01#RDD0000000509")) == checked("<01!43"));
    b.restart({.own = station_id{1}, .several_frames = false});
    CHECK(b.say(checked("%01#RDD0000000026")).size() == 117 - 1);
    CHECK(b.say(checked("%01#RDD0000000027")) == checked("%01!43"));
}

TEST_CASE("mewtocol server: a command of 30 words comes in two frames")
{
    mewtocol_bench b;
    CHECK(m11.size() == 117);
    CHECK(b.say(m11) == m03);
    CHECK(b.device.writes == 0);
    CHECK(b.say(m13) == "%01$WD13");
    for (std::uint16_t i = 0; i < 30; ++i)
        CHECK(b.device.memory.at(word_area::dt)[i] == i);
    CHECK(b.say(m13) == checked("%01!41"));  // the end alone
}

TEST_CASE("mewtocol server: a command in several frames that goes wrong is not executed")
{
    mewtocol_bench b;
    CHECK(b.say(m11) == m03);
    CHECK(b.say("%0180019001A001B001C001D0011") == "%01!4001");  // its check
    CHECK(b.say(m13) == checked("%01!41"));

    CHECK(b.say(m11) == m03);
    CHECK(b.say(m03).empty());                                 // our own "go on", returned by the line
    CHECK(b.say(m11) == m03);                                  // begun again
    CHECK(b.say(checked("%018001900")) == checked("%01!41"));  // words are missing

    CHECK(b.say(m11) == m03);
    b.now += b.options.rest_kept;
    CHECK(b.say(m13) == checked("%01!41"));

    CHECK(b.say(m11) == m03);
    CHECK(b.say("%01#AB04").empty());
    CHECK(b.say(m13) == checked("%01!41"));

    CHECK(b.say("%FF" + m11.substr(3, 112) + "**&").empty());
    CHECK(b.say(checked("<01#WDD00000000290000") + "&") == checked("<01!43"));
    b.restart({.own = station_id{1}, .several_frames = false});
    CHECK(b.say(m11) == "%01!4302");
    CHECK(b.device.writes == 0);
}

TEST_CASE("mewtocol server: a command without end takes no endless memory")
{
    mewtocol_bench b;
    CHECK(b.say(m11) == m03);
    const std::string piece = checked("%01" + std::string(108, '0')) + "&";
    std::string reply;
    std::size_t frames = 0;
    while ((reply = b.say(piece)) == m03)
        REQUIRE(++frames < 10'000);
    CHECK(reply == checked("%01!27"));
    CHECK(b.say(piece) == checked("%01!41"));
}

TEST_SUITE_END();
