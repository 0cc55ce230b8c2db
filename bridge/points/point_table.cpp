#include "bridge/points/point_table.hpp"

#include <algorithm>
#include <cmath>

namespace plcgw {
namespace {

std::vector<std::uint16_t> registers_in_memory(const point& p)
{
    if (p.form.type == value_type::boolean)
        return {static_cast<std::uint16_t>(p.plc->memory().bit(p.at) ? 1 : 0)};
    std::vector<std::uint16_t> words(registers_of(p.form.type, p.form.characters));
    p.plc->memory().read(p.at, words);
    return words;
}

// What the kind does not carry follows from what it does: a client may have filled only that.
point_value whole_value(const point_value& given)
{
    switch (given.kind) {
    case point_kind::boolean: return boolean_value(given.integer != 0);
    case point_kind::integer: return integer_value(given.integer);
    case point_kind::real: return real_value(given.real);
    case point_kind::text: return text_value(given.text);
    case point_kind::none: break;
    }
    return {};
}

}  // namespace

std::size_t bits_of(const point& p)
{
    return p.form.type == value_type::boolean ? 1 : 16 * registers_of(p.form.type, p.form.characters);
}

void point_table::add(point p)
{
    const std::size_t index = points_.size();
    runs& of = areas_[{p.plc, p.at.area}];
    of.sorted.push_back({p.at.bit, p.at.bit + bits_of(p), index});
    of.longest = std::max(of.longest, bits_of(p));
    of.is_sorted = false;

    state& added = states_.emplace_back();
    added.fed_by = sources_.find({p.plc, p.at, bits_of(p)});
    of_source_.resize(sources_.size());
    for (const std::uint32_t each : added.fed_by)
        of_source_[each].push_back(index);
    silent_until_.push_back(time_point::max());
    points_.push_back(std::move(p));
}

std::optional<std::size_t> point_table::find(std::string_view name) const
{
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<point_refusal> point_table::write(std::string_view name, const point_value& value)
{
    const auto index = find(name);
    if (!index)
        return point_refusal{point_fault::unknown, "there is no point \"" + std::string(name) + "\""};
    const point& p = points_[*index];
    if (!p.writable)
        return point_refusal{point_fault::read_only,
                             "point \"" + p.name + "\" is only read: \"writable\" in the configuration allows writing"};
    const auto words = encode(p.form, whole_value(value));
    if (!words)
        return point_refusal{words.error().why, "point \"" + p.name + "\": " + words.error().text};
    plc::memory& memory = p.plc->memory();
    if (p.form.type == value_type::boolean)
        memory.set_bit(p.at, words->front() != 0);
    else
        for (std::size_t i = 0; i < words->size(); ++i)
            memory.set_word({p.at.area, p.at.bit + 16 * i}, (*words)[i]);
    return std::nullopt;
}

void point_table::start(time_point now, wall_time wall)
{
    for (std::size_t i = 0; i < points_.size(); ++i) {
        by_name_.emplace(points_[i].name, i);
        states_[i].changed = wall;
        // Spread, so that they are not all said in the same second for ever.
        const duration silence = points_[i].longest_silence;
        if (silence != duration{})
            silent_until_[i] = now + silence * static_cast<std::int64_t>(i + 1) / static_cast<std::int64_t>(size());
    }
    for (auto& [key, of] : areas_)
        std::sort(of.sorted.begin(), of.sorted.end(), [](const run& a, const run& b) { return a.first < b.first; });
    say_everything();
}

void point_table::wait_for_look(std::size_t index)
{
    if (!std::exchange(states_[index].waits, true))
        waiting_.push_back(index);
}

void point_table::memory_changed(const plc::simulated_plc& plc, const plc::change& changed, wall_time wall)
{
    const auto area = areas_.find({&plc, changed.area});
    if (area == areas_.end())
        return;
    const runs& of = area->second;
    const std::size_t begin = changed.first_bit - std::min(changed.first_bit, of.longest);
    auto each = std::lower_bound(of.sorted.begin(), of.sorted.end(), begin,
                                 [](const run& a, std::size_t bit) { return a.first < bit; });
    for (; each != of.sorted.end() && each->first < changed.first_bit + changed.count; ++each) {
        if (each->end <= changed.first_bit)
            continue;
        states_[each->point].changed = wall;
        wait_for_look(each->point);
    }
}

void point_table::source_changed(const std::string& source)
{
    for (const std::uint32_t which : sources_.named(source))
        if (which < of_source_.size())
            for (const std::size_t each : of_source_[which])
                wait_for_look(each);
}

void point_table::say_everything()
{
    for (std::size_t i = 0; i < points_.size(); ++i) {
        states_[i].forced = true;
        wait_for_look(i);
    }
}

void point_table::keep_silences(time_point now)
{
    for (std::size_t i = 0; i < silent_until_.size(); ++i)
        if (silent_until_[i] <= now) {
            states_[i].forced = true;
            wait_for_look(i);
        }
}

std::vector<point_sample> point_table::take_samples(time_point now, std::size_t most)
{
    std::vector<point_sample> samples;
    for (std::size_t looked = 0; looked < most && !waiting_.empty(); ++looked) {
        const std::size_t index = waiting_.front();
        waiting_.pop_front();
        const point& p = points_[index];
        state& s = states_[index];
        s.waits = false;
        point_sample made = look(index);
        if (!is_news(p, s, made))
            continue;
        s.forced = false;
        s.said = made.value;
        s.said_state = made.state;
        if (p.longest_silence != duration{} && !std::exchange(s.first, false))
            silent_until_[index] = now + p.longest_silence;  // of the first one start() chose it
        samples.push_back(std::move(made));
    }
    return samples;
}

point_sample point_table::look(std::size_t index)
{
    const point& p = points_[index];
    state& s = states_[index];
    const source_state of = sources_.of(s.fed_by);
    point_sample made{p.name, p.unit, {}, of.state, s.fed_by.empty() ? s.changed : of.source};
    if (of.state == quality::never_read)
        return made;
    const auto value = decode(p.form, registers_in_memory(p));
    if (!value) {
        made.state = of.state == quality::good ? quality::no_value : of.state;
        return made;
    }
    made.value = *value;
    if (is_inside(p.form.limits, *value)) {
        if (p.form.limits.outside == outside_limits::reject) {
            s.accepted = *value;
            s.accepted_source = made.source;
        }
        return made;
    }
    if (p.form.limits.outside == outside_limits::clamp) {
        made.value = clamped(p.form.limits, *value);
        return made;
    }
    if (made.state == quality::good)
        made.state = quality::out_of_limits;
    if (p.form.limits.outside == outside_limits::reject) {
        made.value = s.accepted.value_or(point_value{});
        made.source = s.accepted_source;
    }
    return made;
}

bool point_table::is_news(const point& p, const state& s, const point_sample& now) const
{
    if (s.forced || now.state != s.said_state || now.value.kind != s.said.kind)
        return true;
    switch (now.value.kind) {
    case point_kind::integer:
        if (p.deadband == 0)
            return now.value.integer != s.said.integer;
        [[fallthrough]];
    case point_kind::real: return std::fabs(now.value.real - s.said.real) > p.deadband;
    case point_kind::none: return false;
    case point_kind::boolean:
    case point_kind::text: break;
    }
    return now.value != s.said;
}

}  // namespace plcgw
