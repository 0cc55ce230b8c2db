// A line of a standby whose stations it cannot hear: what the active member says about its routes.
#include "bridge/routes/client_line.hpp"
#include "bridge/standby/pair_mirror.hpp"

#include <algorithm>

namespace plcgw {

void client_line::adopt(std::size_t number, const route_record& record, time_point now, wall_time wall)
{
    plan();
    row& of = routes_[number];
    route& r = of.content;
    if (record.words.size() != r.words.size())
        return;  // configured differently there
    if (writes(r.way) && record.answers > 0)
        heard_write(of, record.words, now, record.source);
    const auto age =
        std::chrono::nanoseconds(static_cast<std::int64_t>(wall) - static_cast<std::int64_t>(record.source));
    of.good_at = now - std::max(duration{}, std::chrono::duration_cast<duration>(age));
    of.changed = of.changed || r.state != record.state || r.words != record.words;
    r.words = record.words;
    r.state = record.state;
    r.source = record.source;
    r.reason = record.reason;
    r.reason_code = record.reason_code;
    r.answers = record.answers;
    r.errors = record.errors;
    if (reads(r.way) && of.partner)
        of.agreed = record.words;
}

// What came here as somebody else's write may have reached the station since.
void client_line::forget_written()
{
    plan();
    for (row& each : routes_) {
        if (!writes(each.content.way) || each.content.way == direction::periodic_write || !is_write_due(each))
            continue;
        const std::vector<std::uint16_t>& there = each.half ? reading_row(each).agreed : each.content.words;
        const bool is_known = each.half ? reading_row(each).content.answers > 0 : each.content.answers > 0;
        if (is_known && words_in_memory(each.content) == there)
            schedule_.forget(write_item(each));
    }
}

}  // namespace plcgw
