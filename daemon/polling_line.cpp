#include "daemon/polling_line.hpp"

#include "daemon/log.hpp"

#include <algorithm>

namespace plcgw {

using boost::system::error_code;

polling_line::polling_line(asio::io_context& loop, line_config config, client_line& routes,
                           std::function<void()> settle)
    : config_(std::move(config)), routes_(routes), settle_(std::move(settle)),
      connection_(make_connection(loop, config_)), ear_(loop, config_, routes_),
      gap_(std::max<duration>(config_.gap, frame_gap(format_of(config_))))
{
}

asio::awaitable<void> polling_line::run()
{
    routes_.start(now());
    for (;;) {
        while (ear_.is_deaf() && !ear_.look()) {
            settle_();
            co_await ear_.wait();
        }
        const bool is_open = co_await connection_->open();
        error_code ec;
        if (is_open) {
            line_free_from_ = now() + gap_;
            ear_.opened();
            ec = co_await serve();
            ear_.closed();
            if (ec == may_not_speak)
                connection_->rest();
            else
                connection_->close(ec);
        }
        if (ec != may_not_speak)
            routes_.port_lost(connection_->absence());
        settle_();
    }
}

void polling_line::wake()
{
    ear_.wake();
    if (idle_)
        connection_->interrupt();
}

asio::awaitable<error_code> polling_line::serve()
{
    for (;;) {
        const bool speaks = ear_.look();
        std::optional<client_line::question> question;
        if (speaks)
            question = routes_.next(now());
        error_code ec;
        if (question) {
            ec = co_await ask(*question);
            settle_();
        }
        else {
            settle_();  // what was answered without asking, or heard
            const time_point due = speaks ? routes_.wake_at(now()) : ear_.look_again_at();
            if (!speaks && ear_.is_deaf())
                ec = may_not_speak;
            else
                ec = co_await listen_until(due);
        }
        if (ec)
            co_return ec;
    }
}

asio::awaitable<error_code> polling_line::ask(client_line::question question)
{
    const error_code ec = co_await exchange(question);
    if (ec) {
        show_ended(ec != may_not_speak);
        routes_.interrupted(question);
    }
    else if (connection_->deaf())
        co_return asio::error::timed_out;
    if (ec == may_not_speak)  // what is to be done then depends on the line
        co_return error_code{};
    co_return ec;
}

void polling_line::show_begun()
{
    if (ports_.empty() || std::exchange(shown_, true))
        return;
    ports_.show({.sending = true});
    settle_();
}

void polling_line::show_ended(bool failed)
{
    if (ports_.empty())
        return;
    ports_.note(connection_->take_bit_errors());
    shown_ = false;
    ports_.show({.send_failed = failed});
}

void polling_line::reset_channel()
{
    shown_ = false;
    ++resets_;
    if (reading_)
        connection_->interrupt();
}

// Nothing is due. Bytes that come now belong to nobody, but they keep the line busy; an unplugged port is noticed.
asio::awaitable<error_code> polling_line::listen_until(time_point deadline)
{
    idle_ = true;
    const auto size = co_await connection_->read(deadline, asio::buffer(received_));
    idle_ = false;
    if (size) {
        line_free_from_ = std::max(line_free_from_, now() + gap_);
        ear_.heard(bytes(received_).first(*size));
    }
    else if (size.error() != asio::error::timed_out)
        co_return size.error();
    else
        ear_.tell();
    co_return error_code{};
}

void polling_line::note_echo()
{
    if (!std::exchange(echoes_, true))
        log::info("line {}: the adapter returns what it sends, that is left out from now on", config_.name);
}

}  // namespace plcgw
