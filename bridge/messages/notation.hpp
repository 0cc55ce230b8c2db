// How engineers write bytes that have no letter, in request templates and patterns, and how messages are shown to them:
// <STX>, <CR> and the other control codes by name, \x05 by number, \\ \{ \} \< for the characters themselves, \r \n \t.
#pragma once

#include "protocols/bytes.hpp"

#include <boost/system/result.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace plcgw::messages {

struct text_mistake {
    std::size_t position{};  // of the character in the text, 1 = first
    std::string text;
    bool operator==(const text_mistake&) const = default;
};

template <class T>
using parsed = boost::system::result<T, text_mistake>;

// Appends one character of the notation and moves `at` behind it. < is itself unless capital letters or digits and >
// follow.
std::optional<text_mistake> read_character(std::string_view text, std::size_t& at, buffer& to);

// A whole template. { and } are ordinary here.
parsed<buffer> parse_bytes(std::string_view text);

// The same notation back: parse_bytes(printable(b)) is b. Bytes beyond the longest are only counted: "... (4096
// bytes)".
std::string printable(bytes message);
std::string printable(bytes message, std::size_t longest);

}  // namespace plcgw::messages
