// A refused request says that something in it is wrong, not what. It is halved until a half is answered: at a gap, at a
// boundary between routes, or by length. When a part of a refused request is refused itself, that explains the refusal
// of the whole, whose limit is dropped, so that in the end only what matters is left out.
#include "bridge/routes/learned_limits.hpp"

#include <algorithm>
#include <utility>

namespace plcgw {
namespace {

using kind = learned_limit::kind;

constexpr std::chrono::minutes contradiction_after{1};  // a device that says yes and no by turns is not asked for more

std::uint32_t length(const read_block& b) { return b.end - b.first; }

bool is_older(const learned_limit& limit, wall_time now, std::chrono::nanoseconds age)
{
    return static_cast<std::int64_t>(now) - static_cast<std::int64_t>(limit.since) >= age.count();
}

// What is between the routes of a request: gaps, or the places where one route ends and the next begins.
struct seams {
    std::vector<read_block> gaps;
    std::vector<std::uint32_t> boundaries;
};

seams seams_of(std::vector<read_block> routes)
{
    std::sort(routes.begin(), routes.end());
    seams found;
    std::uint32_t end = routes.empty() ? 0 : routes.front().end;
    for (const read_block& each : routes) {
        if (each.first > end)
            found.gaps.push_back({end, each.first});
        else if (each.first == end)
            found.boundaries.push_back(end);
        end = std::max(end, each.end);
    }
    return found;
}

std::uint32_t nearest_the_middle(const std::vector<std::uint32_t>& boundaries, const read_block& of)
{
    const auto from_middle = [&](std::uint32_t x) {
        const std::int64_t twice = 2 * std::int64_t{x} - of.first - of.end;
        return twice < 0 ? -twice : twice;
    };
    return *std::min_element(boundaries.begin(), boundaries.end(),
                             [&](std::uint32_t a, std::uint32_t b) { return from_middle(a) < from_middle(b); });
}

// Where a request of several routes is cut if its length is not to blame: at a gap if it has one.
std::optional<read_block> seam_of(const read_block& request, const std::vector<read_block>& routes)
{
    const auto [gaps, boundaries] = seams_of(routes);
    if (!gaps.empty())
        return gaps[gaps.size() / 2];
    if (boundaries.empty())
        return std::nullopt;
    const std::uint32_t at = nearest_the_middle(boundaries, request);
    return read_block{at, at};
}

// What a limit is that is none of length.
void make_cut(learned_limit& limit)
{
    if (!limit.seam) {
        limit.what = kind::block;
        limit.at = limit.request;
        return;
    }
    limit.what = limit.seam->first == limit.seam->end ? kind::boundary : kind::gap;
    limit.at = *std::exchange(limit.seam, std::nullopt);
}

std::string numbers(std::uint32_t first, std::uint32_t end)
{
    return std::to_string(first) + (end - first == 1 ? "" : "-" + std::to_string(end - 1));
}

}  // namespace

std::uint32_t longest_of(const learned_limit& limit)
{
    return std::max<std::uint32_t>(1, limit.at.first + (limit.at.end - limit.at.first) / 2);
}

bool forbids(const learned_limit& limit, const read_block& request)
{
    switch (limit.what) {
    case kind::gap:
    case kind::boundary: return request.first < limit.at.end && request.end > limit.at.first;
    case kind::block: return covers(request, limit.at);
    case kind::length: return length(request) > longest_of(limit);
    }
    return false;
}

std::string to_string(const learned_limit& limit, const std::string& area)
{
    switch (limit.what) {
    case kind::gap: return area + " " + numbers(limit.at.first, limit.at.end) + ", wanted by no route, is left out";
    case kind::boundary: return "no request goes across " + area + " " + std::to_string(limit.at.first);
    case kind::block: return area + " " + numbers(limit.at.first, limit.at.end) + " is asked alone";
    case kind::length: break;
    }
    return area + " is asked by at most " + std::to_string(longest_of(limit));
}

const learned_limit* table_limits::forbidding(const read_block& request) const
{
    const auto found = std::find_if(limits_.begin(), limits_.end(), [&](const learned_limit& each) {
        return !each.on_trial && forbids(each, request);
    });
    return found == limits_.end() ? nullptr : &*found;
}

table_limits::lesson table_limits::refused(const read_block& request, const std::vector<read_block>& routes,
                                           bool for_its_length, const std::string& reason, wall_time now)
{
    const bool is_one = std::all_of(routes.begin(), routes.end(), [&](const auto& each) { return each == request; });
    if (reinstate(request, now))
        return {is_one, *forbidding(request)};
    learned_limit made{.what = kind::block, .at = request, .request = request, .reason = reason, .since = now};
    if (is_one) {
        const bool explains = std::any_of(limits_.begin(), limits_.end(), [&](const learned_limit& each) {
            return covers(each.request, request) && !(each.what == kind::block && each.at == request);
        });
        lesson learned = explains ? learn(made) : lesson{};
        learned.blames_routes = true;
        return learned;
    }
    if (!allow(request))
        return {};  // it was under way when that was learned
    if (std::find(routes.begin(), routes.end(), request) != routes.end())
        return learn(made);  // a longer route that others lie in
    made.seam = seam_of(request, routes);
    if (length(request) > longest_accepted_ && (for_its_length || is_second_of_its_length(made))) {
        made.what = kind::length;
        made.at = {longest_accepted_, length(request)};
    }
    else {
        make_cut(made);
    }
    return learn(made);
}

// Refused for its place, though there is no gap in it. The first time a boundary is to blame; when another request
// elsewhere was cut there that was longer than any answer, too, it is the length. A boundary that is none is asked
// across again after a day; a length that is none would shorten the requests of the whole table for as long.
bool table_limits::is_second_of_its_length(const learned_limit& refused) const
{
    const bool has_gap = refused.seam && refused.seam->first != refused.seam->end;
    return !has_gap && std::any_of(limits_.begin(), limits_.end(), [&](const learned_limit& each) {
        return is_suspected_length(each) && !covers(each.request, refused.request);
    });
}

bool table_limits::is_suspected_length(const learned_limit& limit) const
{
    return limit.what == kind::length || (limit.what == kind::boundary && length(limit.request) > longest_accepted_);
}

table_limits::lesson table_limits::learn(learned_limit limit)
{
    if (limit.what == kind::length)  // which explains these, too
        for (const learned_limit& each : limits_)
            if (is_suspected_length(each))
                limit.at.end = std::min(limit.at.end, length(each.request));
    std::erase_if(limits_, [&](const learned_limit& each) {
        return covers(each.request, limit.request) || (limit.what == kind::length && is_suspected_length(each));
    });
    limits_.push_back(limit);
    return {false, std::move(limit)};
}

// What was on trial was right.
bool table_limits::reinstate(const read_block& request, wall_time now)
{
    bool any = false;
    for (learned_limit& each : limits_) {
        if (!each.on_trial || !forbids(each, request))
            continue;
        each.on_trial = false;
        each.since = now;
        any = true;
    }
    return any;
}

// A longer request than the refused one is answered: it was refused for something else.
bool table_limits::contradict_length(const read_block& accepted)
{
    const auto found = std::find_if(limits_.begin(), limits_.end(), [&](const learned_limit& each) {
        return each.what == kind::length && length(accepted) >= each.at.end;
    });
    if (found == limits_.end())
        return false;
    if (found->on_trial)
        limits_.erase(found);
    else
        make_cut(*found);
    return true;
}

bool table_limits::accepted(const read_block& request, wall_time now)
{
    longest_accepted_ = std::max(longest_accepted_, length(request));
    bool changed = contradict_length(request);
    changed |=
        std::erase_if(limits_, [&](const learned_limit& each) {
            if (each.what == kind::length)
                return false;
            const bool contradicts = each.what != kind::block || each.at == request || each.on_trial;
            return contradicts && forbids(each, request) && (each.on_trial || is_older(each, now, contradiction_after));
        }) != 0;
    for (learned_limit& each : limits_) {
        if (each.what != kind::length || each.at.first >= length(request))
            continue;
        const std::uint32_t before = longest_of(each);
        each.at.first = length(request);
        changed = changed || longest_of(each) != before;
    }
    return changed;
}

bool table_limits::begin_trial(wall_time now)
{
    std::erase_if(limits_, [&](const learned_limit& each) {  // nobody has come near it meanwhile
        return each.on_trial && is_older(each, now, 2 * limit_kept);
    });
    const auto old = std::find_if(limits_.begin(), limits_.end(), [&](const learned_limit& each) {
        return !each.on_trial && is_older(each, now, limit_kept);
    });
    if (old == limits_.end() ||
        std::any_of(limits_.begin(), limits_.end(), [](const learned_limit& each) { return each.on_trial; }))
        return false;
    old->on_trial = true;
    return true;
}

void table_limits::restore(const learned_limit& limit)
{
    if (limit.what == kind::length)
        longest_accepted_ = std::max(longest_accepted_, limit.at.first);
    limits_.push_back(limit);
}

}  // namespace plcgw
