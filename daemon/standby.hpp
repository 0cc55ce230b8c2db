// A gateway as one of two members: says and hears beats, gives its lines their voices, keeps the other one's memory
// warm.
#pragma once

#include "bridge/standby/pair.hpp"
#include "daemon/dds_link.hpp"
#include "daemon/pair_mirror.hpp"

#include <boost/asio/posix/stream_descriptor.hpp>
#include <nlohmann/json_fwd.hpp>

#include <deque>

namespace plcgw {

class standby_member {
public:
    struct work {
        std::function<void()> prepare;  // this member becomes active now
        std::function<void()> begin;    // this member is active now
        std::function<void()> repeat;   // what was published, to subscribers who may not have heard it
        std::function<void()> end;      // it is not any more
        std::function<void()> settle;   // memory has changed
    };

    // The lines are told to obey. The configuration has a pair.
    standby_member(asio::io_context& loop, const gateway_config& config, wall_time started,
                   const std::vector<std::unique_ptr<plc::simulated_plc>>& plcs, const pair_mirror::line_list& lines,
                   dds_link& dds, work does);

    void start();
    void leave();      // the other member may begin at once
    void renew_dds();  // its domain is made anew: an address has changed

    // Of everything that answers and publishes: ends by itself when this process stands still.
    line_voice& answers() { return answers_; }
    bool is_active() const { return answers_.may_speak(now()); }
    bool speaks_on(std::size_t line) const { return voices_[line].may_speak(now()); }
    gateway_role role() const { return is_active() ? gateway_role::active : gateway_role::standby; }
    std::int32_t strength() const { return is_active() ? strength_ : 0; }

    void memory_changed(const plc::simulated_plc& plc, const plc::change& changed);
    void settled(const running_line& line);        // after an exchange
    void say(const std::vector<sample>& samples);  // that go to subscribers: the other member is told first
    void publish();                                // what is new

    nlohmann::json report() const;
    std::optional<std::string> switch_over();

private:
    asio::awaitable<void> keep_time();
    asio::awaitable<void> listen(int descriptor);
    void open();
    void receive();
    void heard(const pair_beat& beat);
    void look();
    void say_beat();
    void obey_roles();
    void repeat();
    void log_events();

    asio::io_context& loop_;
    const gateway_config& config_;
    pair_identity self_;
    const pair_mirror::line_list& lines_;
    dds_link& dds_;
    work work_;
    standby_pair pair_;
    pair_mirror mirror_;
    std::deque<line_voice> voices_;  // of the client lines; their addresses stay
    line_voice answers_;
    bool works_ = false;
    std::int32_t strength_ = 0;
    std::deque<time_point> repeat_at_;
    std::optional<pair_port> port_;
    asio::posix::stream_descriptor wakes_;  // the port has something
    asio::steady_timer timer_;
    time_point open_again_{};
    time_point published_at_{};
    bool publish_soon_ = false;
    asio::steady_timer soon_;
    bool failed_ = false;  // to open, and said so
    std::string said_misfit_;
    bool said_namesake_ = false;
};

}  // namespace plcgw
