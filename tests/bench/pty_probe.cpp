#include "tests/bench/pty_probe.hpp"

#include <array>
#include <unistd.h>

namespace plcgw::bench {
namespace {

constexpr nanoseconds period = 10'000'000;

}

void pty_probe::send(nanoseconds now)
{
    if (now < next_)
        return;
    sent_ = now;
    next_ = INT64_MAX;  // when it is through
    [[maybe_unused]] const auto written = ::write(pty_.ours.get(), "x", 1);
}

nanoseconds pty_probe::received(nanoseconds now)
{
    std::array<char, 16> room{};
    [[maybe_unused]] const auto size = ::read(fd(), room.data(), room.size());
    next_ = now + period;
    return now - sent_;
}

}  // namespace plcgw::bench
