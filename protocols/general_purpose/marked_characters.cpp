#include "protocols/general_purpose/marked_characters.hpp"

namespace plcgw::general_purpose {
namespace {

constexpr std::uint8_t mark = 0xFF;

void append(std::vector<marked_characters::piece>& to, std::uint8_t byte)
{
    if (to.empty() || !std::holds_alternative<buffer>(to.back()))
        to.emplace_back(buffer{});
    std::get<buffer>(to.back()).push_back(byte);
}

}  // namespace

std::vector<marked_characters::piece> marked_characters::feed(bytes received)
{
    std::vector<piece> pieces;
    for (const std::uint8_t byte : received) {
        switch (state_) {
        case state::plain:
            if (byte == mark)
                state_ = state::escaped;
            else
                append(pieces, byte);
            break;
        case state::escaped:
            state_ = byte == 0 ? state::damaged : state::plain;
            if (byte != 0)
                append(pieces, byte);  // FF; anything else is no mark, and nothing is lost
            break;
        case state::damaged:
            pieces.emplace_back(damaged_);
            state_ = state::plain;
            break;
        }
    }
    return pieces;
}

}  // namespace plcgw::general_purpose
