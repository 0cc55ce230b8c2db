// A serial line, RTU or ASCII, on which we are server: stations of ours, each with its PLC, among the stations of
// others.
#pragma once

#include "bridge/services/modbus_station.hpp"
#include "daemon/answer_gate.hpp"
#include "daemon/fp7_line_ports.hpp"
#include "daemon/line_connection.hpp"
#include "daemon/line_driver.hpp"
#include "daemon/serial_forwarder.hpp"
#include "protocols/echo_filter.hpp"
#include "protocols/modbus/bus_framer.hpp"

#include <array>
#include <functional>

namespace plcgw {

class serial_server final : public line_driver {
public:
    // others: units that lead to other lines. settle: called after each request, to drain what it changed.
    serial_server(asio::io_context& loop, line_config config, std::vector<modbus_station> stations,
                  serial_forwarder others, std::function<void()> settle);

    asio::awaitable<void> run() override;
    void wake() override;
    const port_status& port() const override { return connection_->meter().status(); }
    void obey(line_voice& voice) override { gate_.obey(voice); }  // of a pair: the standby does not answer

    // The channel reset of an FP7's port: a request half heard and a reply not yet begun are given up.
    void reset();

    fp7_line_ports& ports() { return ports_; }  // that this line stands for

private:
    modbus::bus_framer make_framer() const;
    asio::awaitable<boost::system::error_code> serve();  // until the port fails
    asio::awaitable<boost::system::error_code> take(modbus::bus_event event);
    asio::awaitable<boost::system::error_code> reply(modbus_station& station, buffer pdu);
    asio::awaitable<boost::system::error_code> reply_forwarded(modbus::frame answer);
    asio::awaitable<boost::system::error_code> send(modbus::frame content, std::uint8_t delimiter);
    std::vector<modbus::unit_id> units() const;
    buffer delimiters();

    line_config config_;
    asio::any_io_executor executor_;
    std::vector<modbus_station> stations_;
    serial_forwarder others_;
    time_point forwarded_heard_{};  // the last byte of the request that is forwarded
    std::function<void()> settle_;
    std::unique_ptr<line_connection> connection_;
    echo_filter echo_;
    modbus::bus_framer in_;
    unsigned resets_ = 0;
    fp7_line_ports ports_;
    asio::steady_timer gap_;
    answer_gate gate_;
    std::array<std::uint8_t, 1024> received_{};
};

}  // namespace plcgw
