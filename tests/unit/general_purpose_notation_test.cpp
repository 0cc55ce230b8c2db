#include "bridge/messages/notation.hpp"
#include "tests/support/messages.hpp"

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::messages;
using namespace plcgw::test;

TEST_CASE("notation: control codes by name and by number")
{
    const struct {
        std::string_view text;
        buffer meaning;
    } rows[] = {
        {"", {}},
        {"Q1", {'Q', '1'}},
        {"<STX>01<ETX>", {2, '0', '1', 3}},
        {"<ENQ>", {5}},
        {"\\x05", {5}},
        {"\\xfF\\xA0", {0xFF, 0xA0}},
        {"P<CR><LF>", {'P', 13, 10}},
        {"P\\r\\n\\t", {'P', 13, 10, 9}},
        {"<TAB><HT><XON><XOFF><DEL><NUL>", {9, 9, 0x11, 0x13, 0x7F, 0}},
        {"\\\\\\{\\}\\<", {'\\', '{', '}', '<'}},
        {"{}", {'{', '}'}},
        {"<01#RCSX0000**", {'<', '0', '1', '#', 'R', 'C', 'S', 'X', '0', '0', '0', '0', '*', '*'}},
        {"a<b", {'a', '<', 'b'}},
        {"<cr>", {'<', 'c', 'r', '>'}},
        {"<X>", {'<', 'X', '>'}},
        {"\\<STX>", {'<', 'S', 'T', 'X', '>'}},
    };
    for (const auto& each : rows) {
        CAPTURE(each.text);
        const auto meaning = parse_bytes(each.text);
        REQUIRE(meaning.has_value());
        CHECK(*meaning == each.meaning);
    }
}

TEST_CASE("notation: mistakes have their place")
{
    const struct {
        std::string_view text;
        std::size_t position;
    } rows[] = {{"\\", 1},    {"ab\\", 3},  {"ab\\q", 3},      {"\\x", 1},    {"1\\x5", 2},
                {"\\xG0", 1}, {"\\x0G", 1}, {"<STX><FOO>", 6}, {"a<STXX>", 2}};
    for (const auto& each : rows) {
        CAPTURE(each.text);
        const auto meaning = parse_bytes(each.text);
        REQUIRE_FALSE(meaning.has_value());
        CHECK(meaning.error().position == each.position);
        CHECK_FALSE(meaning.error().text.empty());
    }
    CHECK(parse_bytes("<STX><FOO>").error().text == "<FOO> is no control code; for the characters write \\<FOO>");
}

TEST_CASE("notation: what is shown can be written back, for every byte and pair")
{
    CHECK(printable(raw("\002ST,GS\r\n")) == "<STX>ST,GS<CR><LF>");
    CHECK(printable(buffer{0x80, 0xFF, '\\', 0, 9}) == "\\x80\\xFF\\\\<NUL><HT>");
    CHECK(printable(raw("<CR> < >")) == "\\<CR> < >");
    buffer all;
    for (unsigned i = 0; i < 256; ++i)
        all.push_back(static_cast<std::uint8_t>(i));
    CHECK(*parse_bytes(printable(all)) == all);
    for (const std::string_view text : {"<<STX>>", "<ABC>", "\\<CR>", "\\x05", "<\002>", "<12345>", "<ABCDE>"})
        CHECK(*parse_bytes(printable(raw(text))) == raw(text));
}

TEST_CASE("notation: long messages are shown shortened, with their size")
{
    CHECK(printable(raw("abcd"), 4) == "abcd");
    CHECK(printable(raw("abcde"), 4) == "abcd... (5 bytes)");
}

TEST_SUITE_END();
