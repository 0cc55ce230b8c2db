#include "daemon/config/checks/checks.hpp"
#include "daemon/pair_lines.hpp"

namespace plcgw::config {

void check_standby(check_context& c)
{
    const gateway_config& all = c.config;
    const standby_config& s = all.standby;
    if (!s.is_configured() || !c.is_sound("/standby") || !c.is_sound("/dds"))
        return;
    if (!all.dds.settings.enabled)
        c.complain("/standby",
                   "needs DDS, by which two members know of each other: set \"enabled\" of \"dds\" to true");
    if (all.dds.member.empty() && all.dds.settings.interface == "lo")
        c.complain("/standby", "has both members on this host, and both would be called by the host's name: give each "
                               "its own \"member\" in \"dds\"");
    if (s.line_silence < 2 * s.lease)
        c.complain("/standby/line_silence_ms", "is " + std::to_string(s.line_silence.count()) +
                                                   ", expected at least twice the lease_ms of " +
                                                   std::to_string(s.lease.count()));
    if (s.listen < 2 * s.lease)
        c.complain("/standby/listen_ms", "is " + std::to_string(s.listen.count()) +
                                             ", expected at least twice the lease_ms of " +
                                             std::to_string(s.lease.count()));
    for (std::size_t i = 0; i < all.lines.size(); ++i) {
        const line_config& line = all.lines[i];
        const auto period = shortest_period(all, line);
        if (!is_heard_line(line) || !period || *period <= s.line_silence)
            continue;
        c.complain(
            item("lines", i),
            "is read every " + std::to_string(period->count()) +
                " ms at most, so that a member of the pair cannot tell by its silence for line_silence_ms whether "
                "the other one still works: read something more often, or raise line_silence_ms",
            mistake::weight::warning);
    }
}

}  // namespace plcgw::config
