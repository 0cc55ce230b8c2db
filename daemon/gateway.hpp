// Everything that runs, made from a configuration: PLCs, lines, servers and the DDS publisher on one event loop.
#pragma once

#include "bridge/dds/publisher.hpp"
#include "bridge/plc_block.hpp"
#include "daemon/config/read.hpp"
#include "daemon/serial_line.hpp"
#include "daemon/tcp_server.hpp"

#include <memory>

namespace plcgw {

class gateway {
public:
    // The configuration has no mistakes.
    gateway(asio::io_context& loop, const config::loaded& from);
    ~gateway();
    gateway(const gateway&) = delete;
    gateway& operator=(const gateway&) = delete;

    bool start();  // false when a server could not listen: said in the log

private:
    struct running_line {
        running_line(asio::io_context& loop, const line_config& c, std::vector<station> stations, gateway& owner);
        modbus_line routes;
        serial_line driver;
    };
    struct running_block {
        plc_block content;
        bool changed = true;
    };

    void make_plcs();
    void make_lines(asio::io_context& loop);
    void add_routes(std::size_t line_index);
    void make_servers(asio::io_context& loop);
    void make_blocks();
    plc::simulated_plc* find_plc(const std::string& name);

    // The one place where changes are drained, after an exchange on a line or a client's requests.
    void settle(running_line& line);
    void settle_memory();

    void publish_everything();
    void publish_blocks();
    bool open_dds();
    asio::awaitable<void> keep_dds();  // publishes the status, and opens DDS again where it failed
    asio::awaitable<void> keep_watchdog(std::chrono::microseconds period);
    void show_status();

    asio::io_context& loop_;
    gateway_config config_;
    std::string folder_;
    std::string config_hash_;
    wall_time started_;
    std::vector<std::unique_ptr<plc::simulated_plc>> plcs_;
    std::vector<std::unique_ptr<running_line>> lines_;
    std::vector<std::unique_ptr<tcp_server>> servers_;
    std::vector<running_block> blocks_;
    std::optional<dds_publisher> publisher_;
    asio::steady_timer second_;
    asio::steady_timer watchdog_;
    std::string shown_status_;
    bool dds_failed_ = false;
};

}  // namespace plcgw
