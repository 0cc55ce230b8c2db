// Everything that runs, made from a configuration: PLCs, lines and servers on one event loop.
#pragma once

#include "daemon/access_command.hpp"
#include "daemon/blocks.hpp"
#include "daemon/config/read.hpp"
#include "daemon/control_server.hpp"
#include "daemon/dds_commands.hpp"
#include "daemon/dds_link.hpp"
#include "daemon/learned_keeper.hpp"
#include "daemon/message_line.hpp"
#include "daemon/plc_links.hpp"
#include "daemon/plc_program.hpp"
#include "daemon/points.hpp"
#include "daemon/running_line.hpp"
#include "daemon/server_line.hpp"
#include "daemon/standby.hpp"
#include "daemon/statuses.hpp"
#include "daemon/tcp_server.hpp"
#include "daemon/upstream.hpp"
#include "daemon/write_service.hpp"

#include <memory>

namespace plcgw {

class gateway {
public:
    // The configuration has no mistakes.
    gateway(asio::io_context& loop, const config::loaded& from);
    gateway(const gateway&) = delete;
    gateway& operator=(const gateway&) = delete;

    bool start();  // false when a server could not listen: said in the log
    void leave();  // at the end: another member may go on, and what was learned is kept

private:
    void make_plcs(const std::string& folder);
    void make_lines();
    void make_message_line(const line_config& line);
    void make_programs(const std::string& folder);
    void open_com_port(plc::simulated_plc& plc, const channel_config& port);  // of an FP7
    void make_servers();
    void make_blocks();
    void make_copies();
    void make_points();
    void make_plc_links();
    void make_statuses();
    void make_standby();
    void begin_work();
    void end_work();
    bool is_active() const { return !standby_ || standby_->is_active(); }
    plc::simulated_plc* find_plc(const std::string& name);
    running_line* find_line(const std::string& name);
    unit_target target_of(const unit_config& unit);
    bool listen();
    bool listen(tcp_server& server);
    void listen_again();  // after a second, where it failed
    void start_control();

    // The one place where changes are drained, after an exchange on a line or a client's requests.
    void settle(running_line& line);
    void settle(message_line& line);
    void settle_server_line();
    void say(const std::vector<sample>& samples);
    void settle_memory();
    void note_writes();
    bool drain_changes();  // true when there were some

    void publish_everything();
    asio::awaitable<void> every_second();  // status, and DDS again where it failed
    asio::awaitable<void> keep_watchdog(std::chrono::microseconds period);
    void show_status();
    asio::awaitable<nlohmann::json> command(nlohmann::json what);

    asio::io_context& loop_;
    gateway_config config_;
    wall_time started_;
    std::vector<std::unique_ptr<plc::simulated_plc>> plcs_;
    std::vector<std::unique_ptr<running_line>> lines_;
    learned_keeper learned_;
    fp7_ports fp7_ports_;
    std::vector<std::unique_ptr<line_driver>> server_lines_;
    std::vector<std::unique_ptr<message_line>> message_lines_;
    std::vector<std::unique_ptr<plc_program>> programs_;
    std::vector<std::unique_ptr<tcp_server>> servers_;
    plc_copies copies_;
    upstream_watch upstream_;
    through_writes through_;
    std::unique_ptr<plc_links> links_;  // of PLCs; null without any
    dds_link dds_;
    published_blocks blocks_;
    published_points points_;
    published_statuses statuses_;
    std::unique_ptr<standby_member> standby_;  // null: no pair
    write_service writes_;
    access_commands access_;
    dds_commands commands_;
    std::optional<control_server> control_;
    asio::steady_timer second_;
    asio::steady_timer watchdog_;
    std::string shown_status_;
};

}  // namespace plcgw
