#include "bridge/plc/models/fx3u.hpp"
#include "bridge/plc/simulated_plc.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using namespace plcgw::plc;
using modbus::address;
using modbus::table;

namespace {

constexpr const char* valid_example = "LD M8411\n"
                                      "MOV H1097 D8400\nMOV H11 D8401\nMOV K1 D8414\n"
                                      "MOV H5002 D8470\nMOV K0 D8471\nMOV H4 D8472\nMOV K128 D8473\n"
                                      "MOV H8008 D8474\nMOV K0 D8475\nMOV H9002 D8476\nMOV K128 D8477\n"
                                      "MOV HC00D D8478\nMOV K1000 D8479\nMOV HD010 D8480\nMOV K0 D8481\n"
                                      "MOV HF008 D8482\nMOV K200 D8483\nMOV H0 D8484\nMOV K0 D8485\nEND\n";

simulated_plc plc_with(const std::string& program)
{
    auto parsed = parse_setup_program(program);
    REQUIRE(parsed.mistakes.empty());
    return {"main", fx3u, std::move(parsed)};
}

std::uint16_t word(const simulated_plc& plc, const char* device)
{
    return plc.memory().word(plc.memory().find(*parse_device(device)).value());
}

bool bit(const simulated_plc& plc, const char* device)
{
    return plc.memory().bit(plc.memory().find(*parse_device(device)).value());
}

bool leads(const simulated_plc& plc, table in, unsigned number, const char* device)
{
    const auto found = plc.map().find(plc.memory(), in, address(number), 1);
    return found && found->front().at == plc.memory().find(*parse_device(device));
}

void check_fault(const simulated_plc& plc, std::uint16_t detail)
{
    REQUIRE(plc.fault().has_value());
    CHECK(plc.fault()->detail == detail);
    CHECK(word(plc, "D8402") == 202);
    CHECK(word(plc, "D8403") == detail);
    CHECK(word(plc, "D8063") == 6321);
    for (const char* flag : {"M8063", "M8402", "M8403"})
        CHECK(bit(plc, flag));
}

}  // namespace

TEST_CASE("simulated plc: without a setup program the default map is in force and nothing is wrong")
{
    const simulated_plc plc = plc_with("");
    CHECK_FALSE(plc.fault().has_value());
    CHECK(leads(plc, table::coils, 0x3300, "Y0"));
    CHECK(bit(plc, "M8000"));  // RUN
    for (const char* device : {"D8402", "D8403", "D8063", "D8400", "D8470"})
        CHECK(word(plc, device) == 0);
    for (const char* flag : {"M8063", "M8402", "M8403"})
        CHECK_FALSE(bit(plc, flag));
}

TEST_CASE("simulated plc: the valid example of 9.4.2, from program text to D8470-D8485 and the map")
{
    const simulated_plc plc = plc_with(valid_example);
    CHECK_FALSE(plc.fault().has_value());
    const std::uint16_t expected[] = {0x5002, 0,    0x0004, 128, 0x8008, 0,   0x9002, 128,
                                      0xC00D, 1000, 0xD010, 0,   0xF008, 200, 0,      0};
    for (std::uint32_t i = 0; i < 16; ++i)
        CHECK(word(plc, to_string(device{device_kind::d, 8470 + i}).c_str()) == expected[i]);
    CHECK(word(plc, "D8400") == 0x1097);
    CHECK(word(plc, "D8414") == 1);
    CHECK(word(plc, "D8402") == 0);

    CHECK(leads(plc, table::coils, 0x00, "X0"));
    CHECK(leads(plc, table::coils, 0x5F, "M191"));
    CHECK(leads(plc, table::holding_registers, 0x0A, "D1000"));
    CHECK(leads(plc, table::holding_registers, 0xDA, "R0"));
    CHECK(leads(plc, table::holding_registers, 0x1DA, "CN200"));
}

TEST_CASE("simulated plc: the invalid example of 9.4.2: D8402 = 202, D8403 = 8476, D8476 to D8485 are 0")
{
    std::string program = valid_example;
    program.replace(program.find("MOV K128 D8477"), 14, "MOV K240 D8477");
    program.replace(program.find("MOV HF008"), 9, "MOV HF010");
    const simulated_plc plc = plc_with(program);
    check_fault(plc, 8476);
    CHECK(plc.fault()->line == 11);  // of MOV H9002 D8476

    const std::uint16_t expected[] = {0x5002, 0, 0x0004, 128, 0x8008, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    for (std::uint32_t i = 0; i < 16; ++i)
        CHECK(word(plc, to_string(device{device_kind::d, 8470 + i}).c_str()) == expected[i]);
    CHECK(leads(plc, table::coils, 0x20, "M128"));
    CHECK(leads(plc, table::holding_registers, 0, "TS0"));
    CHECK_FALSE(plc.map().find(plc.memory(), table::holding_registers, address{8}, 1).has_value());
}

TEST_CASE("simulated plc: a wrong station number keeps its register's initial value, the rest is in force")
{
    const simulated_plc plc = plc_with("LD M8411\nMOV K248 D8414\nMOV H5002 D8470\nMOV K0 D8471\n");
    check_fault(plc, 8414);
    CHECK(word(plc, "D8414") == 0);
    CHECK(leads(plc, table::coils, 0, "X0"));
}

TEST_CASE("simulated plc: a void block sets nothing and leaves the default map")
{
    const simulated_plc plc = plc_with("LD M8411\nMOV H1097 D8400\nAND M0\nMOV H5002 D8470\nMOV K0 D8471\n");
    check_fault(plc, 8411);
    CHECK(word(plc, "D8400") == 0);
    CHECK(word(plc, "D8470") == 0);
    CHECK(leads(plc, table::coils, 0x3300, "Y0"));
}

TEST_CASE("simulated plc: two faults, the first in the program's order of checks is reported")
{
    const simulated_plc plc = plc_with("LD M8411\nMOV K0 D8414\nMOV H0001 D8470\nMOV K4 D8471\n");
    check_fault(plc, 8414);
    CHECK(word(plc, "D8470") == 0);
    CHECK(word(plc, "D8471") == 0);
    CHECK(leads(plc, table::holding_registers, 0, "D0"));
}

TEST_SUITE_END();
