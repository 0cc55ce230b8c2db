// Takes the marks out of what a serial driver delivers that marks damaged characters (termios: PARMRK): FF 00 xx stands
// for a character xx with a wrong parity or without its stop bit, FF FF for a character FF.
#pragma once

#include "protocols/bytes.hpp"
#include "protocols/errc.hpp"

#include <variant>
#include <vector>

namespace plcgw::general_purpose {

class marked_characters {
public:
    // damaged: what a mark means. The driver does not say which of both: bad_parity where there is a parity bit.
    explicit marked_characters(errc damaged) : damaged_(damaged) {}

    using piece = std::variant<buffer, errc>;  // characters, or one that was damaged

    // In their order. A mark that is cut short is completed by the next call.
    std::vector<piece> feed(bytes received);

private:
    enum class state : std::uint8_t { plain, escaped, damaged };

    errc damaged_;
    state state_ = state::plain;
};

}  // namespace plcgw::general_purpose
