// How long one round of a PLC link (MEWNET-W0) takes at most between real FP PLCs: FP7 manual 6.4. The names of the
// parts are the manual's. Our own link is carried by DDS and does not wait for a round.
#pragma once

#include "protocols/time.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace plcgw {

// What one station that takes part sends, and how long its program runs.
struct link_load {
    unsigned relay_words = 0;
    unsigned register_words = 0;
    duration scan{};
};

inline constexpr unsigned plc_link_baud = 115200;  // fixed (6.2.3)
inline constexpr duration default_join_wait{400'000};

struct plc_link_time_input {
    std::span<const link_load> stations;  // those that take part
    duration master_scan{};               // of station 1
    bool somebody_absent = false;         // a station up to the highest number is off or does not exist (6.4.2)
    unsigned baud_rate = plc_link_baud;
    duration join_wait = default_join_wait;
};

struct plc_link_time {
    std::vector<duration> ts;  // each station: scan + Tpc
    duration tlt{};            // link table
    duration tso{};            // scan of the master station
    duration tlk{};            // 0 when nobody is absent
    duration total() const;
    bool operator==(const plc_link_time&) const = default;
};

// Ttx: 11 bits of a character, up to whole microseconds. At 115200 bit/s the manual calculates with 0.096 ms, as this
// does.
constexpr duration link_byte_time(unsigned baud_rate)
{
    constexpr std::int64_t bits = 11;
    return duration{(bits * 1'000'000 + baud_rate - 1) / baud_rate};
}

constexpr unsigned link_bytes(const link_load& l)  // Pcm: a word is four ASCII characters
{
    return 23 + 4 * (l.relay_words + l.register_words);
}

constexpr duration link_send_time(const link_load& l, unsigned baud_rate = plc_link_baud)  // Tpc
{
    return link_byte_time(baud_rate) * link_bytes(l);
}

constexpr duration link_table_time(std::size_t stations, unsigned baud_rate = plc_link_baud)  // Tlt
{
    return link_byte_time(baud_rate) * static_cast<std::int64_t>(13 + 2 * stations);
}

// Tlk = Tlc (10 bytes) + Twt + Tls (7 bytes) + Tso.
constexpr duration link_join_time(duration master_scan, duration join_wait = default_join_wait,
                                  unsigned baud_rate = plc_link_baud)
{
    return 10 * link_byte_time(baud_rate) + join_wait + 7 * link_byte_time(baud_rate) + master_scan;
}

plc_link_time round_time(const plc_link_time_input& in);

}  // namespace plcgw
