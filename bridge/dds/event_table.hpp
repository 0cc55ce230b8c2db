// What is known from all events so far, as the lines of a table. Old values must not look fresh: what is not good, or
// has no living writer, is marked.
#pragma once

#include "bridge/dds/event.hpp"

#include <cstddef>
#include <deque>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace plcgw {

enum class line_style : std::uint8_t { plain, heading, warning, error, old };

struct table_line {
    line_style style{};
    std::string text;
    bool operator==(const table_line&) const = default;
};

class event_table {
public:
    // now: when the event came. True if more than times and counters changed.
    bool apply(const dds_event& event, wall_time now);

    // At most height lines of at most width characters.
    std::vector<table_line> lines(wall_time now, std::size_t width, std::size_t height) const;

private:
    enum class writer : std::uint8_t { alive, lost };

    struct member_row {
        received_status last;
        wall_time heard{};
        writer state{};
    };
    struct block_row {
        received_block last;
        writer state{};
    };
    struct point_row {
        received_point last;
        writer state{};
    };

    template <class Status>
    struct status_row {
        Status last;
        writer state{};
    };

    bool apply_one(const received_block& e, wall_time now);
    bool apply_one(const received_point& e, wall_time now);
    bool apply_one(const received_port& e, wall_time now);
    bool apply_one(const received_device& e, wall_time now);
    bool apply_one(const received_event& e, wall_time now);
    bool apply_one(const gone_port& e, wall_time now);
    bool apply_one(const gone_device& e, wall_time now);
    bool apply_one(const gone_point& e, wall_time now);
    bool apply_one(const received_status& e, wall_time now);
    bool apply_one(const received_message& e, wall_time now);
    bool apply_one(const gone_block& e, wall_time now);
    bool apply_one(const gone_gateway& e, wall_time now);
    void port_lines(const std::string& gateway, wall_time now, std::vector<table_line>& out) const;
    void device_lines(const std::string& gateway, wall_time now, std::vector<table_line>& out) const;
    void event_lines(const std::string& gateway, std::vector<table_line>& out) const;
    void point_lines(const std::string& gateway, wall_time now, std::vector<table_line>& out) const;
    void message_lines(const std::string& gateway, wall_time now, std::vector<table_line>& out) const;
    void gateway_lines(const std::string& gateway, wall_time now, std::vector<table_line>& out) const;

    using member_key = std::tuple<std::string, std::string>;                             // gateway, member
    using block_key = std::tuple<std::string, std::string, std::string, std::uint32_t>;  // gateway, route, area, first
    using message_key = std::tuple<std::string, std::string, message_direction, std::string>;  // gateway, line, name
    std::map<member_key, member_row> members_;
    std::map<block_key, block_row> blocks_;
    using name_key = std::pair<std::string, std::string>;  // gateway, name
    std::map<name_key, point_row> points_;
    std::map<name_key, status_row<received_port>> ports_;
    std::map<name_key, status_row<received_device>> devices_;
    std::deque<received_event> events_;                 // the last few of all gateways
    std::map<message_key, received_message> messages_;  // the last one each
};

}  // namespace plcgw
