#include "tests/field/mewtocol_frame.hpp"

#include <utility>

namespace plcgw::field {

namespace {
constexpr double patience_s = 1;
}

std::string block_check(std::string_view text)
{
    unsigned char sum = 0;
    for (const char c : text)
        sum ^= static_cast<unsigned char>(c);
    constexpr std::string_view digits = "0123456789ABCDEF";
    return {digits[sum >> 4], digits[sum & 0xF]};
}

std::optional<heard_frame> frame_collector::take(char character, double seconds)
{
    if (!now_.text.empty() && seconds - began_ > patience_s)
        now_ = {};
    if (is_header(character)) {
        now_ = {.text = {character}, .too_long = false};
        began_ = seconds;
    }
    else if (now_.text.empty()) {
    }
    else if (character == '\r') {
        return std::exchange(now_, {});
    }
    else if (now_.text.size() + 1 < longest_frame(now_.text.front())) {
        now_.text += character;
    }
    else {
        now_.too_long = true;
    }
    return std::nullopt;
}

}  // namespace plcgw::field
