#include "protocols/mewtocol/transaction.hpp"

#include "protocols/mewtocol/conversation.hpp"
#include "protocols/mewtocol/mewtocol7_conversation.hpp"

#include <algorithm>

namespace plcgw::mewtocol {

template <class Conversation>
transaction<Conversation>::transaction(Conversation question, const line_options& timing, time_point line_free_from,
                                       time_point now)
    : conversation_(std::move(question)), timing_(timing), framer_(timing.silence), line_free_from_(line_free_from),
      allowed_(timing.retries + 1)
{
    if (conversation_.is_expressible()) {
        queue(message::question, conversation_.begin(), now);
    }
    else {
        outcome_ = make_error_code(errc::not_expressible);
        state_ = state::finished;
    }
}

template <class Conversation>
duration transaction<Conversation>::gap() const
{
    return std::max(timing_.gap, character_time(timing_.format, 1));
}

template <class Conversation>
void transaction<Conversation>::queue(message what, buffer adu, time_point now)
{
    what_ = what;
    adu_ = std::move(adu);
    give_up_ = std::max(now, line_free_from_) + timing_.response_timeout;
    state_ = state::wait_for_line;
}

// The end of the wait for a frame. A line that babbles for ever does not hold us for longer than a frame can last.
template <class Conversation>
time_point transaction<Conversation>::give_up_waiting() const
{
    const time_point timeout = sent_until_ + timing_.response_timeout;
    if (!framer_.in_frame())
        return timeout;
    const time_point longest = timeout + character_time(timing_.format, conversation_.max_answer_size());
    return std::min(heard_, longest) + timing_.silence;
}

template <class Conversation>
typename transaction<Conversation>::action transaction<Conversation>::next(time_point now)
{
    switch (state_) {
    case state::wait_for_line:
        if (now < line_free_from_ && now < give_up_)
            return wait{std::min(line_free_from_, give_up_)};
        if (now < line_free_from_) {
            if (!concluded_)
                outcome_ = make_error_code(errc::line_not_quiet);
            state_ = state::finished;
            return done{};
        }
        state_ = state::sending;
        return send{adu_};

    case state::sending: return send{adu_};

    case state::wait_for_answer:
        while (state_ == state::wait_for_answer) {
            const auto r = framer_.next(now);
            if (!r)
                break;
            judge(now, *r);
        }
        if (state_ == state::wait_for_answer) {
            const time_point until = give_up_waiting();
            if (now < until)
                return wait{std::min(until, framer_.deadline())};
            fail_attempt(now, framer_.in_frame() ? errc::incomplete : heard_instead_, false);
        }
        return next(now);

    case state::finished: break;
    }
    return done{};
}

template <class Conversation>
void transaction<Conversation>::sent(time_point now)
{
    sent_until_ = now + character_time(timing_.format, adu_.size());
    if (what_ == message::question)
        ++attempts_;
    if (what_ == message::abort || !conversation_.expects_answer()) {
        line_free_from_ = sent_until_ + std::max(timing_.turnaround, gap());
        if (what_ == message::abort && !concluded_) {
            queue(message::question, conversation_.begin(), now);
        }
        else {
            if (!concluded_)
                outcome_ = answer_type{typename Conversation::unanswered{}};
            state_ = state::finished;
        }
        return;
    }
    framer_ = line_framer(timing_.silence);
    heard_instead_ = errc::timed_out;
    state_ = state::wait_for_answer;
}

template <class Conversation>
void transaction<Conversation>::feed(time_point now, bytes received)
{
    if (received.empty())
        return;
    heard_ = now;
    if (state_ != state::wait_for_answer) {
        stray_bytes_ += received.size();
        line_free_from_ = std::max(line_free_from_, now + gap());
        return;
    }
    framer_.feed(now, received);
    while (state_ == state::wait_for_answer) {
        const auto r = framer_.next(now);
        if (!r)
            return;
        judge(now, *r);
    }
}

template <class Conversation>
void transaction<Conversation>::judge(time_point now, const reception& r)
{
    auto said = conversation_.hear(r);
    if (const auto* other = std::get_if<not_the_answer>(&said)) {
        if (other->why != errc{})
            heard_instead_ = other->why;
        return;
    }
    if (const auto* damage = std::get_if<damaged_answer>(&said)) {
        fail_attempt(now, damage->why, damage->why != errc::incomplete);
        return;
    }
    if (what_ == message::question)
        response_time_ = std::max(duration{}, now - sent_until_);
    line_free_from_ = now + gap();
    if (auto* refusal = std::get_if<not_now<answer_type>>(&said))
        ask_again(now, std::move(refusal->answer));
    else if (auto* more = std::get_if<ask_on>(&said))
        queue(message::next_frame, std::move(more->request), now);
    else
        conclude(now, std::move(std::get<answer_type>(said)));
}

// came: a whole answer did, although useless. No other one is on its way then.
template <class Conversation>
void transaction<Conversation>::fail_attempt(time_point now, errc why, bool came)
{
    faults_.push_back(why);
    if (!came && unanswered_++ == 0)
        unanswered_since_ = sent_until_;
    line_free_from_ = std::max(heard_ + gap(), now);
    if (attempts_ >= allowed_ || !conversation_.is_repeatable()) {
        conclude(now, make_error_code(why));
        return;
    }
    if (auto abort = conversation_.abort())
        queue(message::abort, std::move(*abort), now);
    else
        queue(message::question, conversation_.begin(), now);
}

// Even what must not be done twice: it was not done. An answer that waits there, perhaps to a question of ours whose
// first frame was lost, is cleared once, and does not cost an attempt.
template <class Conversation>
void transaction<Conversation>::ask_again(time_point now, answer_type refusal)
{
    auto abort = conversation_.abort();
    if (abort && !cleared_)
        ++allowed_;
    if (attempts_ >= allowed_ || (abort && cleared_)) {
        conclude(now, std::move(refusal));
        return;
    }
    if (abort) {
        cleared_ = true;
        queue(message::abort, std::move(*abort), now);
    }
    else {
        line_free_from_ = now + std::max(timing_.turnaround, gap());  // it may be busy
        queue(message::question, conversation_.begin(), now);
    }
}

// The station is told to forget the rest of an answer, so that the next question finds it ready.
template <class Conversation>
void transaction<Conversation>::conclude(time_point now, result<answer_type> outcome)
{
    outcome_ = std::move(outcome);
    concluded_ = true;
    if (auto abort = conversation_.abort())
        queue(message::abort, std::move(*abort), now);
    else
        state_ = state::finished;
}

template class transaction<conversation>;
template class transaction<mewtocol7::conversation>;

}  // namespace plcgw::mewtocol
