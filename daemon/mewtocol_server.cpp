#include "daemon/mewtocol_server.hpp"

namespace plcgw {
namespace {

using boost::system::error_code;

// No silence between the characters of a frame is defined: this ends one whose CR was lost.
constexpr duration longest_pause = std::chrono::seconds(1);

}  // namespace

mewtocol_server::mewtocol_server(asio::io_context& loop, line_config config, std::vector<mewtocol_station> stations,
                                 std::function<void()> settle)
    : config_(std::move(config)), stations_(std::move(stations)), settle_(std::move(settle)),
      connection_(make_connection(loop, config_)), echo_(config_.echo), in_(longest_pause), wait_(loop), gate_(loop)
{
}

void mewtocol_server::reset(std::size_t station)
{
    stations_.at(station).reset();
    in_ = mewtocol::line_framer(longest_pause);
    ++resets_;
}

asio::awaitable<void> mewtocol_server::run()
{
    for (;;) {
        co_await gate_.wait();
        const bool is_open = co_await connection_->open();
        settle_();
        if (!is_open)
            continue;
        in_ = mewtocol::line_framer(longest_pause);
        echo_ = echo_filter(config_.echo);
        const error_code ec = co_await serve();
        if (ec == not_active)
            connection_->rest();
        else
            connection_->close(ec);
        settle_();
    }
}

void mewtocol_server::wake()
{
    gate_.wake();
    if (!gate_.is_open())
        connection_->interrupt();
}

asio::awaitable<error_code> mewtocol_server::serve()
{
    for (;;) {
        if (!gate_.is_open())
            co_return not_active;
        const time_point until = in_.deadline();
        const auto size = co_await connection_->read(until, asio::buffer(received_));
        const time_point at = now();
        if (size)
            in_.feed(at, echo_.feed(at, bytes(received_).first(*size)));
        else if (size.error() != asio::error::timed_out)
            co_return size.error();
        for (;;) {
            auto heard = in_.next(now());
            if (!heard)
                break;
            const error_code ec = co_await take(std::move(*heard), at);
            if (ec)
                co_return ec;
        }
        ports_.note(connection_->take_bit_errors());
        settle_();
    }
}

asio::awaitable<error_code> mewtocol_server::take(mewtocol::reception heard, time_point at)
{
    if (is_frame(heard))
        connection_->meter().frames_received();
    else
        connection_->meter().fault(heard.why);
    for (std::size_t i = 0; i < stations_.size(); ++i) {
        std::optional<buffer> characters = stations_[i].hear(now(), heard);
        if (!characters)
            continue;
        const error_code ec = co_await reply(std::move(*characters), at);
        if (ec)
            co_return ec;
    }
    co_return error_code{};
}

asio::awaitable<error_code> mewtocol_server::reply(buffer characters, time_point heard_at)
{
    const unsigned resets = resets_;
    if (config_.gap > duration{}) {
        wait_.expires_at(heard_at + config_.gap);
        co_await wait_.async_wait(no_throw);
        if (resets != resets_)
            co_return error_code{};
    }
    if (!gate_.is_open())
        co_return not_active;
    echo_.sent(characters, is_like_request(characters), now() + echo_time(config_, characters.size()));
    const error_code ec = co_await connection_->write(characters);
    connection_->meter().frames_sent();
    co_return ec;
}

mewtocol_station_options station_options_of(const line_config& line, unsigned number, bool first)
{
    const mewtocol_config& c = line.mewtocol;
    const bool all = c.commands == mewtocol_commands::all;
    return {.number = number,
            .answers_any = first,
            .offered = all ? mewtocol::all_commands : mewtocol::fp7_commands,
            .expansion = c.expansion,
            .several_frames = c.several_frames,
            .rest_kept = c.rest_kept,
            .max_contacts = c.max_contacts,
            .max_words = c.max_words,
            .dialect = c.dialect};
}

}  // namespace plcgw
