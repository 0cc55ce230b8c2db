#include "daemon/pair_lines.hpp"

#include <algorithm>

namespace plcgw {

bool is_heard_line(const line_config& line)
{
    return !line.device.empty() && line.role == line_role::client && line.protocol != line_protocol::general_purpose;
}

std::optional<milliseconds> shortest_period(const gateway_config& all, const line_config& line)
{
    std::optional<milliseconds> shortest;
    for (const route_config& each : all.routes) {
        const auto station = std::find_if(all.stations.begin(), all.stations.end(),
                                          [&](const station_config& s) { return s.name == each.station; });
        const bool is_here = station != all.stations.end() && station->line == line.name;
        if (is_here && (reads(each.way) || each.way == direction::periodic_write))
            shortest = std::min(shortest.value_or(each.period), each.period);
    }
    return shortest;
}

// Whoever asks there is silent at most for a period, or for as long as a station may take to answer. Twice of that:
// also one that is careful, because nothing answers, is heard in it.
pair_line_settings pair_line_of(const gateway_config& all, const line_config& line)
{
    constexpr milliseconds exchange{100};
    milliseconds longest = line.response_timeout;
    for (const station_config& each : all.stations)
        if (each.line == line.name)
            longest = std::max(longest, each.response_timeout.value_or(line.response_timeout));
    const auto period = shortest_period(all, line);
    longest = std::max(longest, period.value_or(milliseconds{0})) + exchange;
    const milliseconds quiet = std::min<milliseconds>(2 * longest, all.standby.line_silence);
    return {line.name, quiet, std::max(all.standby.line_silence, quiet), period.has_value()};
}

}  // namespace plcgw
