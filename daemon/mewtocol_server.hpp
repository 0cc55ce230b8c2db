// A serial line, or one behind a device server, on which we answer MEWTOCOL-COM and MEWTOCOL7-COM: stations of ours,
// each an FP7's port, among the stations of others.
#pragma once

#include "bridge/services/mewtocol_station.hpp"
#include "daemon/answer_gate.hpp"
#include "daemon/fp7_line_ports.hpp"
#include "daemon/line_connection.hpp"
#include "daemon/line_driver.hpp"
#include "protocols/echo_filter.hpp"

#include <array>
#include <functional>

namespace plcgw {

class mewtocol_server final : public line_driver {
public:
    // settle: called after each command, to drain what it changed.
    mewtocol_server(asio::io_context& loop, line_config config, std::vector<mewtocol_station> stations,
                    std::function<void()> settle);

    asio::awaitable<void> run() override;
    void wake() override;
    const port_status& port() const override { return connection_->meter().status(); }
    void obey(line_voice& voice) override { gate_.obey(voice); }  // of a pair: the standby does not answer

    // The channel reset of a station's port: a command half heard and an answer not yet begun are given up.
    void reset(std::size_t station);

    fp7_line_ports& ports() { return ports_; }  // that this line stands for

private:
    asio::awaitable<boost::system::error_code> serve();  // until the port fails
    asio::awaitable<boost::system::error_code> take(mewtocol::reception heard, time_point at);
    asio::awaitable<boost::system::error_code> reply(buffer characters, time_point heard_at);

    line_config config_;
    std::vector<mewtocol_station> stations_;
    std::function<void()> settle_;
    std::unique_ptr<line_connection> connection_;
    echo_filter echo_;
    mewtocol::line_framer in_;
    unsigned resets_ = 0;
    fp7_line_ports ports_;
    asio::steady_timer wait_;
    answer_gate gate_;
    std::array<std::uint8_t, 4096> received_{};
};

// The station of a line's unit. first: of the line; it answers those who name none.
mewtocol_station_options station_options_of(const line_config& line, unsigned number, bool first);

}  // namespace plcgw
