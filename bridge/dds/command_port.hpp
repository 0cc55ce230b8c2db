// A gateway's side of requests by DDS: what clients want written, and what they are told.
#pragma once

#include "bridge/dds/error.hpp"
#include "bridge/dds/gateway_status.hpp"
#include "bridge/dds/order_request.hpp"
#include "bridge/dds/settings.hpp"

#include <memory>
#include <variant>
#include <vector>

namespace plcgw {

// A request, or what another member of the same gateway replied to one.
using command_news = std::variant<order_request, order_reply>;

// Create, use and destroy on one thread. Nothing here waits.
class command_port {
public:
    static dds_result<command_port> create(const dds_settings& settings, dds_identity who);

    command_port(command_port&&) noexcept;
    command_port& operator=(command_port&&) noexcept;
    ~command_port();

    int descriptor() const;  // readable: call take()

    // Those to this gateway's name since the last call; at most some 64 of each kind, and the descriptor stays readable
    // when there are more.
    std::vector<command_news> take();

    void reply(const order_key& to, const order_outcome& outcome, wall_time done);
    std::uint64_t drops() const;  // replies that could not be written

private:
    struct state;
    explicit command_port(std::unique_ptr<state> s);
    std::unique_ptr<state> state_;
};

}  // namespace plcgw
