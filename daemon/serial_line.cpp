#include "daemon/serial_line.hpp"

#include "daemon/log.hpp"

#include <boost/asio/write.hpp>

#include <algorithm>

namespace plcgw {
namespace {

using boost::system::error_code;

constexpr milliseconds first_reopen{200};
constexpr milliseconds last_reopen{2000};
constexpr milliseconds write_slack{1000};  // beyond the time on the wire: a driver that takes longer hangs

character_format format_of(const line_config& c) { return {c.baud_rate, c.data_bits, c.check, c.stop_bits}; }

}  // namespace

serial_line::serial_line(asio::io_context& loop, line_config config, modbus_line& routes, std::function<void()> settle)
    : config_(std::move(config)), routes_(routes), settle_(std::move(settle)), port_(loop), guard_(port_),
      reopen_(loop), gap_(std::max<duration>(config_.gap, frame_gap(format_of(config_))))
{
}

asio::awaitable<void> serial_line::run()
{
    routes_.start(now());
    for (;;) {
        co_await wait_for_port();
        const error_code ec = co_await serve();
        error_code ignored;
        port_.close(ignored);
        absent_ = true;
        log::warning("line {}: {} was lost ({}): it is reopened when it comes back", config_.name, config_.device,
                     ec.message());
        routes_.port_lost("port lost");
        settle_();
    }
}

asio::awaitable<void> serial_line::wait_for_port()
{
    milliseconds pause = first_reopen;
    for (;;) {
        const error_code ec = open();
        if (!ec)
            co_return;
        if (!std::exchange(absent_, true)) {
            log::warning("line {}: {} cannot be opened ({}): it is tried again until it is there", config_.name,
                         config_.device, ec.message());
            routes_.port_lost("port absent");
            settle_();
        }
        reopen_.expires_after(pause);
        co_await reopen_.async_wait(no_throw);
        pause = std::min(2 * pause, last_reopen);
    }
}

error_code serial_line::open()
{
    std::string warning;
    const auto fd = open_serial_port(config_, warning);
    if (!fd)
        return fd.error();
    error_code ec;
    if (port_.assign(*fd, ec); ec)
        return ec;
    absent_ = false;
    line_free_from_ = now() + gap_;
    log::info("line {}: {} is open, {} {}{}{}", config_.name, config_.device, config_.baud_rate, config_.data_bits,
              config_.check == parity::none  ? 'N'
              : config_.check == parity::odd ? 'O'
                                             : 'E',
              config_.stop_bits);
    if (!warning.empty())
        log::warning("line {}: {}: {}", config_.name, config_.device, warning);
    return {};
}

void serial_line::wake()
{
    if (idle_)
        guard_.interrupt();
}

asio::awaitable<error_code> serial_line::serve()
{
    for (;;) {
        std::optional<modbus_line::question> question = routes_.next(now());
        error_code ec;
        if (question) {
            ec = co_await exchange(std::move(*question));
        }
        else {
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
    const auto size = co_await read_before(deadline, port_, guard_, asio::buffer(received_));
    idle_ = false;
    if (size)
        line_free_from_ = std::max(line_free_from_, now() + gap_);
    else if (size.error() != asio::error::timed_out)
        co_return size.error();
    co_return error_code{};
}

asio::awaitable<error_code> serial_line::exchange(modbus_line::question question)
{
    modbus::rtu_transaction transaction(question.unit, question.request, question.timing, line_free_from_, now());
    for (;;) {
        const auto action = transaction.next(now());
        if (std::holds_alternative<modbus::rtu_transaction::done>(action))
            break;
        error_code ec;
        if (const auto* to_send = std::get_if<modbus::rtu_transaction::send>(&action)) {
            const time_point started = now();
            ec = co_await send(to_send->adu);
            transaction.sent(started);
        }
        else {
            const time_point until = std::get<modbus::rtu_transaction::wait>(action).until;
            const auto size = co_await read_before(until, port_, guard_, asio::buffer(received_));
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
    const unanswered_requests late{transaction.unanswered(), transaction.unanswered_since()};
    if (const auto& outcome = transaction.outcome())
        routes_.answered(question, *outcome, now(), wall_now(), late);
    else
        routes_.failed(question, outcome.error(), now(), late);
    settle_();
    co_return error_code{};
}

asio::awaitable<error_code> serial_line::send(bytes adu)
{
    guard_.arm(now() + character_time(format_of(config_), adu.size()) + write_slack);
    const auto [ec, size] = co_await asio::async_write(port_, asio::buffer(adu.data(), adu.size()), no_throw);
    const bool cut_short = guard_.disarm();
    if (ec == asio::error::operation_aborted && cut_short)
        co_return error_code(asio::error::timed_out);
    co_return ec;
}

}  // namespace plcgw
