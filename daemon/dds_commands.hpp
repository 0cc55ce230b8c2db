// Requests of DDS clients: executed once each, however often they are repeated, and answered with what became of them.
#pragma once

#include "bridge/dds/command_port.hpp"
#include "daemon/config/config.hpp"
#include "daemon/read_before.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

#include <functional>
#include <optional>

namespace plcgw {

class dds_commands {
public:
    using carry_out = std::function<asio::awaitable<order_outcome>(order)>;

    // is_active: of a pair this member obeys; else it only remembers what it hears. Asked for each request.
    dds_commands(asio::io_context& loop, const dds_config& config, dds_identity who, carry_out how,
                 std::function<bool()> is_active);

    // With the publisher: it lives in the same DDS domain. Once a second, until it works.
    void keep_open();
    void close();

    // This member becomes active: what came until now the other one had to obey, and is only remembered.
    void take_as_standby();

private:
    bool open();
    asio::awaitable<void> listen();
    bool take();  // false: nothing was there
    void take(order_request request);
    asio::awaitable<void> execute(order_key key, order what);
    void reply(const order_key& to, const order_outcome& outcome, wall_time done);

    asio::io_context& loop_;
    dds_config config_;
    dds_identity who_;
    carry_out carry_out_;
    std::function<bool()> is_active_;
    std::optional<command_port> port_;
    asio::posix::stream_descriptor wakes_;
    order_log log_;
    bool failed_ = false;  // and said so
    std::uint64_t said_drops_ = 0;
};

}  // namespace plcgw
