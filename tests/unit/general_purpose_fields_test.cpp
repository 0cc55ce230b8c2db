#include "bridge/messages/message_reader.hpp"
#include "tests/support/messages.hpp"

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::messages;
using namespace plcgw::test;

namespace {

using memory = std::vector<std::uint16_t>;
using enum value_type;

message_reader reader_of(std::string_view text, std::vector<field> fields)
{
    auto p = pattern::parse(text);
    REQUIRE(p.has_value());
    REQUIRE(mistakes_of(*p, fields).empty());
    return {std::move(*p), std::move(fields)};
}

memory words_of(const message_reader& reader, std::size_t index)
{
    const const_words held = reader.words_of(index);
    return memory(held.begin(), held.end());
}

struct row {
    std::string_view message;
    value_type type;
    int decimals;
    memory registers;     // of a value that fits
    field_fault fault{};  // of another
};

constexpr auto out_of_range = field_fault::out_of_range;
constexpr auto negative = field_fault::negative;

// clang-format off
const row numbers[] = {
    {"+00123.4",  int32,   1, {1234, 0}},
    {"-00123.4",  int32,   1, {0xFB2E, 0xFFFF}},
    {"123.4",     int16,   0, {123}},
    {"123.5",     int16,   0, {124}},                      // halves away from zero
    {"-123.5",    int16,   0, {0xFF84}},
    {"123.49999", int16,   0, {123}},                      // rounded once
    {"0.5",       int16,   0, {1}},
    {"0.04",      int16,   1, {0}},
    {"0.0000000000000000001", int16, 0, {0}},
    {"1234",      int16,  -2, {12}},
    {"1250",      int16,  -2, {13}},
    {"5",         uint16,  3, {5000}},
    {"-0.0",      uint16,  1, {0}},
    {"-0.4",      uint16,  0, {0}},
    {"32767",     int16,   0, {0x7FFF}},
    {"32768",     int16,   0, {}, out_of_range},
    {"32767.5",   int16,   0, {}, out_of_range},
    {"-32768",    int16,   0, {0x8000}},
    {"-32769",    int16,   0, {}, out_of_range},
    {"65535",     uint16,  0, {0xFFFF}},
    {"65536",     uint16,  0, {}, out_of_range},
    {"-1",        uint16,  0, {}, negative},
    {"6553.6",    uint16,  1, {}, out_of_range},
    {"2147483647",  int32, 0, {0xFFFF, 0x7FFF}},
    {"2147483648",  int32, 0, {}, out_of_range},
    {"-2147483648", int32, 0, {0x0000, 0x8000}},
    {"-2147483649", int32, 0, {}, out_of_range},
    {"4294967295", uint32, 0, {0xFFFF, 0xFFFF}},
    {"4294967296", uint32, 0, {}, out_of_range},
    {"-1",         uint32, 0, {}, negative},
    {"18446744073709551615", int32, 0, {}, out_of_range},
    {"18446744073709551616", int32, 0, {}, out_of_range},
    {"18446744073709551615", int32, 9, {}, out_of_range},
    {"9999",      bcd16,   0, {0x9999}},
    {"123.4",     bcd16,   1, {0x1234}},
    {"10000",     bcd16,   0, {}, out_of_range},
    {"-1",        bcd16,   0, {}, negative},
    {"12345678",  bcd32,   0, {0x5678, 0x1234}},
    {"100000000", bcd32,   0, {}, out_of_range},
    {"123.4",     float32, 0, {0xCCCD, 0x42F6}},
    {"-123.4",    float32, 0, {0xCCCD, 0xC2F6}},
    {"-0",        float32, 0, {0x0000, 0x8000}},
    {"16777217",  float32, 0, {0x0000, 0x4B80}},           // to even
    {"123.4",     float32, 1, {0x4000, 0x449A}},           // 1234
    {"123.4",     float64, 0, {0x999A, 0x9999, 0xD999, 0x405E}},
    {"0.1",       float64, 0, {0x999A, 0x9999, 0x9999, 0x3FB9}},
    {"1e39",      float32, 0, {}, out_of_range},
    {"1e308",     float64, 0, {0xC8A0, 0x85EB, 0xCCF3, 0x7FE1}},
    {"1e309",     float64, 0, {}, out_of_range},
    {"1e9999999", int32,   0, {}, out_of_range},
    {"0e9999999", int32,   0, {0, 0}},
    {"5e-9999999", int32,  0, {0, 0}},
    {"1.2e3",     int16,   0, {1200}},
};
// clang-format on

}  // namespace

