// Bytes and registers of typed values.
#include "bridge/points/point.hpp"
#include "tests/support/print.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <limits>
#include <random>

TEST_SUITE_BEGIN("points");

using namespace plcgw;

using regs = std::vector<std::uint16_t>;

namespace {

constexpr byte_order all_orders[] = {byte_order::abcd, byte_order::cdab, byte_order::badc, byte_order::dcba};

point_form form(value_type type, byte_order order = byte_order::abcd)
{
    point_form f;
    f.type = type;
    f.order = order;
    return f;
}

}  // namespace

TEST_CASE("points: registers of every order, as the table in docs/points.md shows them")
{
    const struct {
        byte_order order;
        regs of_16;
        regs of_32;
        regs of_64;
    } rows[] = {
        // clang-format off
        {byte_order::abcd, {0x1234}, {0x1234, 0x5678}, {0x1234, 0x5678, 0x9ABC, 0xDEF0}},
        {byte_order::cdab, {0x1234}, {0x5678, 0x1234}, {0xDEF0, 0x9ABC, 0x5678, 0x1234}},
        {byte_order::badc, {0x3412}, {0x3412, 0x7856}, {0x3412, 0x7856, 0xBC9A, 0xF0DE}},
        {byte_order::dcba, {0x3412}, {0x7856, 0x3412}, {0xF0DE, 0xBC9A, 0x7856, 0x3412}},
        // clang-format on
    };
    for (const auto& row : rows) {
        CAPTURE(static_cast<int>(row.order));
        regs one(1);
        regs two(2);
        regs four(4);
        put_bits(0x1234, row.order, one);
        put_bits(0x12345678, row.order, two);
        put_bits(0x123456789ABCDEF0, row.order, four);
        CHECK(one == row.of_16);
        CHECK(two == row.of_32);
        CHECK(four == row.of_64);
        CHECK(get_bits(row.order, row.of_16) == 0x1234);
        CHECK(get_bits(row.order, row.of_32) == 0x12345678);
        CHECK(get_bits(row.order, row.of_64) == 0x123456789ABCDEF0);
    }
}

TEST_CASE("points: what registers hold")
{
    const struct {
        value_type type;
        regs words;
        point_value value;
    } rows[] = {
        // clang-format off
        {value_type::boolean, {1},                              boolean_value(true)},
        {value_type::int16,   {0xFFFF},                         integer_value(-1)},
        {value_type::int16,   {0x8000},                         integer_value(-32768)},
        {value_type::uint16,  {0xFFFF},                         integer_value(65535)},
        {value_type::int32,   {0xFFFF, 0xFFFE},                 integer_value(-2)},
        {value_type::int32,   {0x8000, 0},                      integer_value(-2147483648)},
        {value_type::uint32,  {0xFFFF, 0xFFFF},                 integer_value(4294967295)},
        {value_type::int64,   {0xFFFF, 0xFFFF, 0xFFFF, 0xFFFF}, integer_value(-1)},
        {value_type::int64,   {0x8000, 0, 0, 0},                integer_value(std::numeric_limits<std::int64_t>::min())},
        {value_type::uint64,  {0x7FFF, 0xFFFF, 0xFFFF, 0xFFFF}, integer_value(std::numeric_limits<std::int64_t>::max())},
        {value_type::uint64,  {0x8000, 0, 0, 0},                real_value(9223372036854775808.0)},
        {value_type::float32, {0x42F6, 0xE979},                 real_value(123.456001281738281250)},
        {value_type::float64, {0x405E, 0xDD2F, 0x1A9F, 0xBE77}, real_value(123.456)},
        {value_type::bcd16,   {0x1234},                         integer_value(1234)},
        {value_type::bcd32,   {0x1234, 0x5678},                 integer_value(12345678)},
        // clang-format on
    };
    for (const auto& row : rows) {
        const auto f = form(row.type);
        const auto value = decode(f, row.words);
        REQUIRE(value.has_value());
        CHECK(*value == row.value);
        const auto back = encode(f, row.value);
        if (back)  // 2^63 as a double is exact, so it comes back as well
            CHECK(*back == row.words);
        else
            FAIL(back.error().text);
    }
}

