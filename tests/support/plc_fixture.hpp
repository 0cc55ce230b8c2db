// An FX3U without a setup program, and short ways to its devices.
#pragma once

#include "bridge/plc/models/fx3u.hpp"
#include "bridge/routes/route.hpp"

namespace plcgw::test {

inline modbus::request modbus_question(const route& r) { return std::get<modbus::request>(question_of(r)); }

struct fx3u_fixture {
    plc::simulated_plc plc{"main", plc::fx3u, {}};

    fx3u_fixture() { plc.memory().take_changes(); }

    plc::place at(const char* device) const { return plc.memory().find(*plc::parse_device(device)).value(); }
    std::uint16_t word(const char* device) const { return plc.memory().word(at(device)); }
    bool bit(const char* device) const { return plc.memory().bit(at(device)); }
    void set(const char* device, std::uint16_t value) { plc.memory().set_word(at(device), value); }
    void set_bit(const char* device, bool value) { plc.memory().set_bit(at(device), value); }

    route route_to(const char* device, modbus::table table, std::uint16_t first, std::uint16_t count,
                   direction way = direction::read)
    {
        route r;
        r.name = device;
        r.plc = &plc;
        r.at = at(device);
        r.there = modbus_place{table, modbus::address{first}};
        r.count = count;
        r.way = way;
        return r;
    }
};

}  // namespace plcgw::test
