// Files that are no JSON, or more than anybody writes: one mistake with its line, never a crash.
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>

#include <chrono>

TEST_SUITE_BEGIN("json");

using namespace plcgw::config;
using namespace std::string_view_literals;

namespace {

std::string repeated(std::string_view what, std::size_t times)
{
    std::string all;
    for (std::size_t i = 0; i < times; ++i)
        all += what;
    return all;
}

constexpr const char* value_expected =
    "unexpected end of input; expected '[', '{', or a literal: is the file complete?";

}  // namespace

TEST_CASE("syntax: what is wrong, on its line")
{
    struct {
        std::string what;
        std::string_view text;
        std::string expected;
    } const rows[] = {
        {"empty file", "", std::string("1 is no JSON: ") + value_expected},
        {"blanks", "  \n\n", std::string("2 is no JSON: ") + value_expected},
        {"only comments", "// one\n/* two\n*/\n", std::string("3 is no JSON: ") + value_expected},
        {"only a byte order mark", "\xEF\xBB\xBF", std::string("1 is no JSON: ") + value_expected},
        {"half a byte order mark", "\xEF\xBB{}",
         "1 is no JSON: invalid BOM; must be 0xEF 0xBB 0xBF if given; last read: '\xEF\xBB{'"},

        {"cut behind a key", "{\n\"gateway\"\n",
         "2 is no JSON: unexpected end of input; expected ':': is the file complete?"},
        {"cut behind a colon", "{\n\"gateway\":\n", std::string("2 is no JSON: ") + value_expected},
        {"cut behind a value", "{\n\"gateway\": \"a\"\n",
         "2 is no JSON: unexpected end of input; expected '}': is the file complete?"},
        {"cut inside an array", "{\"plcs\": [\n\n{}",
         "3 is no JSON: unexpected end of input; expected ']': is the file complete?"},
        {"cut inside a text", "{\n\"gateway\": \"pla",
         "2 is no JSON: invalid string: missing closing quote; last read: '\"pla'"},
        {"cut inside a comment", "{}\n/* one\n",
         "2 is no JSON: invalid comment; missing closing '*/'; last read: '{}<U+000A>/* one<U+000A>'; expected end of "
         "input"},

        {"comma at the end of an object", "{\n\"gateway\": \"a\",\n}\n",
         "3 is no JSON: unexpected '}'; expected string literal: is there a comma too many before it?"},
        {"comma at the end of an array", "{\"plcs\": [\n{},\n\n]}\n",
         "4 is no JSON: unexpected ']'; expected '[', '{', or a literal: is there a comma too many before it?"},
        {"comma at the end, a comment behind it", "{\"gateway\": \"a\", // last\n}\n",
         "2 is no JSON: unexpected '}'; expected string literal: is there a comma too many before it?"},
        {"two commas", "[1,\n,2]", "2 is no JSON: unexpected ','; expected '[', '{', or a literal"},
        {"no comma between keys", "{\"gateway\": \"a\"\n\"plcs\": []}",
         "2 is no JSON: unexpected string literal; expected '}': is a comma missing before it?"},
        {"no comma between numbers", "[1\n2]",
         "2 is no JSON: unexpected number literal; expected ']': is a comma missing before it?"},
        {"no comma between texts", "[\"a\"\n\"b\"]",
         "2 is no JSON: unexpected string literal; expected ']': is a comma missing before it?"},
        {"no comma between objects", "[{}\n\n{}]",
         "3 is no JSON: unexpected '{'; expected ']': is a comma missing before it?"},
        {"no colon", "{\"gateway\"\n\"a\"}", "2 is no JSON: unexpected string literal; expected ':'"},
        {"wrong bracket", "{\"plcs\": [\n}", "2 is no JSON: unexpected '}'; expected '[', '{', or a literal"},
        {"a bracket too many", "{}\n}\n", "2 is no JSON: unexpected '}'; expected end of input"},
        {"two values", "{}\n{}\n", "2 is no JSON: unexpected '{'; expected end of input"},

        {"single quotes", "{\n'gateway': 1}",
         "2 is no JSON: invalid literal; last read: '{<U+000A>''; expected string literal"},
        {"key without quotes", "{\ngateway: 1}",
         "2 is no JSON: invalid literal; last read: '{<U+000A>g'; expected string literal"},
        {"# is no comment", "# one\n{}", "1 is no JSON: invalid literal; last read: '#'"},
        {"line break in a text", "{\n\"gateway\": \"a\nb\"}",
         "2 is no JSON: invalid string: control character U+000A (LF) must be escaped to \\u000A or \\n; last read: "
         "'\"a<U+000A>'"},
        {"unknown escape", "[\n\"\\x\"]",
         "2 is no JSON: invalid string: forbidden character after backslash; last read: '\"\\x'"},
        {"half a surrogate pair", "[\n\"\\uD800\"]",
         "2 is no JSON: invalid string: surrogate U+D800..U+DBFF must be followed by U+DC00..U+DFFF; last read: "
         "'\"\\uD800\"'"},
        {"invalid UTF-8", "{\n\"gateway\": \"\xFF\"}",
         "2 is no JSON: invalid string: ill-formed UTF-8 byte; last read: '\"\xFF'"},
        {"UTF-8 that is longer than it must be", "[\n\"\xC0\x80\"]",
         "2 is no JSON: invalid string: ill-formed UTF-8 byte; last read: '\"\xC0'"},

        {"leading zero", "[\n01]",
         "2 is no JSON: unexpected number literal; expected ']': is a comma missing before it?"},
        {"hexadecimal", "[\n0x10]", "2 is no JSON: invalid literal; last read: '0x'; expected ']'"},
        {"number beyond every double", "{\"lines\": [\n1e999]}", "2 is no JSON: number overflow parsing '1e999'"},
        {"and negative", "{\"lines\": [\n-1e999]}", "2 is no JSON: number overflow parsing '-1e999'"},
        {"no number", "[\nNaN]", "2 is no JSON: invalid literal; last read: '[<U+000A>N'"},

        {"zero byte behind the end", "{}\n\0garbage"sv, "2 holds a zero byte: save the file as UTF-8"},
        {"zero byte inside", "{\n\n\"gateway\": \0 1}"sv, "3 holds a zero byte: save the file as UTF-8"},
        {"zero byte in a comment", "// \0\n{}"sv, "1 holds a zero byte: save the file as UTF-8"},
        {"UTF-16", "\xFF\xFE{\0}\0"sv, "1 holds a zero byte: save the file as UTF-8"},

        {"no object", "[]", "1 the file holds no object: { ... }"},
        {"a number", "7", "1 the file holds no object: { ... }"},
        {"null", "null", "1 the file holds no object: { ... }"},
    };
    for (const auto& row : rows) {
        INFO(row.what);
        CHECK(said(row.text) == row.expected);
    }
}

