#include "bridge/standby/pair.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace plcgw {
namespace {

constexpr int leases_of_a_claim = 4;  // then the other member does not understand it

using severity = pair_event::severity;

std::string number(std::uint64_t term) { return std::to_string(term); }

}  // namespace

standby_pair::standby_pair(pair_settings settings, time_point now)
    : settings_(std::move(settings)), role_since_(now), listens_until_(now + settings_.listen),
      lease_until_(now + settings_.lease)
{
    for (const pair_line_settings& each : settings_.lines) {
        lines_.emplace_back(each);
        lines_.back().listen_anew(now);
        listens_until_ = std::max(listens_until_, now + each.quiet);
    }
    why_ = "it listens first";
}

void standby_pair::heard(time_point now, const pair_beat& beat)
{
    other_heard_ = now;
    const bool is_news = other_is_ != other_state::alive || !other_ || other_->member != beat.member;
    other_ = beat;
    if (beat.leaves) {
        if (std::exchange(other_is_, other_state::left) != other_state::left)
            say(severity::info, "member " + beat.member + " ends");
        return;
    }
    other_is_ = other_state::alive;
    attempts_ = 0;
    if (is_news)
        say(severity::info, "member " + beat.member + " is heard: " + std::string(to_string(beat.role)) + " in term " +
                                number(beat.term));
    if (leaving_)
        return;
    if (role_ == pair_role::active)
        heard_as_active(now, beat);
    else
        heard_as_standby(beat);
}

void standby_pair::heard_as_active(time_point now, const pair_beat& beat)
{
    if (beat.claims && beat.term > term_)
        give_way(now, beat, "member " + beat.member + " takes over");
    else if (beat.role == pair_role::active && !outranks(beat))
        give_way(now, beat, "member " + beat.member + " is active, too, and comes first");
    else if (beat.role == pair_role::active)
        news_ = true;  // so that it learns at once who comes first
    else
        term_ = std::max(term_, beat.term);
}

void standby_pair::heard_as_standby(const pair_beat& beat)
{
    bool is_too_late = false;
    if (claim_ && beat.role == pair_role::active)
        is_too_late = claim_->when_nobody || beat.term >= claim_->term;
    else if (claim_)
        is_too_late = beat.claims && !claim_outranks(beat);
    if (is_too_late)
        claim_.reset();
    news_ = news_ || is_too_late || (!claim_ && beat.term > term_);
    if (!claim_)
        term_ = std::max(term_, beat.term);
}

bool standby_pair::outranks(const pair_beat& beat) const
{
    return std::tie(term_, settings_.priority, settings_.member) > std::tie(beat.term, beat.priority, beat.member);
}

bool standby_pair::claim_outranks(const pair_beat& beat) const
{
    return std::tie(claim_->term, settings_.priority, settings_.member) >
           std::tie(beat.term, beat.priority, beat.member);
}

void standby_pair::lost()
{
    if (other_is_ != other_state::alive)
        return;
    other_is_ = other_state::lost;
    say(severity::warning, "member " + other_->member + " is not heard any more");
}

bool standby_pair::other_lives() const { return other_is_ == other_state::alive; }

void standby_pair::look_at_other(time_point now)
{
    if (other_is_ == other_state::alive && now - other_heard_ > settings_.lease * 3 / 2)
        lost();
}

void standby_pair::give_way(time_point now, const pair_beat& beat, const std::string& why)
{
    become(now, pair_role::standby, why);
    term_ = std::max(term_, beat.term);
}

void standby_pair::become(time_point now, pair_role role, const std::string& why)
{
    role_ = role;
    role_since_ = now;
    why_ = why;
    news_ = true;
    offers_ = false;
    busy_said_ = false;
    if (role != pair_role::active) {
        keeps_ = false;
        for (pair_line& each : lines_)
            each.stop(now);
    }
    say(severity::info, std::string(to_string(role)) + " in term " + number(term_) + ": " + why);
}

void standby_pair::listen_anew(time_point now, const std::string& why)
{
    claim_.reset();
    become(now, pair_role::starting, why);
    listens_until_ = now + 2 * settings_.lease;
    if (other_is_ == other_state::alive)
        other_heard_ = now;  // what it said meanwhile may not have been looked at
    for (pair_line& each : lines_) {
        each.listen_anew(now);
        listens_until_ = std::max(listens_until_, now + each.settings().quiet);
    }
}

void standby_pair::look(time_point now, std::span<const line_heard> lines)
{
    for (std::size_t i = 0; i < lines_.size(); ++i)
        lines_[i].heard(lines[i]);
    if (leaving_)
        return;
    if (now >= lease_until_)
        listen_anew(now, "it stood still for longer than its lease, and listens anew");
    lease_until_ = now + settings_.lease;
    look_at_other(now);
    follow_claim(now);
    const bool other_works = other_lives() && other_->role == pair_role::active;
    if (role_ == pair_role::starting && (other_works || now >= listens_until_))
        become(now, pair_role::standby, other_works ? "member " + other_->member + " is active" : "nobody is active");
    if (role_ == pair_role::standby)
        look_as_standby(now);
    else if (role_ == pair_role::active)
        look_as_active(now);
}