TEST_CASE("points: registers that hold no value")
{
    const struct {
        value_type type;
        regs words;
    } rows[] = {
        {value_type::float32, {0x7FC0, 0}}, {value_type::float32, {0x7F80, 0}},
        {value_type::float32, {0xFF80, 0}}, {value_type::float64, {0x7FF8, 0, 0, 0}},
        {value_type::bcd16, {0x123A}},      {value_type::bcd32, {0xF000, 0}},
    };
    for (const auto& row : rows)
        CHECK_FALSE(decode(form(row.type), row.words).has_value());
}

TEST_CASE("points: scale and offset, there and back")
{
    point_form f = form(value_type::int16);
    f.scale = 0.1;
    f.offset = -40;
    CHECK(decode(f, regs{615})->real == doctest::Approx(21.5));
    CHECK(decode(f, regs{615})->kind == point_kind::real);
    CHECK(decode(f, regs{615})->integer == 21);
    CHECK(*encode(f, real_value(21.5)) == regs{615});
    CHECK(*encode(f, integer_value(-40)) == regs{0});
    CHECK(*encode(f, real_value(21.54)) == regs{615});  // to the nearest number in the registers
    CHECK(*encode(f, real_value(21.56)) == regs{616});
    point_form halves = form(value_type::int16);
    halves.scale = 0.5;
    CHECK(*encode(halves, real_value(1.25)) == regs{3});  // away from zero
    CHECK(*encode(halves, real_value(-1.25)) == regs{0xFFFD});
    CHECK(encode(f, real_value(4000)).error().text == "4000 does not fit the registers, which hold -3316.8 to 3236.7");
}

TEST_CASE("points: what does not fit is refused, and says what would")
{
    point_form limited = form(value_type::int16);
    limited.limits = {10, 20, outside_limits::uncertain};
    const struct {
        point_form f;
        point_value value;
        point_fault why;
        const char* text;
    } rows[] = {
        {form(value_type::uint16), integer_value(-1), point_fault::out_of_range,
         "-1 does not fit the registers, which hold 0 to 65535"},
        {form(value_type::int16), integer_value(32768), point_fault::out_of_range,
         "32768 does not fit the registers, which hold -32768 to 32767"},
        {form(value_type::int16), real_value(32767.5), point_fault::out_of_range,
         "32767.5 does not fit the registers, which hold -32768 to 32767"},
        {form(value_type::bcd16), integer_value(10000), point_fault::out_of_range,
         "10000 does not fit the registers, which hold 0 to 9999"},
        {form(value_type::float32), real_value(1e39), point_fault::out_of_range,
         "1e+39 does not fit the registers of a float"},
        {form(value_type::uint64), real_value(18446744073709551616.0), point_fault::out_of_range,
         "1.84467441e+19 does not fit the registers, which hold 0 to 18446744073709551615"},
        {form(value_type::float64), real_value(std::nan("")), point_fault::out_of_range,
         "NaN and infinities are no values"},
        {form(value_type::boolean), integer_value(2), point_fault::out_of_range, "2 is neither 0 nor 1"},
        {form(value_type::int16), text_value("12"), point_fault::wrong_kind,
         "is a number: give a value of kind boolean, integer or real"},
        {limited, integer_value(21), point_fault::outside, "21 is outside the limits, 10 to 20"},
    };
    for (const auto& row : rows) {
        const auto words = encode(row.f, row.value);
        REQUIRE(words.has_error());
        CHECK(words.error().why == row.why);
        CHECK(words.error().text == row.text);
    }
    limited.limits.outside = outside_limits::clamp;
    CHECK(*encode(limited, integer_value(21)) == regs{20});
    CHECK(*encode(limited, integer_value(-5)) == regs{10});
}

