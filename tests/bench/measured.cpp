#include "tests/bench/measured.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace plcgw::bench {
namespace {

double microseconds(nanoseconds time) { return static_cast<double>(time) / 1000; }

nlohmann::json shares(const std::map<unsigned, std::pair<std::uint64_t, nanoseconds>>& of)
{
    nlohmann::json listed = nlohmann::json::object();
    for (const auto& [key, share] : of)
        listed[std::to_string(key)] = {{"answered", share.first}, {"ideal_us", microseconds(share.second)}};
    return listed;
}

nlohmann::json listed(const std::vector<seen_value>& values)
{
    nlohmann::json rows = nlohmann::json::array();
    for (const seen_value& each : values)
        rows.push_back({each.unit, each.first, each.value, each.end});
    return rows;
}

}  // namespace

void measured::note_silence(nanoseconds silence, nanoseconds rule, bool after_response)
{
    least_silence_ = std::min(least_silence_, silence);
    if (silence < rule)
        ++short_silences_;
    if (after_response)
        excess_.push_back(silence - rule);
}

void measured::note_answer(const answered_request& answered)
{
    if (blocks_.emplace(answered.unit, answered.function, answered.first).second)
        last_new_block_ = answered.end;
    if (answered.value) {
        const auto [shown, fresh] = shown_.try_emplace({answered.unit, answered.first}, *answered.value);
        if (!fresh && shown->second != *answered.value)
            changes_.push_back({answered.unit, answered.first, *answered.value, answered.end});
        shown->second = *answered.value;
    }
    longest_ = std::max(longest_, answered.ideal);
    last_end_ = answered.end;
    if (answered_++ == 0) {
        first_end_ = answered.end;
        return;
    }
    ideal_ += answered.ideal;
    for (auto* const share : {&units_[answered.unit], &functions_[answered.function]}) {
        ++share->first;
        share->second += answered.ideal;
    }
}

nlohmann::json measured::report() const
{
    nlohmann::json excess = nlohmann::json::array();
    for (const nanoseconds each : excess_)
        excess.push_back(microseconds(each));
    return {{"requests", requests},
            {"answered", answered_},
            {"unanswered", unanswered},
            {"collisions", collisions},
            {"torn_requests", torn_requests},
            {"bad_requests", bad_requests},
            {"short_silences", short_silences_},
            {"least_silence_us",
             least_silence_ == INT64_MAX ? nlohmann::json() : nlohmann::json(microseconds(least_silence_))},
            {"elapsed_us", microseconds(last_end_ - first_end_)},
            {"ideal_us", microseconds(ideal_)},
            {"longest_us", microseconds(longest_)},
            {"excess_us", excess},
            {"units", shares(units_)},
            {"functions", shares(functions_)},
            {"writes", listed(writes_)},
            {"changes", listed(changes_)},
            {"blocks", blocks_.size()},
            {"last_new_block_ns", last_new_block_}};
}

void measured::begin()
{
    measured fresh;
    fresh.blocks_ = std::move(blocks_);
    fresh.shown_ = std::move(shown_);
    fresh.last_new_block_ = last_new_block_;
    *this = std::move(fresh);
}

}  // namespace plcgw::bench
