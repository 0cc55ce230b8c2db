// Random messages against what the standard library says about them.
#include "bridge/messages/message_reader.hpp"
#include "tests/support/messages.hpp"

#include <cstdlib>
#include <cstring>
#include <random>
#include <regex>

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::messages;
using namespace plcgw::test;

namespace {

class dice {
public:
    unsigned up_to(unsigned most) { return std::uniform_int_distribution<unsigned>(0, most)(random_); }

    std::string text(std::string_view alphabet, unsigned longest)
    {
        std::string text;
        for (unsigned n = up_to(longest); n > 0; --n)
            text.push_back(alphabet[up_to(static_cast<unsigned>(alphabet.size()) - 1)]);
        return text;
    }

    // With up to three characters replaced, inserted or taken away.
    std::string damaged(std::string text, std::string_view alphabet)
    {
        for (unsigned n = up_to(3); n > 0; --n) {
            const std::size_t at = up_to(static_cast<unsigned>(text.size()));
            text.replace(at, up_to(1), up_to(1), alphabet[up_to(static_cast<unsigned>(alphabet.size()) - 1)]);
        }
        return text;
    }

private:
    std::mt19937 random_{4};
};

pattern made(std::string_view text)
{
    auto made = pattern::parse(text);
    REQUIRE(made.has_value());
    return std::move(*made);
}

}  // namespace

TEST_CASE("pattern: matches what the regular expression of the same form matches")
{
    const struct {
        const char* pattern;
        const char* expression;
        const char* alphabet;
        const char* example;
    } rows[] = {
        {"{n:number}", " *[+-]? *([0-9]+\\.?[0-9]*|\\.[0-9]+)", " +-1.", " + 1.5"},
        {"{n:number(,)}", " *[+-]? *([0-9]+,?[0-9]*|,[0-9]+)", " -1,.", "-1,52"},
        {"{n:scientific}", " *[+-]? *([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?", "-1.eE", "-1.5E-3"},
        {"{n:+##.#}", "[+-](?=[ 0-9]{2}\\.) *[0-9]*\\.[0-9]", "+- 1..", "+ 1.5"},
        {"{n:-#0}", "[ +-][ 0-9][0-9]", " -+1", "- 1"},
        {"{n:###}", "(?=[ 0-9]{3}$) *[0-9]+", " 11", " 12"},
        {"{n:hex(2)}{_:spaces}k", "[0-9A-Fa-f]{2} *k", "aFg0 kk", "0F  k"},
        {"{a}kk{b}", "[^]*?kk[^]*", "kx", "xkkx"},
        {"{a},{b:text(1)}{_:spaces}", "[^,]*,[^] *", ",x ", "xx,x  "},
    };
    dice random;
    for (const auto& each : rows) {
        CAPTURE(each.pattern);
        const pattern p = made(each.pattern);
        const std::regex expression(each.expression);
        int matches = 0;
        for (int i = 0; i < 4000; ++i) {
            const std::string message = random.damaged(each.example, each.alphabet);
            CAPTURE(message);
            const bool expected = std::regex_match(message, expression);
            CHECK(p.match(raw(message)).has_value() == expected);
            matches += expected ? 1 : 0;
        }
        CHECK(matches > 40);  // else it says little
        CHECK(matches < 3960);
    }
}

TEST_CASE("fields: floats are what strtod and strtof read, whatever the decimals")
{
    message_reader reader({made("{n:scientific}")}, {{"n", value_type::float64, 0, 0, {}},
                                                     {"n", value_type::float32, 0, 0, {}},
                                                     {"n", value_type::float64, -3, 0, {}}});
    dice random;
    for (int i = 0; i < 5000; ++i) {
        std::string text =
            (random.up_to(1) == 0 ? "-" : "") + random.text("0123456789", 9) + "5." + random.text("0123456789", 9);
        const int exponent = static_cast<int>(random.up_to(40)) - 20;
        text += "e" + std::to_string(exponent);
        CAPTURE(text);
        REQUIRE(reader.read(raw(text)));
        const std::string thousandth = text.substr(0, text.find('e')) + "e" + std::to_string(exponent - 3);

        const auto bits = [&](std::size_t index) {
            std::uint64_t all = 0;
            const const_words words = reader.words_of(index);
            for (std::size_t word = 0; word < words.size(); ++word)
                all |= std::uint64_t{words[word]} << (16 * word);
            return all;
        };
        CHECK(bits(0) == std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)));
        CHECK(bits(1) == std::bit_cast<std::uint32_t>(std::strtof(text.c_str(), nullptr)));
        CHECK(bits(2) == std::bit_cast<std::uint64_t>(std::strtod(thousandth.c_str(), nullptr)));
    }
}

TEST_CASE("pattern: any text is a pattern or a mistake with a place inside or just behind it")
{
    dice random;
    int good = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::string text;
        for (unsigned n = random.up_to(4); n > 0; --n) {
            constexpr std::string_view parts[] = {"{a:number}", "{b}", "{_:text(2)}", "{c:+##.#}", "{",
                                                  "}",          "\\",  ",",           "<CR>",      "<A>",
                                                  "\\x41",      "{_:", ":",           "1",         "{b:hex(3)}"};
            text += parts[random.up_to(std::size(parts) - 1)];
        }
        CAPTURE(text);
        const auto made = pattern::parse(text);
        if (!made) {
            CHECK(made.error().position >= 1);
            CHECK(made.error().position <= text.size() + 1);
            continue;
        }
        ++good;
        for (int j = 0; j < 3; ++j) {
            const buffer message = raw(random.text("12+. ,A\r", 12));
            const auto captures = made->match(message);
            CHECK((captures.has_value() || captures.error().byte <= message.size() + 1));
        }
    }
    CHECK(good > 1000);
}

TEST_SUITE_END();
