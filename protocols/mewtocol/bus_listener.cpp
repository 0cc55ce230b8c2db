#include "protocols/mewtocol/bus_listener.hpp"

#include "protocols/mewtocol/mewtocol7_frame.hpp"

#include <utility>

namespace plcgw::mewtocol {
namespace {

bool is_of_mewtocol7(const reception& r) { return r.characters.starts_with('>'); }

}  // namespace

void bus_listener::spoke(time_point now, bytes frame)
{
    spoken_.assign(frame.begin(), frame.end());
    if (spoken_.ends_with('\r'))
        spoken_.pop_back();
    echoes_ = 2;  // as it is said now, and by the adapter
    feed(now, frame);
}

std::optional<heard_exchange> bus_listener::next(time_point now)
{
    while (heard_.empty()) {
        const auto r = in_.next(now);
        if (!r)
            break;
        if (is_frame(*r))
            take(*r);
    }
    if (heard_.empty() && asked_ && now >= silence_is_clear_at())
        tell(std::nullopt, now);
    if (heard_.empty())
        return std::nullopt;
    heard_exchange first = std::move(heard_.front());
    heard_.pop_front();
    return first;
}

time_point bus_listener::deadline() const
{
    return asked_ ? std::min(in_.deadline(), silence_is_clear_at()) : in_.deadline();
}

void bus_listener::take(const reception& r)
{
    if (is_of_mewtocol7(r)) {
        const auto f = mewtocol7::parse_frame(r.characters);
        if (f && f->checked == check::good && f->text.starts_with('#'))
            note(is_ours(r));
        return;
    }
    const auto f = parse_frame(r.characters);
    if (!f || f->checked == check::wrong)
        return;
    if (f->text.starts_with('#')) {
        take_question(*f, r);
        return;
    }
    if (!asked_)
        return;
    auto heard = asked_->with.hear(r);
    if (auto* const answer = std::get_if<response>(&heard))
        tell(std::move(*answer), heard_at_);
    else if (auto* const busy = std::get_if<not_now<response>>(&heard))
        tell(std::move(busy->answer), heard_at_);
    else if (std::holds_alternative<damaged_answer>(heard))
        tell(std::nullopt, heard_at_);
}

void bus_listener::take_question(const frame& f, const reception& r)
{
    if (asked_)
        tell(std::nullopt, heard_at_);
    const bool ours = is_ours(r);
    note(ours);
    auto parsed = parse_command(std::string_view(f.text).substr(1), all_commands);
    if (!parsed)
        return;
    asked_.emplace(question{conversation(f.head, f.station, *parsed), f.station, *parsed, ours});
    asked_->with.begin();
    if (!asked_->with.expects_answer())
        tell(response{no_response{}}, heard_at_);
}

bool bus_listener::is_ours(const reception& r)
{
    if (echoes_ == 0 || r.characters != spoken_)
        return false;
    --echoes_;
    return true;
}

void bus_listener::note(bool ours)
{
    if (!ours)
        foreign_ = heard_at_;
}

void bus_listener::tell(std::optional<response> answer, time_point at)
{
    if (!asked_->ours)
        heard_.push_back({asked_->station, std::move(asked_->asked), std::move(answer), at});
    asked_.reset();
}

}  // namespace plcgw::mewtocol
