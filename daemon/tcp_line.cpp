#include "daemon/tcp_line.hpp"

#include "daemon/log.hpp"
#include "daemon/tcp_connect.hpp"

#include <boost/asio/write.hpp>

#include <algorithm>

namespace plcgw {
namespace {

using boost::system::error_code;

constexpr milliseconds first_pause{200};
constexpr milliseconds last_pause{10'000};
constexpr milliseconds connect_timeout{5'000};
constexpr milliseconds write_timeout{5'000};  // a server that takes nothing for so long is gone

}  // namespace

tcp_line::tcp_line(asio::io_context& loop, line_config config, modbus_line& routes, std::function<void()> settle)
    : config_(std::move(config)), routes_(routes), settle_(std::move(settle)), socket_(loop), guard_(socket_),
      reconnect_(loop)
{
}

asio::awaitable<void> tcp_line::run()
{
    routes_.start(now());
    milliseconds pause = first_pause;
    for (bool said = false;;) {
        const time_point deadline = now() + connect_timeout;
        error_code ec = co_await connect_before(deadline, socket_, guard_, config_.host, config_.port);
        if (!ec) {
            log::info("line {}: connected to {}:{}", config_.name, config_.host, config_.port);
            said = false;
            pause = first_pause;
            in_ = {};
            routes_.port_opened();
            ec = co_await serve();
            give_up_all();
        }
        error_code ignored;
        socket_.close(ignored);
        if (!std::exchange(said, true))
            log::warning("line {}: no connection to {}:{} ({}): it is tried again until there is one", config_.name,
                         config_.host, config_.port, ec.message());
        routes_.port_lost("no connection");
        settle_();
        reconnect_.expires_after(pause);
        co_await reconnect_.async_wait(no_throw);
        pause = std::min(2 * pause, last_pause);
    }
}

void tcp_line::wake()
{
    if (idle_)
        guard_.interrupt();
}

asio::awaitable<error_code> tcp_line::serve()
{
    for (;;) {
        buffer out;
        ask_again_or_fail(out);
        ask_what_is_due(out);
        if (!out.empty()) {
            guard_.arm(now() + write_timeout);
            const auto [ec, sent] = co_await asio::async_write(socket_, asio::buffer(out), no_throw);
            guard_.disarm();
            if (ec)
                co_return ec;
        }
        settle_();
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
    const auto size = co_await read_before(until, socket_, guard_, asio::buffer(received_));
    idle_ = false;
    if (!size && size.error() != asio::error::timed_out)
        co_return size.error();
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
    const time_point deadline = now() + each.question.timing.response_timeout;
    const buffer adu = open_.ask(who, each.question.unit, each.question.request, deadline);
    out.insert(out.end(), adu.begin(), adu.end());
}

void tcp_line::ask_again_or_fail(buffer& out)
{
    while (const auto expired = open_.take_expired(now())) {
        const under_way& each = questions_.at(expired->who);
        routes_.attempt_failed(each.question, {errc::timed_out, {}});
        if (each.attempts <= each.question.timing.retries)
            ask(expired->who, out);
        else
            finish(*expired);
    }
}

bool tcp_line::take_answers(bytes received)
{
    in_.feed(received);
    while (const auto next = in_.next()) {
        if (!*next)
            return false;
        if (const auto outcome = open_.take(**next))
            finish(*outcome);
    }
    return true;
}

void tcp_line::finish(const modbus::tcp_questions::outcome& outcome)
{
    const auto found = questions_.find(outcome.who);
    if (outcome.answer)
        routes_.answered(found->second.question, *outcome.answer, now(), wall_now());
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
