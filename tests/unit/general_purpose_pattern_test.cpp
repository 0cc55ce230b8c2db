#include "bridge/messages/pattern.hpp"
#include "tests/support/messages.hpp"

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::messages;
using namespace plcgw::test;

namespace {

pattern made(std::string_view text)
{
    auto made = pattern::parse(text);
    REQUIRE_MESSAGE(made.has_value(), std::string(text));
    return std::move(*made);
}

// "+1234e-1 |kg": the values of all fields, numbers as digits and places, text as it is.
std::string read(std::string_view pattern_text, std::string_view message)
{
    const pattern p = made(pattern_text);
    const buffer received = raw(message);
    const auto captures = p.match(received);
    if (!captures)
        return "! " + to_string(captures.error());
    std::string all;
    for (std::size_t i = 0; i < captures->size(); ++i) {
        const capture& each = (*captures)[i];
        all += i == 0 ? "" : "|";
        if (!is_number(p.form_of(i)))
            all += each.text;
        else
            all += (each.number.negative ? "-" : "") + std::to_string(each.number.digits) + "e" +
                   std::to_string(-each.number.places) + (each.number.too_large ? " too large" : "");
    }
    return all;
}

struct row {
    std::string_view pattern;
    std::string_view message;
    std::string_view values;
};

// clang-format off
const row good[] = {
    {"ST,GS,{weight:+#####.#}kg",                 "ST,GS,+00123.4kg",         "1234e-1"},
    {"ST,GS,{weight:+#####.#}kg",                 "ST,GS,-00123.4kg",         "-1234e-1"},
    {"ST,GS,{weight:+#####.#}kg",                 "ST,GS,+  123.4kg",         "1234e-1"},
    {"{state:text(2)},{_:text(2)},{weight:number}{_:spaces}{unit}", "US,NT,-  0012.50  lb", "US|-1250e-2|lb"},
    // numbers
    {"{n:number}",            "42",            "42e0"},
    {"{n:number}",            "-.5",           "-5e-1"},
    {"{n:number}",            "  + 7.",        "7e0"},
    {"{n:number}",            "000000000000000000000001.5", "15e-1"},
    {"{n:number(,)}",         "1,25",          "125e-2"},
    {"{a:number},{b:number}", "1.5,-2",        "15e-1|-2e0"},
    {"{n:number}",            "18446744073709551615",  "18446744073709551615e0"},
    {"{n:number}",            "18446744073709551616",  "0e0 too large"},
    {"{v:scientific},{b:number}", "+1.25E-03,7", "125e-5|7e0"},
    {"{v:scientific}V",       "12e2V",         "12e2"},
    {"{v:scientific}",        "1E+99999999999", "1e9999"},
    // pictures
    {"{n:###}",               "123",           "123e0"},
    {"{n:###}",               "  1",           "1e0"},
    {"{n:###}{m:###}",        "123  4",        "123e0|4e0"},
    {"{n:-###.##}",           " 12.34",        "!"},
    {"{n:-##.##}",            " 12.34",        "1234e-2"},
    {"{n:-##.##}",            "-12.34",        "-1234e-2"},
    {"{n:-##.##}",            "+ 2.34",        "234e-2"},
    {"{n:##,#}",              "12,5",          "125e-1"},
    {"{n:#0.0}",              " 5.0",          "50e-1"},
    {"{n:##.#}",              "  .5",          "5e-1"},
    // hexadecimal and text
    {"<STX>{n:hex(4)}{_:hex(2)}", "\00200fFA9", "255e0"},
    {"{n:hex(16)}",           "FFFFFFFFFFFFFFFF", "18446744073709551615e0"},
    {"{code}",                "4006381333931", "4006381333931"},
    {"{code}",                "",              ""},
    {"{a},{b},{c}",           "x,,z",          "x||z"},
    {"{a} kg{b}",             "1 k kg kg",     "1 k| kg"},
    {"{name} {n:number}",     "oil 5",         "oil|5e0"},
    {"{a:text(3)}{b:text(2)}", "a,\r45",       "a,\r|45"},
    {"\\{{a}\\}\\x2C<CR>",    "{1},\r",        "1"},
    {"{n:number}{unit:text(2)}", "12.5kg",     "125e-1|kg"},
    {"{_}:{n:number}{_}",     "abc: 5 and more", "5e0"},
    {"{n:number}{_:spaces}kg", "5kg",          "5e0"},
};

const row bad[] = {
    {"ST,GS,{weight:+#####.#}kg", "US,GS,+00123.4kg", "byte 1: expected \"ST,GS,\" (character 1 of the pattern)"},
    {"ST,GS,{weight:+#####.#}kg", "ST,US,+00123.4kg", "byte 4: expected \"ST,GS,\" (character 1 of the pattern)"},
    {"ST,GS,{weight:+#####.#}kg", "ST,GS,00123.4kg",  "byte 7: expected a sign (character 7 of the pattern)"},
    {"ST,GS,{weight:+#####.#}kg", "ST,GS, 00123.4kg", "byte 7: expected a sign (character 7 of the pattern)"},
    {"ST,GS,{weight:+#####.#}kg", "ST,GS,+0123.4kg",  "byte 12: expected a digit (character 7 of the pattern)"},
    {"ST,GS,{weight:+#####.#}kg", "ST,GS,+000123.4kg", "byte 13: expected \".\" (character 7 of the pattern)"},
    {"ST,GS,{weight:+#####.#}kg", "ST,GS,+-----.-kg", "byte 8: expected a digit or a space (character 7 of the pattern)"},
    {"ST,GS,{weight:+#####.#}kg", "ST,GS,+1 234.5kg", "byte 9: expected a digit (character 7 of the pattern)"},
    {"ST,GS,{weight:+#####.#}kg", "ST,GS,+00123.4lb", "byte 15: expected \"kg\" (character 24 of the pattern)"},
    {"ST,GS,{weight:+#####.#}kg", "ST,GS,+00123.4k",  "byte 16: expected \"kg\" (character 24 of the pattern)"},
    {"ST,GS,{weight:+#####.#}kg", "ST,GS,+00123.4kg ", "byte 17: expected the end of the message"},
    {"ST,GS,{weight:+#####.#}kg", "",                 "byte 1: expected \"ST,GS,\" (character 1 of the pattern)"},
    {"{n:number}",   "",       "byte 1: expected a digit (character 1 of the pattern)"},
    {"{n:number}",   "-",      "byte 2: expected a digit (character 1 of the pattern)"},
    {"{n:number}",   "--5",    "byte 2: expected a digit (character 1 of the pattern)"},
    {"{n:number}",   ".",      "byte 2: expected a digit (character 1 of the pattern)"},
    {"{n:number}",   "1.2.3",  "byte 4: expected the end of the message"},
    {"{n:number}",   "1,2",    "byte 2: expected the end of the message"},
    {"{n:number}",   "OL",     "byte 1: expected a digit (character 1 of the pattern)"},
    {"{v:scientific}", "1E",   "byte 3: expected a digit of the exponent (character 1 of the pattern)"},
    {"{n:###}",      "   ",    "byte 4: expected a digit before here (character 1 of the pattern)"},
    {"{n:0##}",      " 12",    "byte 1: expected a digit (character 1 of the pattern)"},
    {"{n:##}",       "-1",     "byte 1: expected a digit or a space (character 1 of the pattern)"},
    {"{n:-##}",      "x12",    "byte 1: expected a sign or a space (character 1 of the pattern)"},
    {"{n:##.#}",     "12. ",   "byte 4: expected a digit (character 1 of the pattern)"},
    {"{n:hex(2)}",   "0G",     "byte 2: expected a hexadecimal digit (character 1 of the pattern)"},
    {"{n:hex(2)}",   "0",      "byte 2: expected a hexadecimal digit (character 1 of the pattern)"},
    {"{t:text(3)}",  "ab",     "byte 3: expected text of 3 characters (character 1 of the pattern)"},
    {"{t}<CR>",      "ab",     "byte 1: expected \"<CR>\" behind the text (character 1 of the pattern)"},
};

struct mistake_row {
    std::string_view pattern;
    text_mistake mistake;
};

const mistake_row mistakes[] = {
    {"",                     {1, "the pattern has no field: write one as {name:number} or {name:text}"}},
    {"ST,{_}",               {1, "the pattern has no field: write one as {name:number} or {name:text}"}},
    {"a{n",                  {2, "{ without }; for the character write \\{"}},
    {"a{n{m}",               {2, "{ without }; for the character write \\{"}},
    {"a}b{n}",               {2, "} without {; for the character write \\}"}},
    {"a{}",                  {3, "a field needs a name of letters, digits and _, or _ alone"}},
    {"a{:number}",           {3, "a field needs a name of letters, digits and _, or _ alone"}},
    {"a{my weight}",         {3, "a field needs a name of letters, digits and _, or _ alone"}},
    {"{n},{n}",              {6, "there are two fields of the name n"}},
    {"{n:}",                 {4, "\"\" is no form: expected number, number(,), scientific, hex(4), text, text(5), spaces, "
                                 "or a picture as +###.#"}},
    {"a{n:nubmer}",          {5, "\"nubmer\" is no form: expected number, number(,), scientific, hex(4), text, text(5), "
                                 "spaces, or a picture as +###.#"}},
    {"{n:text(0)}",          {9, "the number of characters must be 1 to 4096"}},
    {"{n:text(4097)}",       {9, "the number of characters must be 1 to 4096"}},
    {"{n:text(x)}",          {9, "the number of characters must be 1 to 4096"}},
    {"{n:hex(17)}",          {8, "the number of characters must be 1 to 16"}},
    {"{n:+}",                {5, "a picture needs # or 0 here"}},
    {"{n:+.#}",              {5, "a picture needs # or 0 here"}},
    {"{n:##.}",              {7, "a picture is +, - or nothing, then # or 0, then perhaps . or , and again # or 0"}},
    {"{n:##.#x}",            {8, "a picture is +, - or nothing, then # or 0, then perhaps . or , and again # or 0"}},
    {"{n:##########.#########}", {4, "a picture has at most 18 digits"}},
    {"{a}{b}",               {4, "{a} does not know where to end before {b}: put text between them, or say how long it is, "
                                 "as text(5)"}},
    {"{n:number}{m:##}",     {11, "{n:number} takes the digits that follow it: put something between them, or use a "
                                  "picture as ###.#"}},
    {"{n:number}5",          {11, "{n:number} takes the digits that follow it: put something between them, or use a "
                                  "picture as ###.#"}},
    {"{n:number}.{m}",       {11, "{n:number} takes the digits that follow it: put something between them, or use a "
                                  "picture as ###.#"}},
    {"{v:scientific}EUR",    {15, "{v:scientific} takes the digits that follow it: put something between them, or use a "
                                  "picture as ###.#"}},
    {"{_:spaces} {n}",       {11, "{_:spaces} takes the space that follows it"}},
    {"ab\\q{n}",             {3, "a \\ must be followed by one of \\ { } < r n t, or by x and two digits"}},
    {"ab<FOO>{n}",           {3, "<FOO> is no control code; for the characters write \\<FOO>"}},
};
// clang-format on

}  // namespace

