// The PLC links of a gateway: words that its PLCs send go out by DDS, those of other stations come into their memory.
#pragma once

#include "bridge/dds/plc_link_port.hpp"
#include "bridge/plc_link_exchange.hpp"
#include "daemon/answer_gate.hpp"
#include "daemon/config/config.hpp"
#include "daemon/fp7_ports.hpp"
#include "daemon/read_before.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

#include <functional>

namespace plcgw {

class plc_links {
public:
    // settle: called when words of other stations came into a PLC's memory.
    plc_links(asio::io_context& loop, const gateway_config& config, wall_time started, std::function<void()> settle);

    // The link is what COM.1 of the PLC does, unless something else is that already.
    void add(const plc_link_config& link, plc::simulated_plc& plc, fp7_ports& ports);
    void start();
    void close();                                              // until it opens again, by itself: DDS gets a new domain
    void obey(const line_voice& voice) { gate_.obey(voice); }  // of a pair: only the active member takes part

    const std::vector<plc_link_exchange>& all() const { return links_; }
    bool runs() const { return port_.has_value(); }  // false while DDS does not work

    void memory_changed(const plc::simulated_plc& plc, const plc::change& changed);
    void send();  // what is due now; the rest goes out at its time

private:
    asio::awaitable<void> keep_time();
    asio::awaitable<void> take_part();
    asio::awaitable<void> listen();
    bool open();
    void reset(std::size_t index);
    void receive();
    void log_events();
    time_point wake_at() const;

    asio::io_context& loop_;
    dds_settings settings_;
    plc_link_sender self_;
    std::function<void()> settle_;
    std::vector<plc_link_exchange> links_;
    std::optional<plc_link_port> port_;
    asio::posix::stream_descriptor wakes_;  // the port has something
    asio::steady_timer timer_;
    answer_gate gate_;
    bool failed_ = false;  // to open, and said so
};

}  // namespace plcgw
