#include "daemon/serial_line.hpp"

#include "daemon/log.hpp"

#include <algorithm>

namespace plcgw {

using boost::system::error_code;

serial_line::serial_line(asio::io_context& loop, line_config config, client_line& routes, std::function<void()> settle)
    : config_(std::move(config)), routes_(routes), settle_(std::move(settle)),
      connection_(make_connection(loop, config_)), gap_(std::max<duration>(config_.gap, frame_gap(format_of(config_))))
{
}

asio::awaitable<void> serial_line::run()
{
    routes_.start(now());
    for (;;) {
        const bool is_open = co_await connection_->open();
        if (is_open) {
            line_free_from_ = now() + gap_;
            routes_.port_opened();
            const error_code ec = co_await serve();
            connection_->close(ec);
        }
        routes_.port_lost(connection_->absence());
        settle_();
    }
}

void serial_line::wake()
{
    if (idle_)
        connection_->interrupt();
}

asio::awaitable<error_code> serial_line::serve()
{
    for (;;) {
        std::optional<client_line::question> question = routes_.next(now());
        error_code ec;
        if (question) {
            ec = co_await exchange(std::move(*question));
        }
        else {
            settle_();  // what was answered without asking
            const time_point due = routes_.wake_at(now());
            ec = co_await listen_until(due);
        }
        if (ec)
            co_return ec;
    }
}

// Nothing is due. Bytes that come now belong to nobody, but they keep the line busy; an unplugged port is noticed.
asio::awaitable<error_code> serial_line::listen_until(time_point deadline)
{
    idle_ = true;
    const auto size = co_await connection_->read(deadline, asio::buffer(received_));
    idle_ = false;
    if (size)
        line_free_from_ = std::max(line_free_from_, now() + gap_);
    else if (size.error() != asio::error::timed_out)
        co_return size.error();
    co_return error_code{};
}

asio::awaitable<error_code> serial_line::exchange(client_line::question question)
{
    if (echoes_ && question.timing.echo == local_echo::automatic)
        question.timing.echo = local_echo::on;
    modbus::serial_transaction transaction(question.unit, question.request, question.timing, line_free_from_, now());
    bool asked = false;
    for (std::size_t told = 0;;) {
        const auto action = transaction.next(now());
        for (; told < transaction.faults().size(); ++told)
            if (routes_.attempt_failed(question, transaction.faults()[told]))
                settle_();  // a PLC's program shows its retries as they happen
        if (std::holds_alternative<modbus::serial_transaction::done>(action))
            break;
        error_code ec;
        if (const auto* to_send = std::get_if<modbus::serial_transaction::send>(&action)) {
            if (std::exchange(asked, true) && !routes_.is_wanted(question))
                break;
            const time_point started = now();
            ec = co_await connection_->write(to_send->adu);
            transaction.sent(started);
        }
        else {
            const time_point until = std::get<modbus::serial_transaction::wait>(action).until;
            const auto size = co_await connection_->read(until, asio::buffer(received_));
            if (size)
                transaction.feed(now(), bytes(received_).first(*size));
            else if (size.error() != asio::error::timed_out)
                ec = size.error();
        }
        if (ec) {
            routes_.interrupted(question);
            co_return ec;
        }
    }
    line_free_from_ = transaction.line_free_from();
    if (transaction.echo_seen() && !std::exchange(echoes_, true))
        log::info("line {}: the adapter returns what it sends, that is left out from now on", config_.name);
    const unanswered_requests late{transaction.unanswered(), transaction.unanswered_since()};
    for (unsigned i = 0; i < late.count; ++i)
        connection_->missed_answer();
    if (const auto& outcome = transaction.outcome())
        routes_.answered(question, *outcome, now(), wall_now(), late);
    else
        routes_.failed(question, outcome.error(), now(), late);
    settle_();
    co_return connection_->deaf() ? error_code(asio::error::timed_out) : error_code{};
}

}  // namespace plcgw
