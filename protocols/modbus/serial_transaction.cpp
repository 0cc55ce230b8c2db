#include "protocols/modbus/serial_transaction.hpp"

#include <algorithm>

namespace plcgw::modbus {
serial_transaction::serial_transaction(unit_id unit, request question, const serial_options& timing,
                                       time_point line_free_from, time_point now)
    : unit_(unit), question_(std::move(question)), timing_(timing),
      adu_(encode_adu(timing.mode, {unit, encode_request(question_)}, timing.delimiter)),
      line_free_from_(line_free_from), give_up_(std::max(now, line_free_from) + timing.response_timeout)
{
}

duration serial_transaction::gap() const { return std::max(timing_.gap, frame_gap(timing_.format)); }

// The end of a damaged answer. A line that babbles for ever does not hold us for longer than an answer can last. Noise
// and the answer of an unexpected station leave the response timeout running (V1.02 section 2.4.1).
time_point serial_transaction::silence_ends() const
{
    const time_point timeout = sent_until_ + timing_.response_timeout;
    const auto* const ascii = std::get_if<ascii_answer>(&*answer_);
    const time_point longest =
        timeout + character_time(timing_.format, ascii != nullptr ? max_ascii_size : max_rtu_size);
    const bool in_frame = ascii != nullptr && ascii->inside();
    const time_point silent =
        std::min(heard_, longest) + (in_frame ? std::max(timing_.silence, ascii_max_silence) : timing_.silence);
    const bool begun = std::visit([](const auto& in) { return in.begun(); }, *answer_);
    return begun ? silent : std::max(silent, timeout);
}

serial_transaction::action serial_transaction::next(time_point now)
{
    switch (state_) {
    case state::wait_for_line:
        if (now < line_free_from_ && now >= give_up_) {
            finish(make_error_code(errc::line_not_quiet));
            return done{};
        }
        if (now < line_free_from_)
            return wait{std::min(line_free_from_, give_up_)};
        state_ = state::sending;
        return send{adu_};

    case state::sending: return send{adu_};

    case state::wait_for_answer:
        if (now < sent_until_ + timing_.response_timeout)
            return wait{sent_until_ + timing_.response_timeout};
        fail_attempt(now, {errc::timed_out, {}});
        return next(now);

    case state::wait_for_silence:
        if (now < silence_ends())
            return wait{silence_ends()};
        fail_attempt(now, std::visit([](const auto& in) { return in.fault(); }, *answer_));
        return next(now);

    case state::finished: break;
    }
    return done{};
}

void serial_transaction::sent(time_point now)
{
    ++attempts_;
    sent_until_ = now + character_time(timing_.format, adu_.size());
    if (!expects_answer(unit_, question_)) {
        line_free_from_ = sent_until_ + std::max(timing_.turnaround, gap());
        finish(response{no_response{}});
        return;
    }
    expect_answer();
    echo_.clear();
    awaits_echo_ =
        timing_.echo == local_echo::on || (timing_.echo == local_echo::automatic && !echoes_request(question_));
    state_ = state::wait_for_answer;
}

void serial_transaction::expect_answer()
{
    if (timing_.mode == framing::ascii)
        answer_.emplace(std::in_place_type<ascii_answer>, unit_, question_, timing_.delimiter);
    else
        answer_.emplace(std::in_place_type<rtu_answer>, unit_, question_);
}

void serial_transaction::feed(time_point now, bytes received)
{
    if (received.empty())
        return;
    heard_ = now;
    if (state_ != state::wait_for_answer && state_ != state::wait_for_silence) {
        stray_bytes_ += received.size();
        line_free_from_ = std::max(line_free_from_, now + gap());
        return;
    }
    received = without_echo(received);
    if (received.empty())
        return;
    if (auto answer = std::visit([&](auto& in) { return in.feed(received); }, *answer_))
        answered(now, std::move(*answer));
    else
        state_ = state::wait_for_silence;
}

// What remains of the bytes after a request when its echo is taken away. Empty while they may still become the echo.
bytes serial_transaction::without_echo(bytes received)
{
    if (!awaits_echo_)
        return received;
    echo_.insert(echo_.end(), received.begin(), received.end());
    const std::size_t compared = std::min(echo_.size(), adu_.size());
    const bool same = std::equal(echo_.begin(), echo_.begin() + static_cast<std::ptrdiff_t>(compared), adu_.begin());
    if (same && echo_.size() < adu_.size())
        return {};
    awaits_echo_ = false;
    echo_seen_ = echo_seen_ || same;
    return same ? bytes(echo_).subspan(adu_.size()) : bytes(echo_);
}

void serial_transaction::answered(time_point now, response answer)
{
    response_time_ = std::max(duration{}, now - sent_until_);
    line_free_from_ = now + gap();
    finish(std::move(answer));
}

void serial_transaction::fail_attempt(time_point now, answer_fault why)
{
    const errc reason = why.why;
    faults_.push_back(std::move(why));
    const bool whole = std::visit([](const auto& in) { return in.whole(); }, *answer_);
    if (!whole && unanswered_++ == 0)
        unanswered_since_ = sent_until_;
    line_free_from_ = std::max(heard_ + gap(), now);
    if (attempts_ > timing_.retries) {
        finish(make_error_code(reason));
        return;
    }
    give_up_ = line_free_from_ + timing_.response_timeout;
    state_ = state::wait_for_line;
}

void serial_transaction::finish(result<response> outcome)
{
    outcome_ = std::move(outcome);
    state_ = state::finished;
}

}  // namespace plcgw::modbus