void standby_pair::begin_claim(time_point now, const std::string& why, bool keeps)
{
    term_ = std::max(term_, other_->term);
    claim_ = claim{term_ + 1, now, why, keeps, other_->role != pair_role::active};
    news_ = true;
}

// The other member has heard of the term, and is silent.
void standby_pair::follow_claim(time_point now)
{
    if (!claim_)
        return;
    if (!other_lives()) {
        claim_.reset();
    }
    else if (other_->role != pair_role::active && !other_->claims && other_->term >= claim_->term) {
        const claim mine = *std::exchange(claim_, std::nullopt);
        term_ = mine.term;
        become(now, pair_role::active, mine.why);
        keeps_ = mine.keeps;
    }
    else if (now - claim_->since > leases_of_a_claim * settings_.lease) {
        say(severity::warning, "member " + other_->member + " does not give way (" + claim_->why + ")");
        claim_.reset();
    }
}

void standby_pair::look_as_standby(time_point now)
{
    if (claim_)
        return;
    if (!other_lives()) {
        take_over_if_quiet(now);
        return;
    }
    for (pair_line& each : lines_)
        each.stop(now);
    if (const auto why = reason_to_claim(now))
        begin_claim(now, *why, other_->offers);
}

std::optional<std::string> standby_pair::reason_to_claim(time_point now) const
{
    if (other_->claims)
        return std::nullopt;
    if (other_->role != pair_role::active) {
        // Who has just started does not take over soon; two that start at the same time wait for the first of them.
        const bool is_sooner = other_->role == pair_role::starting && now - role_since_ >= settings_.lease;
        if (is_sooner || outranks(*other_))
            return "nobody is active";
        return std::nullopt;
    }
    if (other_->offers)
        return "member " + other_->member + " hands over";
    if (const auto line = silent_line(now))
        return "line " + *line + " is silent, and member " + other_->member + " hears nothing there either";
    const bool is_preferred =
        std::tie(settings_.priority, settings_.member) > std::tie(other_->priority, other_->member);
    const bool is_warm = now - role_since_ >= settings_.hand_back_after;
    unsigned heard_here = 0;
    for (const pair_line& each : lines_)
        heard_here += each.report(now) == line_report::good ? 1 : 0;
    if (settings_.hand_back && is_preferred && is_warm && !other_->keeps && heard_here >= good_lines_there())
        return "it is the preferred member";
    return std::nullopt;
}

// One that the other member cannot use either, and that may be better here.
std::optional<std::string> standby_pair::silent_line(time_point now) const
{
    if (good_lines_here(now) <= good_lines_there())
        return std::nullopt;
    for (const pair_line& each : lines_) {
        const pair_line_report there = report_there(each.settings().name);
        const bool unheard = there.state == line_report::mute && there.asked && each.missed(now, *there.asked);
        if ((unheard || there.state == line_report::closed) && each.is_silent(now) && each.is_worth_a_claim())
            return each.settings().name;
    }
    return std::nullopt;
}

unsigned standby_pair::good_lines_here(time_point now) const
{
    unsigned good = 0;
    for (const pair_line& each : lines_) {
        const line_report here = each.report(now);
        good += here == line_report::good || (here == line_report::mute && each.is_worth_a_claim()) ? 1 : 0;
    }
    return good;
}

unsigned standby_pair::good_lines_there() const
{
    unsigned good = 0;
    for (const pair_line& each : lines_)
        good += report_there(each.settings().name).state == line_report::good ? 1 : 0;
    return good;
}

pair_line_report standby_pair::report_there(const std::string& line) const
{
    for (const pair_line_report& each : other_->lines)
        if (each.line == line)
            return each;
    return {};
}

pair_beat standby_pair::beat() const
{
    pair_beat out;
    out.member = settings_.member;
    out.role = role_;
    out.term = claim_ ? claim_->term : term_;
    out.priority = settings_.priority;
    out.claims = claim_.has_value();
    out.offers = offers_;
    out.leaves = leaving_;
    out.keeps = keeps_;
    const time_point looked_at = lease_until_ - settings_.lease;
    for (const pair_line& each : lines_)
        out.lines.push_back({each.settings().name, each.report(looked_at), each.speaks(), each.asked(looked_at)});
    return out;
}

std::optional<std::string> standby_pair::switch_over(time_point now)
{
    if (!other_lives())
        return "the other member is not heard: there is nobody to hand over to";
    if (role_ == pair_role::starting || other_->role == pair_role::starting)
        return "a member has just started and still listens: try again in some seconds";
    if (role_ == pair_role::active) {
        offers_ = true;
        offers_until_ = now + leases_of_a_claim * settings_.lease;
        news_ = true;
    }
    else if (!claim_)
        begin_claim(now, "by command", true);
    return std::nullopt;
}

void standby_pair::leave(time_point now)
{
    leaving_ = true;
    claim_.reset();
    become(now, pair_role::standby, "it ends");
    lease_until_ = now;
}

}  // namespace plcgw