TEST_CASE("syntax: keys that stand twice are told besides")
{
    CHECK(said("{\"gateway\": \"a\",\n\"gateway\": \"b\",\n}") ==
          "2 /gateway stands here for the second time: remove one\n"
          "3 is no JSON: unexpected '}'; expected string literal: is there a comma too many before it?");
}

TEST_CASE("syntax: a file cut at every place has a mistake on its last line")
{
    for (std::size_t size = 0; size + 2 < plant.size(); ++size) {
        const std::string_view cut = plant.substr(0, size);
        const loaded result = load_text(cut, {});
        INFO(size);
        REQUIRE(result.found.size() == 1);
        const std::size_t last = cut.empty() ? 0 : cut.size() - 1;  // a line break belongs to the line that it ends
        CHECK(result.found[0].line == 1U + static_cast<std::size_t>(std::count(cut.begin(), cut.begin() + last, '\n')));
    }
}

TEST_CASE("syntax: any byte in any place is survived")
{
    constexpr std::string_view small = R"({"plcs":[{"name":"a","program":["LD M8411"]}],"dds":{"domain":0}/**/})";
    REQUIRE(said(small).empty());
    for (std::size_t at = 0; at < small.size(); ++at)
        for (int byte = 0; byte < 256; ++byte) {
            std::string spoilt(small);
            spoilt[at] = static_cast<char>(byte);
            for (const mistake& m : load_text(spoilt, {}).found)
                CHECK(m.line <= 2);
        }
}

TEST_CASE("syntax: nesting without end")
{
    constexpr const char* too_deep = "1 is nested deeper than any configuration: look for a bracket too many";
    const auto start = std::chrono::steady_clock::now();
    CHECK(said(repeated("[", 100'000)) == too_deep);
    CHECK(said(repeated("[", 100'000) + repeated("]", 100'000)) == too_deep);
    CHECK(said(repeated("{\"plcs\":", 20'000)) == too_deep);
    CHECK(said(repeated("{\"plcs\":[", 20'000) + repeated("]}", 20'000)) == too_deep);
    CHECK(said(repeated("[\n", 100'000)) == "33 is nested deeper than any configuration: look for a bracket too many");
    CHECK(said(repeated("]", 100'000)).starts_with("1 is no JSON: unexpected ']'"));
    CHECK(said("{\"plcs\": " + repeated("[", 31) + repeated("]", 31) + "}") == "1 /plcs/0 is no object: { ... }");
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
}

TEST_CASE("syntax: much of anything")
{
    CHECK(said("{\"gateway\": \"" + std::string(1'000'000, 'a') + "\"}") ==
          "1 /gateway is longer than 64 bytes: shorten it");
    CHECK(said("{\"gateway\": \"" + std::string(1'000'000, 'a')) ==
          "1 is no JSON: invalid string: missing closing quote");
    CHECK(said("/*" + std::string(1'000'000, '*') + "/{}").empty());
    CHECK(said(std::string(1'000'000, '\n') + "]").starts_with("1000001 is no JSON"));
    CHECK(said("{\"dds\": {\"domain\": 1" + std::string(300, '0') + "}}") ==
          "1 /dds/domain is 1e+300, expected a whole number from 0 to 230");
    CHECK(said("{\"dds\": {\"domain\": 1" + std::string(100'000, '0') + "}}").substr(0, 49) ==
          "1 is no JSON: number overflow parsing '1000000000");
    CHECK(said("{\"dds\": {\"domain\": 1" + std::string(100'000, '0') + "}}").size() < 200);
    CHECK(load_text("{\"plcs\": [" + repeated("{},", 1000) + "{}]}", {}).found.size() == 1001);
}

TEST_CASE("syntax: what is printed holds no control characters and no broken UTF-8")
{
    const mistake key{"/a\nb\x1B[2J", 1, "is no known key", mistake::weight::error};
    CHECK(to_string("a.json", key) == "a.json:1: /a\\nb\\u001b[2J is no known key");
    const mistake bytes{"", 2, "unknown \xFF\xFE", mistake::weight::error};
    CHECK(to_string("a.json", bytes) == "a.json:2: unknown \xEF\xBF\xBD\xEF\xBF\xBD");
    const mistake quotes{"", 0, "is \"x\" \\ y, grüß", mistake::weight::warning};
    CHECK(to_string("a \"b\".json", quotes) == "a \"b\".json: warning: is \"x\" \\ y, grüß");
}
