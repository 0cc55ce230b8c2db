// DDS: peers that need no name service, blocks whose names tell them apart.
#include "tests/config/plant.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("check");

using namespace plcgw::config;

TEST_CASE("check: DDS peers are IPv4 addresses, since looking up a name blocks")
{
    const change_row rows[] = {
        {R"("192.168.1.5")", R"("192.168.1.5", "10.0.0.1", "127.0.0.1")", ""},
        {R"("192.168.1.5")", R"("plant-b")",
         R"(73 /dds/peers/0 is "plant-b", expected an IPv4 address such as 192.168.1.5, not a name)"},
        {R"("192.168.1.5")", R"("localhost")",
         R"(73 /dds/peers/0 is "localhost", expected an IPv4 address such as 192.168.1.5, not a name)"},
        {R"("192.168.1.5")", R"("192.168.1")",
         R"(73 /dds/peers/0 is "192.168.1", expected an IPv4 address such as 192.168.1.5, not a name)"},
        {R"("192.168.1.5")", R"("192.168.1.5:7410")",
         R"(73 /dds/peers/0 is "192.168.1.5:7410", expected an IPv4 address such as 192.168.1.5, not a name)"},
        {R"("192.168.1.5")", R"("fe80::1")",
         R"(73 /dds/peers/0 is "fe80::1", expected an IPv4 address such as 192.168.1.5, not a name)"},
        {R"("192.168.1.5")", "\"192.168.1.5\",\n\"b\",\n\"c\"",
         "74 /dds/peers/1 is \"b\", expected an IPv4 address such as 192.168.1.5, not a name\n"
         "75 /dds/peers/2 is \"c\", expected an IPv4 address such as 192.168.1.5, not a name"},
    };
    for (const change_row& row : rows)
        check_row(row);
}

TEST_CASE("check: DDS blocks")
{
    const change_row rows[] = {
        {R"("device": "M0")", R"("device": "X8")",
         R"(76 /dds/blocks/1/device is "X8", expected a device such as D100, M0 or X17 (octal))"},
        {R"("device": "M0")", R"("device": "D9000")", "76 /dds/blocks/1/device is D9000, which a FX3U does not have"},
        {R"("device": "D0", "count": 20)", R"("device": "D7980", "count": 20)", ""},
        {R"("device": "D0", "count": 20)", R"("device": "D7981", "count": 20)",
         "75 /dds/blocks/0/device is D7981, but from there the count goes beyond D7999, the last one"},
        {R"("device": "D0", "count": 20)", R"("device": "M7660", "count": 20)", ""},  // bits of a bit device
        {R"("device": "D0", "count": 20)", R"("device": "M7661", "count": 20)",
         "75 /dds/blocks/0/device is M7661, but from there the count goes beyond M7679, the last one"},
        {R"("device": "D0", "count": 20)", R"("device": "D0", "count": 1025)",
         "75 /dds/blocks/0/count is 1025, expected a whole number from 1 to 1024"},

        // The name of a block is its key in DDS: "main.M0".
        {R"("device": "M0")", R"("device": "D0")",
         R"(76 /dds/blocks/1/device makes "main.D0" a second time: raise the count of the first one)"},
        {R"("device": "M0")", R"("device": "d000", "count": 3)",
         R"(76 /dds/blocks/1/device makes "main.D0" a second time: raise the count of the first one)"},
        {R"("device": "M0")", R"("device": "D1")", ""},
        {R"("plc": "main", "device": "M0")", R"("plc": "spare", "device": "D0")", ""},
    };
    for (const change_row& row : rows)
        check_row(row);
}

TEST_CASE("check: the name of a DDS block has 64 bytes")
{
    const auto text = [](std::size_t letters, const char* device) {
        const std::string name(letters, 'a');
        return "{\"plcs\": [{\"name\": \"" + name + "\"}],\n\"dds\": {\"blocks\": [\n{\"plc\": \"" + name +
               "\", \"device\": \"" + device + "\"}]}}";
    };
    CHECK(said(text(61, "D0")) == "");
    CHECK(said(text(62, "D0")) == "3 /dds/blocks/0/plc makes \"" + std::string(62, 'a') +
                                      ".D0\", which is longer than the 64 bytes of a DDS name: shorten the PLC's name");
    CHECK(said(text(61, "D00000")) == "");
    CHECK(said(text(58, "D7999")) == "");
    CHECK(said(text(59, "D7999")).starts_with("3 /dds/blocks/0/plc makes "));
}

TEST_CASE("check: what allows DDS writes while they are not allowed at all")
{
    const change_row rows[] = {
        {R"("device": "D0", "count": 20)", R"("device": "D0", "count": 20, "writable": true)",
         "75 warning /dds/blocks/0/writable is true, but allows nothing while /dds/writes is false"},
        {R"("device": "D0", "count": 20)", R"("device": "D0", "count": 20, "writable": false)", ""},
    };
    for (const change_row& row : rows)
        check_row(row);
}
