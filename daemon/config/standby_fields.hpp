// How standby_config.hpp is written in JSON; see fields.hpp.
#pragma once

#include "daemon/config/rules.hpp"
#include "daemon/config/standby_config.hpp"

namespace plcgw::config {

template <class Visitor>
void describe(Visitor& v, standby_config& c)
{
    v.required("priority", c.priority, "Of two members that could both be active the higher one is; equal: the name",
               range{0, 100});
    v.optional("hand_back", c.hand_back, "This member gets its work back from one of lower priority, by agreement");
    v.optional("lease_ms", c.lease, "A member that was not heard for so long is gone, and knows it itself",
               range{100, 10'000});
    v.optional("line_silence_ms", c.line_silence,
               "A serial line that was silent for so long is taken although the other member lives",
               range{200, 60'000});
    v.optional("listen_ms", c.listen, "Time to listen after the start, before anything is sent", range{500, 60'000});
    v.optional("hand_back_after_ms", c.hand_back_after,
               "Time as standby before the work is taken back, in which its memory gets warm", range{500, 3'600'000});
}

}  // namespace plcgw::config
