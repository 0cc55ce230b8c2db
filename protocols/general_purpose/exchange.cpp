#include "protocols/general_purpose/exchange.hpp"

#include <algorithm>
#include <utility>

namespace plcgw::general_purpose {

exchange::exchange(message_framer& in, buffer message, expect answer, const exchange_options& options,
                   time_point line_free_from, time_point now)
    : in_(in), message_(std::move(message)), expected_(answer), options_(options), line_free_from_(line_free_from),
      send_at_(now + options.send_wait), line_timeout_(std::max(send_at_, line_free_from) + options.response_timeout)
{
}

exchange::action exchange::next(time_point now)
{
    switch (state_) {
    case state::wait_for_line: return wait_for_line(now);
    case state::sending: return send{message_};
    case state::wait_for_answer: return wait_for_answer(now);
    case state::finished: break;
    }
    return done{};
}

exchange::action exchange::wait_for_line(time_point now)
{
    collect(now);
    const time_point free = std::max(line_free_from_, send_at_);
    if (now >= free) {
        state_ = state::sending;
        return send{message_};
    }
    if (now < line_timeout_)
        return wait{std::min({free, line_timeout_, in_.deadline()})};
    finish(make_error_code(errc::line_not_quiet));
    return done{};
}

void exchange::sent(time_point now)
{
    collect(now);
    ++attempts_;
    sent_until_ = now + character_time(options_.format, message_.size());
    line_free_from_ = sent_until_ + options_.gap;
    if (expected_ == expect::nothing) {
        finish(buffer{});
        return;
    }
    heard_.reset();
    failure_.reset();
    echoed_ = 0;
    state_ = state::wait_for_answer;
}

void exchange::feed(time_point now, bytes received)
{
    if (state_ == state::wait_for_answer)
        received = without_echo(received);
    if (received.empty())
        return;
    line_free_from_ = std::max(line_free_from_, now + options_.gap);
    if (state_ == state::wait_for_answer)
        heard_ = now;
    if (!collided())
        in_.feed(now, received);
}

void exchange::fault(time_point now, errc why)
{
    if (state_ == state::wait_for_answer)
        heard_ = now;
    if (!collided())
        in_.fault(now, why);
}

// Characters that are not ours, where ours must be, and all that follow them are nobody's message.
bytes exchange::without_echo(bytes received)
{
    if (options_.echo != local_echo::on)
        return received;
    const std::size_t own = std::min(received.size(), message_.size() - echoed_);
    if (!std::equal(received.begin(), received.begin() + static_cast<std::ptrdiff_t>(own),
                    message_.begin() + static_cast<std::ptrdiff_t>(echoed_))) {
        failure_ = errc::collision;
        echoed_ = message_.size();
        return received;
    }
    echoed_ += own;
    return received.subspan(own);
}

exchange::action exchange::wait_for_answer(time_point now)
{
    while (auto each = in_.next(now)) {
        if (*each) {
            response_time_ = std::max(duration{}, now - sent_until_);
            finish(std::move(*each));
            return done{};
        }
        const auto why = static_cast<errc>(each->error().value());
        if (why != errc::restarted)
            failure_ = why;
        others_.push_back(std::move(*each));
    }
    if (now < give_up_at())
        return wait{std::min(give_up_at(), in_.deadline())};
    fail_attempt(now);
    return next(now);
}

// Noise leaves the response timeout running; an answer that is known to be damaged ends with the silence behind it. A
// line that babbles for ever does not hold us for longer than an answer can last.
time_point exchange::give_up_at() const
{
    const time_point timeout = sent_until_ + options_.response_timeout;
    if (!heard_)
        return timeout;
    const bool framer_waits = in_.inside() && in_.deadline() != time_point::max();
    const duration quiet = framer_waits ? std::max(options_.silence, in_.deadline() - in_.heard()) : options_.silence;
    const time_point longest = timeout + character_time(options_.format, max_message_size) + quiet;
    const time_point silent = std::min(*heard_ + quiet, longest);
    return failure_ ? silent : std::max(silent, timeout);
}

void exchange::fail_attempt(time_point now)
{
    if (!failure_ && unanswered_++ == 0)
        unanswered_since_ = sent_until_;
    if (in_.inside()) {
        if (!failure_)
            others_.emplace_back(make_error_code(errc::incomplete));
        failure_ = failure_.value_or(errc::incomplete);
        in_.abandon();
    }
    const errc why = std::exchange(failure_, std::nullopt).value_or(errc::timed_out);
    if (attempts_ > options_.retries) {
        finish(make_error_code(why));
        return;
    }
    send_at_ = now + options_.send_wait;
    line_timeout_ = std::max(send_at_, line_free_from_) + options_.response_timeout;
    state_ = state::wait_for_line;
}

void exchange::collect(time_point now)
{
    while (auto each = in_.next(now))
        others_.push_back(std::move(*each));
}

void exchange::finish(result<buffer> outcome)
{
    outcome_ = std::move(outcome);
    state_ = state::finished;
}

listener::action listener::next(time_point now)
{
    if (finished_)
        return done{};
    if (auto each = in_.next(now))
        outcome_ = std::move(*each);
    else if (now < until_)
        return wait{std::min(until_, in_.deadline())};
    finished_ = true;
    return done{};
}

}  // namespace plcgw::general_purpose
