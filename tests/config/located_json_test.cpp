// The line of every value, however the file is written.
#include "daemon/config/located_json.hpp"

#include <doctest/doctest.h>

#include <string>

TEST_SUITE_BEGIN("json");

using namespace plcgw::config;

namespace {

located_json parsed(std::string_view text)
{
    mistakes found;
    located_json result = parse_located(text, found);
    CHECK(found.empty());
    CHECK(result.complete);
    return result;
}

}  // namespace

TEST_CASE("located json: where each value stands")
{
    struct {
        std::string what;
        std::string_view text;
        const char* pointer;
        std::size_t line;
    } const rows[] = {
        {"first line", R"({"a": 1})", "/a", 1},
        {"the file itself", "\n\n{}", "", 1},
        {"object in object", "{\n\"a\": {\n\"b\": {\n\"c\": 1}}}", "/a/b/c", 4},
        {"the object around it", "{\n\"a\": {\n\"b\": {\n\"c\": 1}}}", "/a/b", 3},
        {"key on another line than its value", "{\"x\": 0,\n\"a\"\n:\n\n1}", "/a", 2},
        {"key on another line than its object", "{\n\"a\":\n\n{\n\"b\": 1}}", "/a", 2},
        {"inside that object", "{\n\"a\":\n\n{\n\"b\": 1}}", "/a/b", 5},

        {"number at the end of a line", "[1\n,2\n,3\n]", "/0", 1},
        {"number below a number", "[1\n,2\n,3\n]", "/1", 2},
        {"last number", "[1\n,2\n,3\n]", "/2", 3},
        {"float at the end of a line", "[1,\n2.5e3\n]", "/1", 2},
        {"number before a comment", "[1,\n2// two\n,\n3]", "/1", 2},
        {"number after that comment", "[1,\n2// two\n,\n3]", "/2", 4},
        {"literals at the end of a line", "[true\n,null\n,false\n]", "/2", 3},

        {"array element", "[\n\"a\",\n\"b\"\n]", "/1", 3},
        {"object in an array", "[\n{},\n\n{\n\"a\": 1}]", "/1", 4},
        {"in an object in an array", "[\n{},\n\n{\n\"a\": 1}]", "/1/a", 5},
        {"array in an array", "[[\n1],\n[\n2,\n3]]", "/1/1", 5},
        {"eleventh element", "[0,1,2,3,4,5,6,7,8,9,\n10]", "/10", 2},

        {"after a line comment", "// one\n// two\n{\n\"a\": 1}", "/a", 4},
        {"after a block comment", "/* one\ntwo\n*/ {\n\"a\": 1}", "/a", 4},
        {"after a comment with a quote and a brace", "{ // \"a\": {\n\"b\": 1}", "/b", 2},
        {"after a comment in the middle of a value", "{\"a\": /* one\n */ [\n1]}", "/a/0", 3},
        {"slashes in a text are no comment", "{\"a\": \"http://b /* c\",\n\"d\": 1}", "/d", 2},
        {"after an empty comment", "/**/{\n//\n\"a\": 1}", "/a", 3},

        {"CR LF", "{\r\n\"a\": 1,\r\n\"b\": [\r\n1\r\n,2]}\r\n", "/b/1", 5},
        {"CR LF after a comment", "// one\r\n{\r\n\"a\": 1}", "/a", 3},
        {"byte order mark", "\xEF\xBB\xBF{\n\"a\": 1}", "/a", 2},
        {"no line break at the end", "{\n\"a\":\n[\n1]}", "/a/0", 4},
        {"escaped line break in a text", "[\"a\\nb\",\n1]", "/1", 2},

        {"slash in a key", "{\n\"a/b\": 1}", "/a~1b", 2},
        {"tilde in a key", "{\n\"a~b\": 1}", "/a~0b", 2},
        {"both, and what looks escaped", "{\n\"~1/\": {\n\"~0\": 1}}", "/~01~1/~00", 3},
        {"empty key", "{\n\"\": {\n\"\": 1}}", "//", 3},
        {"key with an escape", "{\n\"\\u0061\": 1}", "/a", 2},
    };
    for (const auto& row : rows) {
        INFO(row.what);
        CHECK(parsed(row.text).lines.count(row.pointer) == (std::string_view(row.pointer).empty() ? 0 : 1));
        CHECK(parsed(row.text).line_of(row.pointer) == row.line);
    }
}

TEST_CASE("located json: what is absent stands where its parent does")
{
    const located_json file = parsed("{\n\"a\": [\n1,\n{\n\"b\": 2}]}");
    CHECK(file.line_of("/a/1/absent") == 4);
    CHECK(file.line_of("/a/1/absent/deeper/0") == 4);
    CHECK(file.line_of("/a/7") == 2);
    CHECK(file.line_of("/absent") == 1);
    CHECK(file.line_of("") == 1);
}

TEST_CASE("located json: values are those of the JSON library")
{
    constexpr std::string_view text =
        R"({"a": [1, -2, 3.5, true, null, "x", [], {}, [[{"b": {"c": [0]}}]]], "d": {"e": "f"}})";
    CHECK(parsed(text).value == nlohmann::json::parse(text));
    CHECK(parsed("7").value == 7);
    CHECK(parsed("[18446744073709551615]").value.at(0) == 18446744073709551615U);
    CHECK(parsed("[18446744073709551616]").value.at(0).is_number_float());
    CHECK(parsed("[-9223372036854775809]").value.at(0).is_number_float());
}

TEST_CASE("located json: a key that stands twice")
{
    struct {
        std::string_view text;
        const char* pointer;
        std::size_t line;
    } const rows[] = {
        {"{\"a\": 1,\n\"b\": 2,\n\"a\": 3}", "/a", 3},
        {"{\"x\": {\"a\": 1,\n\"a\": {}}}", "/x/a", 2},
        {"[0, {\"a/b\": [1, 2],\n\"a/b\": [3]}]", "/1/a~1b", 2},
        {"{\"a\": 1,\n\"\\u0061\": 1}", "/a", 2},
    };
    for (const auto& row : rows) {
        mistakes found;
        CHECK(parse_located(row.text, found).complete);
        REQUIRE(found.size() == 1);
        CHECK(found[0].pointer == row.pointer);
        CHECK(found[0].line == row.line);
        CHECK(found[0].text == "stands here for the second time: remove one");
    }
    parsed(R"({"a": 1, "A": 2, "b": {"a": 3}, "c": [{"a": 4}, {"a": 5}]})");
}
