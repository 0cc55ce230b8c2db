#include "daemon/serial_server.hpp"

#include "protocols/modbus/rtu.hpp"

namespace plcgw {
namespace {

using boost::system::error_code;
using modbus::bus_event;

std::vector<modbus::unit_id> units_of(const std::vector<modbus_station>& stations)
{
    std::vector<modbus::unit_id> units;
    for (const modbus_station& each : stations)
        units.push_back(each.unit());
    return units;
}

}  // namespace

serial_server::serial_server(asio::io_context& loop, line_config config, std::vector<modbus_station> stations,
                             std::function<void()> settle)
    : config_(std::move(config)), stations_(std::move(stations)), settle_(std::move(settle)),
      connection_(loop, config_), in_(units_of(stations_), config_.silence), gap_(loop)
{
}

asio::awaitable<void> serial_server::run()
{
    for (;;) {
        const bool is_open = co_await connection_.open();
        if (!is_open)
            continue;
        in_ = modbus::rtu_bus_framer(units_of(stations_), config_.silence);
        const error_code ec = co_await serve();
        connection_.close(ec);
    }
}

asio::awaitable<error_code> serial_server::serve()
{
    for (;;) {
        const time_point until = in_.deadline();
        const auto size = co_await read_before(until, connection_.port, connection_.guard, asio::buffer(received_));
        if (size)
            in_.feed(now(), bytes(received_).first(*size));
        else if (size.error() != asio::error::timed_out)
            co_return size.error();
        while (auto event = in_.next(now())) {
            const error_code ec = co_await take(std::move(*event));
            if (ec)
                co_return ec;
        }
        settle_();
    }
}

asio::awaitable<error_code> serial_server::take(bus_event event)
{
    for (modbus_station& each : stations_) {
        if (event.what == bus_event::kind::dropped)
            each.bus_error(event.why);
        else
            each.bus_message();
    }
    if (event.what != bus_event::kind::question)
        co_return error_code{};
    for (modbus_station& each : stations_) {
        std::optional<buffer> pdu = each.answer(event.content);
        if (!pdu)
            continue;
        const error_code ec = co_await reply(each, std::move(*pdu));
        if (ec)
            co_return ec;
    }
    co_return error_code{};
}

// The silence before a frame is counted from the last byte heard.
asio::awaitable<error_code> serial_server::reply(modbus_station& station, buffer pdu)
{
    const duration gap = std::max<duration>(config_.gap, frame_gap(format_of(config_)));
    gap_.expires_at(in_.heard() + gap);
    co_await gap_.async_wait(no_throw);
    const buffer adu = modbus::encode_rtu({station.unit(), std::move(pdu)});
    const error_code ec = co_await connection_.write(adu);
    if (!ec)
        station.sent();
    co_return ec;
}

}  // namespace plcgw