TEST_CASE("pattern: numbers and text are cut out of messages")
{
    for (const row& each : good) {
        CAPTURE(each.pattern);
        CAPTURE(each.message);
        if (each.values == "!")
            CHECK(read(each.pattern, each.message).starts_with("! "));
        else
            CHECK(read(each.pattern, each.message) == each.values);
    }
}

TEST_CASE("pattern: what does not match says where and why")
{
    for (const row& each : bad) {
        CAPTURE(each.pattern);
        CAPTURE(each.message);
        CHECK(read(each.pattern, each.message) == "! " + std::string(each.values));
    }
}

TEST_CASE("pattern: mistakes have their place and the cure")
{
    for (const mistake_row& each : mistakes) {
        CAPTURE(each.pattern);
        const auto made = pattern::parse(each.pattern);
        REQUIRE_FALSE(made.has_value());
        CHECK(made.error().position == each.mistake.position);
        CHECK(made.error().text == each.mistake.text);
    }
    const std::string longest(max_pattern_size - 3, 'x');
    CHECK(pattern::parse(longest + "{n}").has_value());
    CHECK(pattern::parse(longest + "x{n}").error().position == 1025);
}

TEST_CASE("pattern: one character more, less or other than the example never matches with another value")
{
    const pattern p = made("ST,GS,{weight:+#####.#}kg");
    const buffer example = raw("ST,GS,+00123.4kg");
    for (std::size_t i = 0; i < example.size(); ++i) {
        buffer shorter = example;
        shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(i));
        CHECK_FALSE(p.match(shorter).has_value());
        buffer longer = example;
        longer.insert(longer.begin() + static_cast<std::ptrdiff_t>(i), example[i]);
        CHECK_FALSE(p.match(longer).has_value());
        CHECK_FALSE(p.match(bytes(example).first(i)).has_value());
    }
}

TEST_CASE("pattern: the names are in the order of the pattern, _ is none of them")
{
    const pattern p = made("{b:number},{_},{a_1}");
    CHECK(p.names() == std::vector<std::string>{"b", "a_1"});
    CHECK(p.form_of(0) == form::number);
    CHECK(p.form_of(1) == form::rest_of_text);
}

TEST_SUITE_END();
