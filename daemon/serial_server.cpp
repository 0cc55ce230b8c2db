#include "daemon/serial_server.hpp"

namespace plcgw {
namespace {

using boost::system::error_code;
using modbus::bus_event;

}  // namespace

serial_server::serial_server(asio::io_context& loop, line_config config, std::vector<modbus_station> stations,
                             serial_forwarder others, std::function<void()> settle)
    : config_(std::move(config)), executor_(loop.get_executor()), stations_(std::move(stations)),
      others_(std::move(others)), settle_(std::move(settle)), connection_(make_connection(loop, config_)),
      echo_(config_.echo), in_(make_framer()), gap_(loop), gate_(loop)
{
}

std::vector<modbus::unit_id> serial_server::units() const
{
    std::vector<modbus::unit_id> all = others_.units();
    for (const modbus_station& each : stations_)
        all.push_back(each.unit());
    return all;
}

// Each station has its own, which its client may change; frames are told apart by all of them.
buffer serial_server::delimiters()
{
    buffer all;
    for (modbus_station& each : stations_)
        all.push_back(each.delimiter());
    if (!others_.empty())
        all.push_back(modbus::ascii_delimiter);
    return all;
}

modbus::bus_framer serial_server::make_framer() const { return {framing_of(config_), units(), silence_of(config_)}; }

void serial_server::reset()
{
    in_ = make_framer();
    others_.give_up();
    ++resets_;
}

asio::awaitable<void> serial_server::run()
{
    for (;;) {
        co_await gate_.wait();
        const bool is_open = co_await connection_->open();
        if (!is_open) {
            for (modbus_station& each : stations_)
                each.port_absent();
            settle_();
            continue;
        }
        in_ = make_framer();
        echo_ = echo_filter(config_.echo);
        settle_();
        const error_code ec = co_await serve();
        others_.give_up();
        if (ec == not_active)
            connection_->rest();
        else
            connection_->close(ec);
        settle_();
    }
}

void serial_server::wake()
{
    gate_.wake();
    if (!gate_.is_open())
        connection_->interrupt();
}

asio::awaitable<error_code> serial_server::serve()
{
    for (;;) {
        if (!gate_.is_open())
            co_return not_active;
        if (auto answer = others_.take_answer()) {
            const error_code ec = co_await reply_forwarded(std::move(*answer));
            if (ec)
                co_return ec;
        }
        const time_point until = in_.deadline();
        const auto size = co_await connection_->read(until, asio::buffer(received_));
        if (size)
            in_.feed(now(), echo_.feed(now(), bytes(received_).first(*size)));
        else if (size.error() != asio::error::timed_out)
            co_return size.error();
        for (;;) {
            in_.set_delimiters(delimiters());
            auto event = in_.next(now());
            if (!event)
                break;
            const error_code ec = co_await take(std::move(*event));
            if (ec)
                co_return ec;
        }
        settle_();
    }
}

asio::awaitable<error_code> serial_server::take(bus_event event)
{
    others_.give_up();  // whatever it is: the client does not wait any more
    if (event.what == bus_event::kind::dropped)
        connection_->meter().fault(event.why);
    else
        connection_->meter().frames_received();
    const bool ascii = framing_of(config_) == modbus::framing::ascii;
    const auto is_end_of_frame = [&](modbus_station& at) { return !ascii || at.delimiter() == in_.delimiter(); };
    const bit_errors wrong = connection_->take_bit_errors();
    const bool bits_wrong = wrong.sum() > 0;
    ports_.note(wrong);
    for (modbus_station& each : stations_) {
        if (event.what == bus_event::kind::dropped && bits_wrong)
            each.bit_error();
        else if (event.what == bus_event::kind::dropped)
            each.bus_error(event.why);
        else if (is_end_of_frame(each))
            each.bus_message();
        else
            each.bus_error(errc::bad_character);
    }
    if (event.what != bus_event::kind::question)
        co_return error_code{};
    for (modbus_station& each : stations_) {
        if (!is_end_of_frame(each))
            continue;
        std::optional<buffer> pdu = each.answer(event.content);
        if (!pdu)
            continue;
        const error_code ec = co_await reply(each, std::move(*pdu));
        if (ec)
            co_return ec;
    }
    if (!ascii || in_.delimiter() == modbus::ascii_delimiter) {
        forwarded_heard_ = in_.heard();
        others_.ask(executor_, event.content, [this] { connection_->interrupt(); });
    }
    co_return error_code{};
}

asio::awaitable<error_code> serial_server::reply(modbus_station& station, buffer pdu)
{
    const unsigned resets = resets_;
    modbus::frame content{station.unit(), std::move(pdu)};
    const error_code ec = co_await send(std::move(content), station.delimiter());
    if (!ec && resets == resets_)
        station.sent();
    co_return ec;
}

// The client has begun to say something else meanwhile: it would take this answer for another.
asio::awaitable<error_code> serial_server::reply_forwarded(modbus::frame answer)
{
    if (in_.heard() != forwarded_heard_)
        co_return error_code{};
    const error_code ec = co_await send(std::move(answer), modbus::ascii_delimiter);
    co_return ec;
}

// The silence before a frame is counted from the last byte heard.
asio::awaitable<error_code> serial_server::send(modbus::frame content, std::uint8_t delimiter)
{
    const duration gap = std::max<duration>(config_.gap, frame_gap(format_of(config_)));
    const unsigned resets = resets_;
    gap_.expires_at(in_.heard() + gap);
    co_await gap_.async_wait(no_throw);
    if (resets != resets_)
        co_return error_code{};
    if (!gate_.is_open())
        co_return not_active;
    const bool like_request = modbus::parse_request(content.pdu).has_value();
    const buffer adu = modbus::encode_adu(framing_of(config_), content, delimiter);
    echo_.sent(adu, like_request, now() + echo_time(config_, adu.size()));
    const error_code ec = co_await connection_->write(adu);
    connection_->meter().frames_sent();
    co_return ec;
}

}  // namespace plcgw
