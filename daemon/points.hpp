// The points of a gateway: fed with what changed, published as DDS points.
#pragma once

#include "bridge/points/point_table.hpp"
#include "bridge/routes/plc_copies.hpp"
#include "daemon/blocks.hpp"

#include <boost/asio/io_context.hpp>

namespace plcgw {

class published_points {
public:
    published_points(boost::asio::io_context& loop, dds_link& dds) : loop_(loop), dds_(dds) {}

    // Who fills devices, before the points.
    void add_sources(const client_line& line);
    void add_sources(const messages::line_messages& line);
    void add_sources(const plc_copies& copies);
    void add(const point_config& from, plc::simulated_plc& plc);

    void start();
    void memory_changed(const plc::simulated_plc& plc, const plc::change& changed);
    void say(const std::vector<sample>& samples);  // of the sources: their quality or time may be new
    void say_everything();
    void keep_silences();
    void publish();  // what is news; a part at a time, so that the lines do not wait

    point_table& table() { return table_; }

private:
    boost::asio::io_context& loop_;
    dds_link& dds_;
    point_table table_;
    bool posted_ = false;
};

}  // namespace plcgw
