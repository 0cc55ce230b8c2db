// Carries out what somebody wants written, and says what became of it: for DDS and for the control socket alike.
#pragma once

#include "bridge/orders/order_targets.hpp"
#include "daemon/blocks.hpp"
#include "daemon/plc_command.hpp"
#include "daemon/points.hpp"
#include "daemon/through_writes.hpp"

namespace plcgw {

// Whose order it is: what the configuration has to allow for DDS clients, whoever may use the control socket may do.
enum class order_origin : std::uint8_t { dds, local };

class write_service {
public:
    struct parts {
        const gateway_config& config;
        const plc_list& plcs;
        const std::vector<std::unique_ptr<running_line>>& lines;
        const std::vector<std::unique_ptr<message_line>>& messages;
        const published_blocks& blocks;
        published_points& points;
        through_writes& through;
    };

    // settle: called when memory was written, to drain what changed.
    write_service(asio::any_io_executor executor, const parts& of, std::function<void()> settle)
        : executor_(std::move(executor)), of_(of), settle_(std::move(settle))
    {
    }

    // Ends when the outcome is known; an order that did not begin in time had no effect.
    asio::awaitable<order_outcome> carry_out(order what, order_origin from);

    void deliver(message_line& line);  // what became of ordered messages by now

private:
    struct sending {
        explicit sending(const asio::any_io_executor& executor) : done(executor) {}
        asio::steady_timer done;
        std::optional<client_line::through_outcome> outcome;
    };

    found_span find(const route_order& o, order_origin from) const;
    found_span find(const device_order& o) const;
    boost::system::result<memory_write, order_outcome> write_memory(const order_content& what, order_origin from);
    boost::system::result<memory_write, order_outcome> write_point(const point_order& o);
    asio::awaitable<order_outcome> await_stations(memory_write written, time_point begin_by);
    asio::awaitable<order_outcome> ask_station(station_order o, time_point begin_by);
    asio::awaitable<order_outcome> send(message_order o, time_point begin_by, order_origin from);
    std::string overwriting(const write_span& span) const;

    asio::any_io_executor executor_;
    parts of_;
    std::function<void()> settle_;
    std::map<std::pair<const message_line*, std::uint64_t>, std::shared_ptr<sending>> sendings_;
};

}  // namespace plcgw
