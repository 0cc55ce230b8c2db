// What a message looks like, and which parts of it are numbers and text:
//
//     ST,GS,{weight:+#####.#}kg            matches ST,GS,+00123.4kg
//     {state:text(2)},{_:text(2)},{weight:number}{_:spaces}{unit}
//
// Text stands for itself, in the notation of notation.hpp; in braces a field has a name and a form:
//
//     {name:number}      sign if there is one, digits, perhaps a point and digits; spaces before the sign and the
//     digits {name:number(,)}   the same with a decimal comma {name:scientific}  a number, perhaps with an
//     exponent: 1.25E-03 {name:+###.##}     a picture: as many characters as it has. First + is a sign that must be
//     there, - a sign or a
//                        space, neither means no sign. Then # is a digit, or a space while no digit came, and 0 a
//                        digit. Behind the point (or comma) stand digits.
//     {name:hex(4)}      so many hexadecimal digits
//     {name:text(5)}     so many characters, whatever they are
//     {name:text}        what comes before the text that follows in the pattern, or all the rest; {name} is the same
//     {name:spaces}      spaces, or none
//
// The name _ is for what nobody wants. The whole message must match. A field takes all that it can take and gives
// nothing back, so the time grows with the length of the message, and what a pattern takes can be read off it.
#pragma once

#include "bridge/messages/decimal.hpp"
#include "bridge/messages/notation.hpp"

#include <vector>

namespace plcgw::messages {

inline constexpr std::size_t max_pattern_size = 1024;  // characters

enum class form : std::uint8_t { literal, picture, number, scientific, hex, text, rest_of_text, spaces };

struct element {
    enum class sign : std::uint8_t { none, required, optional };

    form kind{};
    std::size_t position{};         // in the pattern, 1 = first character
    std::string text;               // of a literal: its bytes; else as it stands in the pattern
    std::optional<std::size_t> at;  // in pattern::names(); literals and _ have none
    char point = '.';
    // Of a picture: the characters before the point and behind it. Of hex and text: their number is `before`.
    sign signs{};
    std::string before;
    std::size_t after = 0;
    std::size_t count = 0;
};

constexpr bool is_number(form f)
{
    return f == form::picture || f == form::number || f == form::scientific || f == form::hex;
}

// What a field took out of a message; it points into the message.
struct capture {
    std::string_view text;
    decimal number;  // of forms that are numbers
};

struct mismatch {
    std::size_t byte{};      // of the message, 1 = first; one behind the last: the message ended too early
    std::size_t position{};  // of the pattern, 1 = first character; 0: the message goes on behind its end
    std::string expected;
};

std::string to_string(const mismatch& why);

class pattern {
public:
    // Its first mistake, with its place.
    static parsed<pattern> parse(std::string_view text);

    // One capture for each of names(), in their order: the one allocation here.
    boost::system::result<std::vector<capture>, mismatch> match(bytes message) const;

    const std::vector<std::string>& names() const { return names_; }
    form form_of(std::size_t name) const;

private:
    friend class pattern_parser;

    std::vector<element> elements_;
    std::vector<std::string> names_;
};

}  // namespace plcgw::messages