TEST_CASE("fields: numbers become registers of their type, low word first")
{
    for (const row& each : numbers) {
        CAPTURE(each.message);
        CAPTURE(static_cast<int>(each.type));
        message_reader reader = reader_of("{n:scientific}", {{"n", each.type, each.decimals, 0, {}}});
        const memory before = words_of(reader, 0);
        if (!each.registers.empty()) {
            CHECK(reader.read(raw(each.message)));
            CHECK(words_of(reader, 0) == each.registers);
            CHECK_FALSE(reader.last_refused().has_value());
            continue;
        }
        CHECK_FALSE(reader.read(raw(each.message)));
        CHECK(words_of(reader, 0) == before);
        CHECK(reader.counters().unfit == 1);
        CHECK(reader.last_refused()->reason == "n " + std::string(to_string(each.fault)));
    }
}

TEST_CASE("fields: high word first, where the PLC program wants it")
{
    constexpr auto high = word_order::high_first;
    message_reader reader =
        reader_of("{n:number}", {{"n", int32, 0, 0, high}, {"n", float64, 0, 0, high}, {"n", int16, 0, 0, high}});
    CHECK(reader.read(raw("305")));
    CHECK(words_of(reader, 0) == memory{0, 305});
    CHECK(words_of(reader, 1) == memory{0x4073, 0x1000, 0, 0});
    CHECK(words_of(reader, 2) == memory{305});
}

TEST_CASE("fields: text fills its registers low byte first, with zeros behind")
{
    message_reader reader = reader_of("{code},{n:number}", {{"code", text, 0, 5, {}}, {"n", text, 0, 4, {}}});
    CHECK(reader.read(raw("ABCDE,1.50")));
    CHECK(words_of(reader, 0) == memory{0x4241, 0x4443, 0x0045});
    CHECK(words_of(reader, 1) == memory{0x2E31, 0x3035});  // a number as it stood
    CHECK(reader.read(raw("Z,7")));
    CHECK(words_of(reader, 0) == memory{0x005A, 0, 0});
    CHECK(reader.read(raw(",7")));
    CHECK(words_of(reader, 0) == memory{0, 0, 0});
    CHECK_FALSE(reader.read(raw("ABCDEF,7")));
    CHECK(reader.last_refused()->reason == "code is longer than its registers");
}

TEST_CASE("fields: all of a message or none of it")
{
    message_reader reader =
        reader_of("{a:number};{b:number}", {{"a", int16, 0, 0, {}}, {"b", uint16, 0, 0, {}}, {"a", bcd16, 0, 0, {}}});
    CHECK(words_of(reader, 0) == memory{0});
    CHECK(reader.read(raw("12;34")));
    CHECK_FALSE(reader.read(raw("56;-1")));
    CHECK_FALSE(reader.read(raw("-5;1")));
    CHECK_FALSE(reader.read(raw("56;x")));
    CHECK(words_of(reader, 0) == memory{12});
    CHECK(words_of(reader, 1) == memory{34});
    CHECK(words_of(reader, 2) == memory{0x12});
    CHECK(reader.counters().matched == 1);
    CHECK(reader.counters().unfit == 2);
    CHECK(reader.counters().unmatched == 1);
}

TEST_CASE("fields: the last message that was not stored is kept for display")
{
    message_reader reader = reader_of("ST,{_:text(2)},{w:+#####.#}kg", {{"w", int32, 1, 0, {}}});
    CHECK_FALSE(reader.read(raw("ST,OL,+-----.-kg\002\x80")));
    CHECK(reader.last_refused()->message == "ST,OL,+-----.-kg<STX>\\x80");
    CHECK(reader.last_refused()->reason == "byte 8: expected a digit or a space (character 16 of the pattern)");
    CHECK_FALSE(reader.read(buffer(4096, 'x')));
    CHECK(reader.last_refused()->message == std::string(256, 'x') + "... (4096 bytes)");
    CHECK(reader.read(raw("ST,GS,+00123.4kg")));
    CHECK(reader.last_refused().has_value());  // until the next one
    CHECK(words_of(reader, 0) == memory{1234, 0});
    CHECK(reader.counters().unmatched == 2);
}

TEST_CASE("fields: what does not go together is said before anything runs")
{
    const auto p = pattern::parse("{n:number},{t}");
    REQUIRE(p.has_value());
    const auto mistakes = mistakes_of(*p, {{"n", int16, 9, 0, {}},
                                           {"m", int16, 0, 0, {}},
                                           {"t", int32, 0, 0, {}},
                                           {"t", text, 0, 0, {}},
                                           {"t", text, 0, 4097, {}},
                                           {"t", text, 0, 4096, {}},
                                           {"n", int16, 10, 0, {}},
                                           {"n", float32, -10, 0, {}}});
    CHECK(mistakes ==
          std::vector<std::string>{
              "the pattern has no field of the name m", "field t is text in the pattern, its type must be text",
              "field t: text needs room for 1 to 4096 characters", "field t: text needs room for 1 to 4096 characters",
              "field n: decimals must be -9 to 9", "field n: decimals must be -9 to 9"});
}

TEST_SUITE_END();
