// A pty whose both sides are ours: raw, and the one that we listen to does not block.
#pragma once

#include "tests/field/posix.hpp"

namespace plcgw::bench {

struct pty_pair {
    field::unique_fd ours;    // where the wire is
    field::unique_fd theirs;  // a serial port; kept open, so that a client's closing is no event
    std::string device;       // for a client to open

    pty_pair();
};

}  // namespace plcgw::bench
