// The publisher of a gateway, created again for as long as that fails: a network interface may come later, or come back
// with another address.
#pragma once

#include "bridge/dds/publisher.hpp"
#include "bridge/link_status.hpp"
#include "daemon/address_watch.hpp"
#include "daemon/config/config.hpp"

#include <boost/asio/io_context.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace plcgw {

class dds_link {
public:
    dds_link(boost::asio::io_context& loop, const gateway_config& config, std::string config_hash);
    ~dds_link();
    dds_link(const dds_link&) = delete;
    dds_link& operator=(const dds_link&) = delete;

    // Each second. True when it opened just now: everything has to be published. Nothing happens while DDS is switched
    // off.
    bool open();

    // Who else has something in the domain. A domain that hears nobody any more is made anew: it ends with its last
    // user, so each closes what it has when it is called, and opens it again later: when open() returns true, or when
    // it tries on its own.
    void add_part(std::function<void()> close) { parts_.push_back(std::move(close)); }

    bool is_open() const { return publisher_.has_value(); }
    const port_status& port() const { return port_; }  // "dds": what was published and dropped

    template <class... What>
    void publish(const What&... what)
    {
        if (publisher_)
            publisher_->publish(what...);
    }

private:
    void close();
    std::string watched_interface() const;
    void look_at_addresses();
    void look_at_publisher();
    void show(link_state state, std::string detail);

    dds_settings settings_;
    dds_identity identity_;
    std::optional<dds_publisher> publisher_;
    std::vector<std::function<void()>> parts_;
    address_watch addresses_;
    port_status port_;
    std::uint64_t published_before_ = 0;  // by publishers that were closed
    std::uint64_t drops_before_ = 0;
    std::uint64_t drops_said_ = 0;
    unsigned seconds_since_drops_ = 0;
    bool was_open_ = false;
    bool failed_ = false;  // and said so
};

}  // namespace plcgw
