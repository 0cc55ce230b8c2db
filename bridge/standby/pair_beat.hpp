// What one member of a pair says to the other several times a lease.
#pragma once

#include "protocols/time.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plcgw {

enum class pair_role : std::uint8_t {
    starting,  // listens, before it knows what it is
    standby,
    active,
};

enum class line_report : std::uint8_t {
    unknown,  // nothing is asked regularly, or others cannot be heard
    closed,   // the port is absent
    mute,     // no byte came for the line's limit
    good,
};

struct pair_line_report {
    std::string line;
    line_report state{};
    bool speaks = false;
    std::optional<duration> asked{};  // so long ago; nothing: it never did
    bool operator==(const pair_line_report&) const = default;
};

struct pair_beat {
    std::string member;
    pair_role role{};
    std::uint64_t term{};  // grows with each change of the active member
    unsigned priority{};
    bool claims = false;  // wants to be active in this term
    bool offers = false;  // active, and wants the other one to be it
    bool leaves = false;  // ends now
    bool keeps = false;   // active by command: not to be handed back
    std::vector<pair_line_report> lines;
    bool operator==(const pair_beat&) const = default;
};

constexpr std::string_view to_string(pair_role role)
{
    switch (role) {
    case pair_role::starting: return "starting";
    case pair_role::standby: return "standby";
    case pair_role::active: return "active";
    }
    return "unknown";
}

constexpr std::string_view to_string(line_report state)
{
    switch (state) {
    case line_report::unknown: return "not heard";
    case line_report::closed: return "port absent";
    case line_report::mute: return "silent";
    case line_report::good: return "good";
    }
    return "unknown";
}

}  // namespace plcgw
