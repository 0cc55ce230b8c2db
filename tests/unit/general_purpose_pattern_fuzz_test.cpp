// Patterns that nobody would write and messages that nobody would send: nothing is read beside the message, places are
// right, and what a pattern was made for it takes.
#include "bridge/messages/pattern.hpp"
#include "tests/support/print.hpp"

#include <doctest/doctest.h>

#include <random>

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::messages;

namespace {

bytes as_bytes(std::string_view text) { return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}; }

std::mt19937 dice{20'240'501};

std::size_t below(std::size_t n) { return dice() % n; }
bool heads() { return below(2) == 0; }

std::string_view one_of(std::span<const std::string_view> all) { return all[below(all.size())]; }

std::string digits(std::size_t count)
{
    std::string made;
    while (made.size() < count)
        made.push_back(static_cast<char>('0' + below(10)));
    return made;
}

// A pattern, piece by piece, with a message for it and what its fields take.
struct matching {
    std::string pattern;
    std::string message;
    std::vector<std::string> taken;

    void add_literal()
    {
        constexpr std::string_view all[] = {"kg", ",GS,", ";", "<STX>", "\\{", "::", "N"};
        constexpr std::string_view sent[] = {"kg", ",GS,", ";", "\x02", "{", "::", "N"};
        const std::size_t which = below(std::size(all));
        pattern += all[which];
        message += sent[which];
    }
    void add_field()
    {
        pattern += "{f" + std::to_string(taken.size());
        std::string text;
        switch (below(5)) {
        case 0:
            pattern += ":number}";
            text = std::string(below(3), ' ') + (heads() ? "-" : "") + digits(1 + below(4));
            text += heads() ? "." + digits(below(3)) : "";
            break;
        case 1: {
            const std::size_t whole = 1 + below(5);
            const std::size_t after = below(4);
            pattern += ":+" + std::string(whole, '#') + (after == 0 ? "" : "." + std::string(after, '0')) + "}";
            const std::size_t blanks = below(whole);
            text = (heads() ? "+" : "-") + std::string(blanks, ' ') + digits(whole - blanks);
            text += after == 0 ? "" : "." + digits(after);
            break;
        }
        case 2: {
            const std::size_t count = 1 + below(6);
            pattern += ":hex(" + std::to_string(count) + ")}";
            text = digits(count);
            break;
        }
        case 3: {
            const std::size_t count = 1 + below(6);
            pattern += ":text(" + std::to_string(count) + ")}";
            text = std::string(count, heads() ? 'x' : '{');
            break;
        }
        default: pattern += "}"; text = std::string(below(5), 'x');
        }
        message += text;
        taken.push_back(std::move(text));
    }
};

void check_outcome(const pattern& p, std::string_view written, std::string_view message)
{
    const auto captures = p.match(as_bytes(message));
    if (!captures) {
        CHECK(captures.error().byte >= 1);
        CHECK(captures.error().byte <= message.size() + 1);
        CHECK(captures.error().position <= written.size());
        CHECK(!to_string(captures.error()).empty());
        return;
    }
    REQUIRE(captures->size() == p.names().size());
    for (const capture& each : *captures)
        if (!each.text.empty()) {
            CHECK(each.text.data() >= message.data());
            CHECK(each.text.data() + each.text.size() <= message.data() + message.size());
        }
}

}  // namespace

TEST_CASE("patterns: whatever is written, it is a pattern or has a mistake with its place")
{
    constexpr std::string_view pieces[] = {
        "{",          "}",          ":",   "a",         "_",          "number",      "(,)",
        "scientific", "hex",        "(4)", "text",      "(0)",        "spaces",      "(99999999999999999999)",
        "+",          "-",          "#",   "0",         ".",          ",",           "\\",
        "<STX>",      "<",          ">",   "\\x05",     "\\x",        " ",           "\xFF",
        "kg",         "{b:number}", "{c}", "{d:###.#}", "{_:spaces}", "{e:text(3)}", "{g:hex(16)}"};
    constexpr std::string_view sent[] = {" ",  "0",    "12",   "+", "-", ".", ",", "E",
                                         "kg", "\x02", "\x05", "A", "x", "{", "}"};
    unsigned good = 0;
    for (int n = 0; n < 20'000; ++n) {
        std::string written;
        for (std::size_t i = below(12); i > 0; --i)
            written += one_of(pieces);
        CAPTURE(written);
        const auto made = pattern::parse(written);
        if (!made) {
            CHECK(made.error().position >= 1);
            CHECK(made.error().position <= written.size() + 1);
            CHECK(!made.error().text.empty());
            continue;
        }
        ++good;
        for (int k = 0; k < 3; ++k) {
            std::string message;
            for (std::size_t i = below(10); i > 0; --i)
                message += one_of(sent);
            CAPTURE(message);
            check_outcome(*made, written, message);
        }
    }
    CHECK(good > 500);
}

TEST_CASE("patterns: a message that was made for a pattern is taken as it was made, and no cut of it is read beside it")
{
    unsigned good = 0;
    for (int n = 0; n < 20'000; ++n) {
        matching m;
        for (std::size_t i = 1 + below(6); i > 0; --i)
            heads() ? m.add_literal() : m.add_field();
        CAPTURE(m.pattern);
        CAPTURE(m.message);
        const auto made = pattern::parse(m.pattern);
        if (!made)
            continue;  // two fields of which nobody can tell the end
        check_outcome(*made, m.pattern, m.message.substr(0, below(m.message.size() + 1)));
        const auto captures = made->match(as_bytes(m.message));
        if (!captures)
            continue;
        ++good;
        std::string again;
        REQUIRE(captures->size() == m.taken.size());
        for (std::size_t i = 0; i < m.taken.size(); ++i)
            CHECK((*captures)[i].text == m.taken[i]);
    }
    CHECK(good > 5'000);
}

TEST_SUITE_END();
