// Stations of a PLC link, each with an FP7, and what passes between them without any DDS.
#pragma once

#include "bridge/plc/models/fp7.hpp"
#include "bridge/plc_link_exchange.hpp"
#include "tests/support/virtual_time.hpp"

#include <string>

namespace plcgw::test {

inline plc_link_sender process(const std::string& gateway, std::int64_t started = 1)
{
    return {gateway, "host", wall_time{started}};
}

// Sends WL and LD from `first` on, `count` words of each.
inline plc_link_station sends(unsigned station, unsigned first, unsigned count)
{
    return {station, {.relay_first = first, .relay_count = count, .register_first = first, .register_count = count}};
}

struct linked_plc {
    plc::simulated_plc plc;
    plc_link_exchange link;

    linked_plc(const std::string& name, const plc_link_station& own, const std::string& link_name = "cell")
        : plc(name, plc::fp7, {}), link(link_name, plc, own, process(name))
    {
        plc.memory().take_changes();
    }

    plc::place at(const char* device) const
    {
        return plc.memory().find(plc::parse_device(device, plc::fp7.names).value()).value();
    }
    std::uint16_t word(const char* device) const { return plc.memory().word(at(device)); }
    bool bit(const char* device) const { return plc.memory().bit(at(device)); }
    void set(const char* device, std::uint16_t value) { plc.memory().set_word(at(device), value); }
    void set_bit(const char* device, bool value) { plc.memory().set_bit(at(device), value); }

    // As the gateway does it. True when the link has to send.
    bool settle()
    {
        bool any = false;
        for (const plc::change& each : plc.memory().take_changes())
            any = link.memory_changed(plc, each) || any;
        return any;
    }

    std::optional<plc_link_area> next(time_point now) { return link.next(now, wall_time{7}); }

    std::string said()
    {
        std::string text;
        for (const plc_link_event& each : link.take_events())
            text.append(text.empty() ? "" : "\n")
                .append(each.level == plc_link_event::severity::warning ? "warning: " : "")
                .append(each.text);
        return text;
    }
};

// What station `from` with these words says.
inline plc_link_area area(const plc_link_sender& from, const plc_link_station& station, std::uint16_t value = 0)
{
    plc_link_area made{"cell", from, station, 1, wall_time{7}, {}, {}};
    made.relays.assign(station.settings.relay_count, value);
    made.registers.assign(station.settings.register_count, value);
    return made;
}

}  // namespace plcgw::test
