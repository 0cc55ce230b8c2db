#include "daemon/serial_connection.hpp"

#include "daemon/line_events.hpp"
#include "daemon/log.hpp"
#include "daemon/low_latency.hpp"
#include "daemon/serial_port.hpp"

#include <boost/asio/write.hpp>

#include <algorithm>
#include <unistd.h>

namespace plcgw {
namespace {

using boost::system::error_code;

constexpr milliseconds first_pause{200};
constexpr milliseconds last_pause{2000};
constexpr milliseconds write_slack{1000};
constexpr duration short_life = std::chrono::milliseconds(100);

// A driver without it is no news: ptys and most adapters.
void ask_for_low_latency(const line_config& line, int port)
{
    const latency_report report = set_low_latency(port);
    const latency_text said = describe(report, line.device);
    if (said.to_be_cured || report.outcome == low_latency::refused)
        log::warning("line {}: {}: {}", line.name, line.device, said.text);
    else if (report.outcome == low_latency::set)
        log::info("line {}: {}: {}", line.name, line.device, said.text);
    else
        log::debug("line {}: {}: {}", line.name, line.device, said.text);
}

}  // namespace

serial_connection::serial_connection(asio::io_context& loop, const line_config& line)
    : line_connection(line.name), line_(line), port_(loop), guard_(port_), pause_(loop), next_pause_(first_pause)
{
}

serial_connection::~serial_connection()
{
    if (port_.is_open())
        forget_output(port_.native_handle());
}

asio::awaitable<bool> serial_connection::open()
{
    if (!std::exchange(failed_at_once_, false)) {
        const error_code ec = try_open();
        if (!ec)
            co_return true;
        meter_.lost(wall_now(), line_.device + " cannot be opened: " + ec.message());
        if (ec != last_error_)
            say(line_event::severity::warning, "port.absent", line_.name,
                "line {}: {} cannot be opened ({}): it is tried again until it is there", line_.name, line_.device,
                ec.message());
        last_error_ = ec;
    }
    pause_.expires_after(next_pause_);
    next_pause_ = std::min(2 * next_pause_, last_pause);
    co_await pause_.async_wait(no_throw);
    co_return false;
}

error_code serial_connection::try_open()
{
    std::string warning;
    const auto fd = open_serial_port(line_, warning);
    if (!fd)
        return fd.error();
    error_code ec;
    if (port_.assign(*fd, ec); ec) {
        ::close(*fd);
        return ec;
    }
    opened_at_ = now();
    alive_ = false;
    bit_errors_ = bit_errors_of(*fd).value_or(bit_errors{});
    meter_.opened(wall_now());
    say(line_event::severity::info, "port.open", line_.name, "line {}: {} is open, {} {}{}{}", line_.name, line_.device,
        line_.baud_rate, line_.data_bits,
        line_.check == parity::none  ? 'N'
        : line_.check == parity::odd ? 'O'
                                     : 'E',
        line_.stop_bits);
    if (!warning.empty())
        log::warning("line {}: {}: {}", line_.name, line_.device, warning);
    if (line_.low_latency)
        ask_for_low_latency(line_, *fd);
    return {};
}

bit_errors serial_connection::take_bit_errors()
{
    const bit_errors before = bit_errors_;
    bit_errors_ = bit_errors_of(port_.native_handle()).value_or(before);
    return bit_errors_ - before;
}

void serial_connection::close(const error_code& why)
{
    error_code ignored;
    forget_output(port_.native_handle());
    port_.close(ignored);
    // A half-dead adapter opens and fails at once, again and again: that is a back-off, too, and said once.
    failed_at_once_ = !alive_ && now() - opened_at_ < short_life;
    meter_.lost(wall_now(), line_.device + " was lost: " + why.message());
    if (!failed_at_once_ || last_error_ != why)
        say(line_event::severity::warning, "port.lost", line_.name,
            "line {}: {} was lost ({}): it is reopened when it comes back", line_.name, line_.device, why.message());
    last_error_ = why;
    if (!failed_at_once_)
        next_pause_ = first_pause;
}

void serial_connection::rest()
{
    error_code ignored;
    port_.close(ignored);
    log::info("line {}: {} is closed: the other member of the pair answers", line_.name, line_.device);
}

asio::awaitable<error_code> serial_connection::write(bytes adu)
{
    guard_.arm(now() + character_time(format_of(line_), adu.size()) + write_slack);
    const auto [ec, size] = co_await asio::async_write(port_, asio::buffer(adu.data(), adu.size()), no_throw);
    const bool cut_short = guard_.disarm();
    meter_.sent(size);
    if (ec == asio::error::operation_aborted && cut_short)
        co_return error_code(asio::error::timed_out);
    co_return ec;
}

asio::awaitable<boost::system::result<std::size_t>> serial_connection::read(time_point deadline,
                                                                            asio::mutable_buffer into)
{
    const auto size = co_await read_before(deadline, port_, guard_, into);
    alive_ = alive_ || size.has_value();
    if (size)
        meter_.received(*size);
    co_return size;
}

std::optional<std::uint64_t> serial_connection::overruns()
{
    return port_.is_open() ? overruns_of(port_.native_handle()) : std::nullopt;
}

}  // namespace plcgw
