// What every framer of a line has: bytes and the time go in, frames come out.
#pragma once

#include "protocols/bytes.hpp"
#include "protocols/errc.hpp"
#include "protocols/time.hpp"

#include <concepts>
#include <optional>

namespace plcgw {

// next(): nothing yet, a frame, or why bytes were dropped. A frame_type that says so itself (modbus::bus_event) comes
// without result<>. Ask until there is nothing; ask again at deadline() if no byte came until then.
//
// Silence is what next() sees, not what feed() sees: bytes that waited in the driver while this process stood still are
// fed late, but they came in time.
template <class F>
concept framer = requires(F f, const F& seen, time_point now, bytes received)
{
    typename F::frame_type;
    f.feed(now, received);
    requires std::same_as<decltype(f.next(now)), std::optional<result<typename F::frame_type>>> ||
        std::same_as<decltype(f.next(now)), std::optional<typename F::frame_type>>;
    {
        seen.deadline()
        } -> std::same_as<time_point>;  // time_point::max() while nothing is due
};

}  // namespace plcgw
