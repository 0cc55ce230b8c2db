// The checks, one function for each list of the configuration.
#pragma once

#include "bridge/plc/memory.hpp"
#include "daemon/config/checks/context.hpp"
#include "daemon/config/checks/occupied.hpp"

#include <map>

namespace plcgw::config {

void check_plcs(check_context& c);
void check_lines(check_context& c);
void check_channel_users(check_context& c);
void check_stations(check_context& c);
void check_servers(check_context& c);
void check_plc_links(check_context& c);
void check_dds(check_context& c);
void check_standby(check_context& c);

// Unit ids of a server and where they lead. list: "/modbus_tcp/0/units".
void check_units(check_context& c, const std::string& list, const std::vector<unit_config>& units);

// An ASCII line or listener for this PLC, which may have RTU only. at: of the key that brings them together.
void check_ascii(check_context& c, const std::string& at, const std::string& plc);

// Where a route's values are in its station. line: of the station, if known.
std::size_t check_station_place(check_context& c, std::size_t i, const route_config& r, const line_config* line);

// A line on which somebody can be asked.
void check_client_line(check_context& c, const std::string& name, const std::string& at);

// Devices that a row takes in the memory of a PLC.
class device_check {
public:
    explicit device_check(check_context& c) : c_(c) {}

    // row: with the keys "plc" and "device". Their place, or nothing and a complaint.
    std::optional<plc::place> place_of(const std::string& row, const std::string& plc, const std::string& device,
                                       std::size_t bits);
    std::optional<plc::place> place_at(const std::string& plc_at, const std::string& device_at, const std::string& plc,
                                       const std::string& device, std::size_t bits);

    // Complains when a place that place_of() found is not for others to fill: a PLC shows its communication there.
    void check_filled(const std::string& device_at, const std::string& plc, plc::place at, std::size_t bits);

private:
    const plc::memory& memory_of(const plc::model& model);

    check_context& c_;
    std::map<const plc::model*, plc::memory> memories_;  // large: one for each model
};

// Who fills devices of the PLCs, and who sends them to stations.
struct device_users {
    occupied_devices filled;
    occupied_devices sent;
};

void check_routes(check_context& c, device_check& devices, device_users& users);

// What a route says beside its way: loss, status and upstream. bits: that it has in memory.
void check_route_options(check_context& c, device_check& devices, device_users& users, std::size_t i,
                         const route_config& r, std::size_t bits);

// Words that show how something does. row: "/stations/0", with "status".
void check_status(check_context& c, device_check& devices, device_users& users, const std::string& row,
                  const std::string& plc, const status_config& s, std::size_t words, std::string who);

// Routes from one PLC to another.
class copy_check {
public:
    copy_check(check_context& c, device_check& devices, device_users& users) : c_(c), devices_(devices), users_(users)
    {
    }

    void add(std::size_t i, const route_config& r);
    void check_circles();  // when all were added

private:
    struct copy {
        std::size_t route;
        std::pair<std::string, std::size_t> from;  // PLC and area
        std::size_t first;
        std::pair<std::string, std::size_t> to;
        std::size_t at;
        std::size_t bits;
    };
    bool shifts(const copy& start, const copy& last, std::size_t origin, std::size_t at, std::size_t bits,
                std::size_t depth);

    check_context& c_;
    device_check& devices_;
    device_users& users_;
    std::vector<copy> copies_;
    std::size_t steps_ = 0;
};

// Points come last: they know who fills their devices.
void check_points(check_context& c, device_check& devices, const device_users& users);

// The messages of general-purpose lines.
void check_messages(check_context& c, device_check& devices, occupied_devices& occupied);

}  // namespace plcgw::config
