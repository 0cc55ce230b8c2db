#include "daemon/watch_filter.hpp"

#include <doctest/doctest.h>

using namespace plcgw;

namespace {

received_block block(const char* gateway, const char* name, const char* area, std::uint32_t first, std::uint32_t count)
{
    received_block e;
    e.gateway = gateway;
    e.value.route = name;
    e.value.area = area;
    e.value.first = first;
    e.value.count = count;
    return e;
}

received_device device(const char* gateway, const char* name)
{
    received_device e;
    e.gateway = gateway;
    e.status.device = name;
    return e;
}

}  // namespace

TEST_CASE("watch filter: by gateway, name and topic")
{
    const dds_event pump = block("north", "pump.speed", "holding", 0, 2);
    const dds_event state = device("north", "pump");
    const dds_event status = received_status{{"north", "m", "", ""}, {}, 1};
    watch_filter all;
    CHECK(fits(all, pump));
    CHECK(fits(all, state));

    watch_filter names;
    names.names = {"pump.", "valve"};
    CHECK(fits(names, pump));
    CHECK_FALSE(fits(names, state));
    CHECK(fits(names, status));

    watch_filter south;
    south.gateways = {"south"};
    CHECK_FALSE(fits(south, pump));
    CHECK_FALSE(fits(south, status));
    CHECK(fits(south, device("south", "x")));

    watch_filter devices;
    devices.topics = {dds_topic::device_status};
    CHECK(fits(devices, state));
    CHECK(fits(devices, gone_device{"north", "pump", gone_reason::disposed}));
    CHECK_FALSE(fits(devices, pump));
    CHECK_FALSE(fits(devices, status));

    CHECK(is_counted(all, pump));
    CHECK_FALSE(is_counted(all, state));
    CHECK(is_counted(devices, state));
    CHECK_FALSE(is_counted(devices, gone_device{"north", "pump", gone_reason::disposed}));
}

TEST_CASE("watch filter: blocks and points over a device")
{
    watch_filter d100;
    d100.by_device = true;
    d100.area = "D";
    d100.number = 100;
    CHECK(fits(d100, block("g", "main.D90", "D", 90, 11)));
    CHECK_FALSE(fits(d100, block("g", "main.D90", "D", 90, 10)));
    CHECK_FALSE(fits(d100, block("g", "main.M0", "M", 0, 200)));
    CHECK_FALSE(fits(d100, block("g", "route", "holding", 100, 1)));
    CHECK_FALSE(fits(d100, device("g", "D100")));
    d100.block_prefix = "other.";
    CHECK_FALSE(fits(d100, block("g", "main.D90", "D", 90, 11)));

    watch_filter configured;
    configured.by_device = true;
    configured.over_device = {"temp"};
    received_point point;
    point.gateway = "g";
    point.name = "temp";
    CHECK(fits(configured, point));
    CHECK(fits(configured, block("g", "temp", "input", 3, 1)));
    point.name = "temp2";
    CHECK_FALSE(fits(configured, point));
    CHECK_FALSE(fits(configured, block("g", "main.D0", "D", 0, 500)));
}

TEST_CASE("watch filter: topics by their names")
{
    CHECK(topic_from("PortStatus") == dds_topic::port_status);
    CHECK(topic_from("port_status") == dds_topic::port_status);
    CHECK(topic_from("event") == dds_topic::event);
    CHECK_FALSE(topic_from("ports").has_value());
}
