#include "daemon/tcp_line.hpp"

#include <algorithm>

namespace plcgw {

using boost::system::error_code;

namespace {

constexpr auto may_not_speak = asio::error::no_permission;

}

tcp_line::tcp_line(asio::io_context& loop, line_config config, client_line& routes, std::function<void()> settle)
    : config_(std::move(config)), routes_(routes), settle_(std::move(settle)), connection_(loop, config_),
      ear_(loop, config_, routes_)
{
}

asio::awaitable<void> tcp_line::run()
{
    routes_.start(now());
    for (;;) {
        while (!ear_.look()) {
            settle_();
            co_await ear_.wait();
        }
        const bool is_open = co_await connection_.open();
        error_code ec;
        if (is_open) {
            in_ = {};
            ear_.opened();
            ec = co_await serve();
            ear_.closed();
            give_up_all();
            if (ec == may_not_speak)
                connection_.rest();
            else
                connection_.close(ec);
        }
        if (ec != may_not_speak)
            routes_.port_lost(connection_.absence());
        settle_();
    }
}

void tcp_line::wake()
{
    ear_.wake();
    if (idle_)
        connection_.interrupt();
}

asio::awaitable<error_code> tcp_line::serve()
{
    for (;;) {
        if (!ear_.look())
            co_return may_not_speak;
        buffer out;
        ask_again_or_fail(out);
        ask_what_is_due(out);
        if (!out.empty()) {
            const error_code ec = co_await connection_.write(out);
            if (ec)
                co_return ec;
        }
        settle_();
        if (connection_.deaf())
            co_return asio::error::timed_out;
        const error_code failed = co_await listen();
        if (failed)
            co_return failed;
    }
}

asio::awaitable<error_code> tcp_line::listen()
{
    const bool may_ask = open_.size() < config_.max_outstanding;
    const time_point due = may_ask ? routes_.wake_at(now()) : time_point::max();
    const time_point until = std::min(due, open_.deadline());
    idle_ = may_ask;
    const auto size = co_await connection_.read(until, asio::buffer(received_));
    idle_ = false;
    if (!size && size.error() != asio::error::timed_out)
        co_return size.error();
    if (!ear_.may_speak())
        co_return may_not_speak;  // what came may have waited for this process to go on
    if (size && !take_answers(bytes(received_).first(*size)))
        co_return make_error_code(errc::bad_header);
    co_return error_code{};
}

void tcp_line::ask_what_is_due(buffer& out)
{
    while (open_.size() < config_.max_outstanding) {
        auto question = routes_.next(now());
        if (!question)
            return;
        const key who{++last_key_};
        questions_.emplace(who, under_way{std::move(*question), 0});
        ask(who, out);
    }
}

void tcp_line::ask(key who, buffer& out)
{
    under_way& each = questions_.at(who);
    ++each.attempts;
    each.sent_at = now();
    const time_point deadline = now() + each.question.timing.response_timeout;
    const buffer adu = open_.ask(who, unit_of(each.question.unit), each.question.request(), deadline);
    out.insert(out.end(), adu.begin(), adu.end());
    connection_.meter().frames_sent();
}

void tcp_line::ask_again_or_fail(buffer& out)
{
    while (const auto expired = open_.take_expired(now())) {
        connection_.missed_answer();
        const under_way& each = questions_.at(expired->who);
        routes_.attempt_failed(each.question, {errc::timed_out, {}});
        if (each.attempts <= each.question.timing.retries && routes_.is_wanted(each.question))
            ask(expired->who, out);
        else
            finish(*expired);
    }
}

bool tcp_line::take_answers(bytes received)
{
    in_.feed(received);
    while (const auto next = in_.next()) {
        if (!*next) {
            connection_.meter().fault(next->error());
            return false;
        }
        connection_.meter().frames_received();
        if (const auto outcome = open_.take(**next))
            finish(*outcome);
    }
    return true;
}

void tcp_line::finish(const modbus::tcp_questions::outcome& outcome)
{
    const auto found = questions_.find(outcome.who);
    const bool first = found->second.attempts == 1;
    const auto took = first ? std::optional<duration>(now() - found->second.sent_at) : std::nullopt;
    if (outcome.answer)
        routes_.answered(found->second.question, *outcome.answer, now(), wall_now(), {}, took);
    else
        routes_.failed(found->second.question, outcome.answer.error(), now());
    questions_.erase(found);
}

void tcp_line::give_up_all()
{
    open_.forget_all();
    for (const auto& [who, each] : questions_)
        routes_.interrupted(each.question);
    questions_.clear();
}

}  // namespace plcgw
