// PLC link (MEWNET-W0): which words of link relays and link registers each station sends, and the rules for that. FP7
// manual 6.2.3 and 6.3. How long a round takes is in plc_link_time.hpp.
#pragma once

#include "bridge/plc/device.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace plcgw {

// Of one PLC. All words are counted from the beginning of the block.
struct plc_link_settings {
    unsigned block = 0;             // 0: WL0-WL63 and LD0-LD127, 1: WL64-WL127 and LD128-LD255
    unsigned max_station = 16;      // 0 to 16; 0 and 1 count as 16 (10.3.2)
    unsigned relay_words = 64;      // used for the link, 0 to 64; the others are ordinary relays
    unsigned register_words = 128;  // likewise, 0 to 128
    unsigned relay_first = 0;       // sent: first word, 0 to 63
    unsigned relay_count = 0;       // words, 0 to 64
    unsigned register_first = 0;    // 0 to 127
    unsigned register_count = 0;    // 0 to 127
    bool operator==(const plc_link_settings&) const = default;
};

struct plc_link_station {
    unsigned station = 1;  // 1 to 16
    plc_link_settings settings;
};

inline constexpr unsigned most_link_stations = 16;
inline constexpr unsigned link_block_relay_words = 64;
inline constexpr unsigned link_block_registers = 128;

constexpr unsigned effective_max_station(const plc_link_settings& s)
{
    return s.max_station < 2 ? most_link_stations : s.max_station;
}

// The devices of a PLC behind a word of its block.
constexpr plc::device link_relay_word(const plc_link_settings& s, unsigned word)
{
    return {plc::device_kind::wl, s.block * link_block_relay_words + word};
}
constexpr plc::device link_register(const plc_link_settings& s, unsigned word)
{
    return {plc::device_kind::ld, s.block * link_block_registers + word};
}

struct plc_link_mistake {
    std::size_t index;         // in the list of stations
    std::string_view setting;  // "station", "block", "max_station", "relay_words", ...
    std::string text;          // "is 17, but ...": continues a sentence that begins with the setting
};

// All stations that are known, one is enough: each alone, then against those before it. Nothing when the link can run.
std::vector<plc_link_mistake> check_plc_link(std::span<const plc_link_station> stations);

// Station numbers up to the highest allowed one that nobody has: each makes the round longer (6.3.2, 6.4.2).
std::vector<unsigned> absent_link_stations(std::span<const plc_link_station> stations);

}  // namespace plcgw
