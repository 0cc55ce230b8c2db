// Receives what gateways publish, for `plc-gateway watch` and the tests.
#pragma once

#include "bridge/dds/error.hpp"
#include "bridge/dds/event.hpp"
#include "bridge/dds/settings.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace plcgw {

class dds_subscriber {
public:
    static dds_result<dds_subscriber> create(const dds_settings& settings);

    dds_subscriber(dds_subscriber&&) noexcept;
    dds_subscriber& operator=(dds_subscriber&&) noexcept;
    ~dds_subscriber();

    int descriptor() const;  // readable: call take()

    // Never waits. What is left beyond about this many events keeps the descriptor readable. Between two calls only the
    // latest sample of each register block is kept.
    std::vector<dds_event> take(std::size_t most = 1000);

private:
    struct state;
    explicit dds_subscriber(std::unique_ptr<state> s);
    std::unique_ptr<state> state_;
};

}  // namespace plcgw
