// How long a byte takes through a pty of this machine. The kernel carries it by a worker of ordinary priority: where
// that waits for a processor, every program on an emulated wire looks slow.
#pragma once

#include "tests/bench/pty.hpp"
#include "tests/bench/wire_format.hpp"

namespace plcgw::bench {

class pty_probe {
public:
    int fd() const { return pty_.theirs.get(); }
    nanoseconds deadline() const { return next_; }
    void send(nanoseconds now);             // if the deadline has come
    nanoseconds received(nanoseconds now);  // when fd() is readable: how long it took

private:
    pty_pair pty_;
    nanoseconds sent_ = 0;
    nanoseconds next_ = 0;
};

}  // namespace plcgw::bench
