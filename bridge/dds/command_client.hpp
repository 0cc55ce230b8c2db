// A client's side of requests by DDS: `plc-gateway write --dds`, and tests.
#pragma once

#include "bridge/dds/error.hpp"
#include "bridge/dds/order_request.hpp"
#include "bridge/dds/settings.hpp"

#include <memory>
#include <vector>

namespace plcgw {

// Create, use and destroy on one thread. Nothing here waits.
class command_client {
public:
    static dds_result<command_client> create(const dds_settings& settings);

    command_client(command_client&&) noexcept;
    command_client& operator=(command_client&&) noexcept;
    ~command_client();

    int descriptor() const;  // readable: call take()

    // Points, registers of routes and messages. The first one may be lost: repeat it, with the same key, until the
    // reply comes. False when it could not be written, for example since it is too long.
    bool send(const order_request& request);
    std::vector<order_reply> take();  // also those to others

private:
    struct state;
    explicit command_client(std::unique_ptr<state> s);
    std::unique_ptr<state> state_;
};

}  // namespace plcgw
