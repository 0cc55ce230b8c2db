// Characters that came damaged or not at all, as a serial driver counts them.
#pragma once

#include <cstdint>

namespace plcgw {

struct bit_errors {
    std::uint64_t overrun = 0;
    std::uint64_t framing = 0;  // no stop bit
    std::uint64_t parity = 0;

    std::uint64_t sum() const { return overrun + framing + parity; }
    bit_errors operator-(const bit_errors& before) const
    {
        return {overrun - before.overrun, framing - before.framing, parity - before.parity};
    }
};

}  // namespace plcgw
