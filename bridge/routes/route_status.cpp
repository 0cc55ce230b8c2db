#include "bridge/routes/route_status.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr std::int64_t second = 1'000'000'000;  // ns
constexpr std::uint16_t longest = 0xFFFF;

std::uint16_t age_of(wall_time source, wall_time now)
{
    if (source == wall_time::never)
        return longest;
    const std::int64_t age = (static_cast<std::int64_t>(now) - static_cast<std::int64_t>(source)) / second;
    return static_cast<std::uint16_t>(std::clamp<std::int64_t>(age, 0, longest));
}

void show_words(const status_place& where, std::span<const std::uint16_t> words)
{
    for (std::size_t i = 0; i < words.size(); ++i)
        where.plc->memory().put_word({where.at.area, where.at.bit + 16 * i}, words[i]);
}

}  // namespace

no_answer code_of(const boost::system::error_code& why)
{
    if (why == errc::timed_out)
        return no_answer::timed_out;
    if (why == errc::unexpected_answer)
        return no_answer::unexpected;
    if (why == errc::collision)
        return no_answer::collision;
    if (why == errc::line_not_quiet)
        return no_answer::busy_line;
    if (why == errc::port_absent)
        return no_answer::no_port;
    if (why == errc::not_expressible || why == errc::bad_count)
        return no_answer::not_asked;
    return no_answer::damaged;
}

std::array<std::uint16_t, route_status_words> status_of(const route& r, health of_station, byte_order order,
                                                        wall_time now)
{
    std::array<std::uint16_t, route_status_words> words{};
    words[0] = code_of(r.state);
    words[1] = r.reason_code;
    words[2] = age_of(r.source, now);
    put_bits(static_cast<std::uint64_t>(static_cast<std::int64_t>(r.source) / second), order,
             register_span(words).subspan(3, 2));
    words[5] = static_cast<std::uint16_t>(r.errors);
    words[6] = static_cast<std::uint16_t>(r.answers);
    words[7] = static_cast<std::uint16_t>(of_station);
    return words;
}

std::array<std::uint16_t, station_status_words> status_board::status_of_station(std::size_t station,
                                                                                wall_time now) const
{
    std::uint16_t total = 0;
    std::uint16_t up = 0;
    wall_time newest = wall_time::never;
    for (std::size_t i = 0; i < line_.rows(); ++i) {
        if (line_.station_at(i) != station || line_.is_half(i))
            continue;
        ++total;
        up = static_cast<std::uint16_t>(up + (line_.is_up(i) ? 1 : 0));
        newest = std::max(newest, line_.route_at(i).source);
    }
    return {static_cast<std::uint16_t>(line_.health_of(station)), total, up, age_of(newest, now)};
}

void status_board::show(wall_time now) const
{
    for (const row& each : routes_)
        show_words(each.where, status_of(line_.route_at(each.what), line_.health_of(line_.station_at(each.what)),
                                         each.where.order, now));
    for (const row& each : stations_)
        show_words(each.where, status_of_station(each.what, now));
}

}  // namespace plcgw