TEST_CASE("points: what is written lies inside the limits when it is read back")
{
    const struct {
        double scale;
        double least;
        double most;
        outside_limits outside;
        double written;
        std::uint16_t expected;
    } rows[] = {
        {1, -10.5, 10.5, outside_limits::clamp, 20, 10},
        {1, -10.5, 10.5, outside_limits::clamp, -20, static_cast<std::uint16_t>(-10)},
        {1, 0.5, 9, outside_limits::clamp, -3, 1},
        {1, -9, -0.5, outside_limits::clamp, 3, static_cast<std::uint16_t>(-1)},
        {1, 0, 10.5, outside_limits::reject, 10.5, 10},  // inside, but the nearest number is not
        {0.1, 0, 2.56, outside_limits::clamp, 9, 25},
        {-0.1, -2.56, 2.56, outside_limits::clamp, 9, static_cast<std::uint16_t>(-25)},
        {-0.1, -2.56, 2.56, outside_limits::clamp, -9, 25},
        {0.1, 0, 0.3, outside_limits::clamp, 0.3, 3},  // 3 x 0.1 is more than 0.3, by 6E-17
        {1, 0, 10, outside_limits::clamp, 20, 10},
    };
    for (const auto& row : rows) {
        CAPTURE(row.scale);
        CAPTURE(row.written);
        point_form f = form(value_type::int16);
        f.scale = row.scale;
        f.limits = {row.least, row.most, row.outside};
        const auto words = encode(f, real_value(row.written));
        REQUIRE(words.has_value());
        CHECK(*words == regs{row.expected});
    }
    point_form narrow = form(value_type::int16);
    narrow.limits = {10.2, 10.8, outside_limits::clamp};
    const auto words = encode(narrow, integer_value(10));
    REQUIRE_FALSE(words.has_value());
    CHECK(words.error().why == point_fault::outside);
    CHECK(words.error().text == "no number that the registers can hold is inside the limits, 10.2 to 10.8");
}

TEST_CASE("points: text in either order")
{
    point_form f = form(value_type::text);
    f.characters = 5;
    CHECK(*encode(f, text_value("ABC")) == regs{0x4142, 0x4300, 0});
    CHECK(decode(f, regs{0x4142, 0x4300, 0x4400})->text == "ABC");  // to the first zero
    CHECK(decode(f, regs{0x4142, 0x4344, 0x4546})->text == "ABCDE");
    f.order = byte_order::badc;
    CHECK(*encode(f, text_value("ABCDE")) == regs{0x4241, 0x4443, 0x0045});
    CHECK(decode(f, regs{0x4241, 0x4443, 0x0045})->text == "ABCDE");
    CHECK(encode(f, text_value("ABCDEF")).error().text == "the text has 6 bytes, there is room for 5");
    CHECK(encode(f, integer_value(1)).error().why == point_fault::wrong_kind);
}

TEST_CASE("points: every whole number of 16 bits comes back, in every order")
{
    for (const byte_order order : all_orders)
        for (const value_type type : {value_type::int16, value_type::uint16})
            for (unsigned n = 0; n < 0x10000; n += 7) {
                const regs words{static_cast<std::uint16_t>(n)};
                const auto value = decode(form(type, order), words);
                REQUIRE(value.has_value());
                REQUIRE(*encode(form(type, order), *value) == words);
            }
}

TEST_CASE("points: random registers of long types come back bit for bit, unless they hold no value")
{
    std::mt19937_64 random(1);  // NOLINT: the same each time
    std::size_t none = 0;
    for (int i = 0; i < 20'000; ++i)
        for (const value_type type : {value_type::int32, value_type::uint32, value_type::int64, value_type::uint64,
                                      value_type::float32, value_type::float64, value_type::bcd32}) {
            const byte_order order = all_orders[i % 4];
            regs words(registers_of(type, 0));
            for (auto& each : words)
                each = static_cast<std::uint16_t>(random());
            const auto f = form(type, order);
            const auto value = decode(f, words);
            if (!value) {
                ++none;
                continue;
            }
            if (type == value_type::uint64 && value->kind == point_kind::real)
                continue;  // above 2^63 a double does not hold all digits
            const auto back = encode(f, *value);
            REQUIRE(back.has_value());
            REQUIRE(*back == words);
        }
    CHECK(none > 0);
}

TEST_SUITE_END();
