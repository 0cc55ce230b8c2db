#include "daemon/points.hpp"

#include <boost/asio/post.hpp>

#include <limits>

namespace plcgw {
namespace {

double deadband_of(const point_config& from)
{
    if (from.deadband_percent == 0)
        return from.deadband;
    return from.deadband_percent / 100 * (*from.most - *from.least);
}

}  // namespace

void published_points::add_sources(const client_line& line)
{
    for (std::size_t i = 0; i < line.rows(); ++i) {
        const route& r = line.route_at(i);
        if (!reads(r.way))
            continue;
        const auto state = [&line, i] { return source_state{line.route_at(i).state, line.route_at(i).source}; };
        table_.sources().add(r.name, {r.plc, r.at, bits_of(r)}, state);
    }
}

void published_points::add_sources(const messages::line_messages& line)
{
    for (const plc_block& each : line.filled()) {
        const device_span filled{each.plc, each.at, bits_of(each)};
        const auto state = [&line, filled] {
            sample of;
            of.state = quality::good;
            of.source = wall_time{std::numeric_limits<std::int64_t>::max()};
            line.worsen(of, *filled.plc, filled.at, filled.bits);
            return source_state{of.state, of.source};
        };
        table_.sources().add(each.name, filled, state);
    }
}

void published_points::add_sources(const plc_copies& copies)
{
    for (const plc_copy& each : copies.all())
        table_.sources().add_copy({each.from, each.first, each.bits}, {each.to, each.at, each.bits});
}

void published_points::add(const point_config& from, plc::simulated_plc& plc)
{
    point p;
    p.name = from.name;
    p.plc = &plc;
    p.at = *plc.memory().find(*plc::parse_device(from.device, plc.model().names));
    p.at.bit += from.bit.value_or(0);
    p.form = {from.type, from.order, from.characters, from.scale, from.offset, {from.least, from.most, from.outside}};
    p.unit = from.unit;
    p.deadband = deadband_of(from);
    p.longest_silence = from.longest_silence;
    p.writable = from.writable;
    table_.add(std::move(p));
}

void published_points::start() { table_.start(now(), wall_now()); }

void published_points::memory_changed(const plc::simulated_plc& plc, const plc::change& changed)
{
    table_.memory_changed(plc, changed, wall_now());
}

void published_points::say(const std::vector<sample>& samples)
{
    for (const sample& each : samples)
        table_.source_changed(each.route);
}

void published_points::say_everything() { table_.say_everything(); }

void published_points::keep_silences() { table_.keep_silences(now()); }

void published_points::publish()
{
    for (const point_sample& each : table_.take_samples(now()))
        dds_.publish(each);
    if (!table_.has_more() || std::exchange(posted_, true))
        return;
    boost::asio::post(loop_, [this] {
        posted_ = false;
        publish();
    });
}

}  // namespace plcgw
