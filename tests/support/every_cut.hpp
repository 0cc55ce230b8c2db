// Received bytes come in any pieces: feeds a byte string whole, in two pieces cut at every place, and byte by byte.
#pragma once

#include "protocols/bytes.hpp"

namespace plcgw::test {

using pieces = std::vector<bytes>;

// Calls receive(pieces) once for each way to cut. The receiver makes a fresh framer each time.
template <class Receive>
void every_cut(bytes whole, Receive receive)
{
    receive(pieces{whole});
    for (std::size_t cut = 1; cut < whole.size(); ++cut)
        receive(pieces{whole.first(cut), whole.subspan(cut)});

    pieces single;
    for (std::size_t i = 0; i < whole.size(); ++i)
        single.push_back(whole.subspan(i, 1));
    receive(single);
}

}  // namespace plcgw::test
