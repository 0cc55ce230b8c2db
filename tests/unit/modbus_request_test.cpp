#include "protocols/modbus/request.hpp"
#include "tests/support/print.hpp"

#include <algorithm>

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;

namespace {

struct request_row {
    const char* name;
    buffer pdu;
    request asked;
};

// The examples of V1.1b3 chapter 6, and requests as the FX3 manual 7.4 to 7.9 draws them for its own devices.
// clang-format off
const request_row rows[] = {
    //     fc    first       count or value
    {"6.1 read coils 20 to 38",
        {0x01, 0x00, 0x13, 0x00, 0x13}, read_table{table::coils, address{0x13}, 19}},
    {"6.2 read discrete inputs 197 to 218",
        {0x02, 0x00, 0xC4, 0x00, 0x16}, read_table{table::discrete_inputs, address{0xC4}, 22}},
    {"6.3 read holding registers 108 to 110",
        {0x03, 0x00, 0x6B, 0x00, 0x03}, read_table{table::holding_registers, address{0x6B}, 3}},
    {"6.4 read input register 9",
        {0x04, 0x00, 0x08, 0x00, 0x01}, read_table{table::input_registers, address{8}, 1}},
    {"6.5 write coil 173 on",
        {0x05, 0x00, 0xAC, 0xFF, 0x00}, write_single_coil{address{0xAC}, true}},
    {"write coil 173 off",
        {0x05, 0x00, 0xAC, 0x00, 0x00}, write_single_coil{address{0xAC}, false}},
    {"6.6 write register 2",
        {0x06, 0x00, 0x01, 0x00, 0x03}, write_single_register{address{1}, 3}},
    {"6.11 write coils 20 to 29",
        {0x0F, 0x00, 0x13, 0x00, 0x0A, 0x02, 0xCD, 0x01},
        write_multiple_coils{address{0x13}, {true, false, true, true, false, false, true, true, true, false}}},
    {"6.12 write registers 2 and 3",
        {0x10, 0x00, 0x01, 0x00, 0x02, 0x04, 0x00, 0x0A, 0x01, 0x02},
        write_multiple_registers{address{1}, {0x000A, 0x0102}}},
    {"6.16 mask write register 5",
        {0x16, 0x00, 0x04, 0x00, 0xF2, 0x00, 0x25}, mask_write_register{address{4}, 0x00F2, 0x0025}},
    {"6.17 read registers 4 to 9, write 15 to 17",
        {0x17, 0x00, 0x03, 0x00, 0x06, 0x00, 0x0E, 0x00, 0x03, 0x06, 0x00, 0xFF, 0x00, 0xFF, 0x00, 0xFF},
        read_write_multiple_registers{address{3}, 6, address{0x0E}, {0x00FF, 0x00FF, 0x00FF}}},
    {"the last coil",
        {0x05, 0xFF, 0xFF, 0xFF, 0x00}, write_single_coil{address{0xFFFF}, true}},
    {"every bit of address and value",
        {0x06, 0xA5, 0x5A, 0x80, 0x01}, write_single_register{address{0xA55A}, 0x8001}},
    {"a run beyond the last address is the memory's business",
        {0x03, 0xFF, 0xFF, 0x00, 0x02}, read_table{table::holding_registers, address{0xFFFF}, 2}},
};
// clang-format on

}  // namespace

TEST_CASE("modbus request: bytes -> struct -> bytes")
{
    for (const request_row& row : rows) {
        CAPTURE(row.name);
        const auto parsed = parse_request(row.pdu);
        REQUIRE(parsed.has_value());
        CHECK(*parsed == row.asked);
        CHECK(encode_request(row.asked) == row.pdu);
        CHECK(static_cast<unsigned>(function_of(row.asked)) == row.pdu[0]);
    }
}

TEST_CASE("modbus request: a PDU that is too short or too long answers exception 03")
{
    for (const request_row& row : rows) {
        CAPTURE(row.name);
        for (std::size_t size = 1; size < row.pdu.size(); ++size) {
            CAPTURE(size);
            CHECK(parse_request(bytes(row.pdu).first(size)).error() == exception_code::illegal_data_value);
        }
        buffer longer = row.pdu;
        longer.push_back(0x00);
        CHECK(parse_request(longer).error() == exception_code::illegal_data_value);
    }
}

TEST_CASE("modbus request: bits behind the last coil are not looked at")
{
    const buffer padded{0x0F, 0x00, 0x13, 0x00, 0x0A, 0x02, 0xCD, 0xFD};
    CHECK(*parse_request(padded) == rows[7].asked);
}

TEST_CASE("modbus request: an unknown function code answers exception 01, whatever follows")
{
    const std::uint8_t known[] = {0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x07, 0x08,
                                  0x0B, 0x0C, 0x0F, 0x10, 0x11, 0x16, 0x17};
    for (unsigned code = 0; code < 256; ++code) {
        if (std::find(std::begin(known), std::end(known), code) != std::end(known))
            continue;
        CAPTURE(code);
        const auto function_code = static_cast<std::uint8_t>(code);
        CHECK(parse_request(buffer{function_code}).error() == exception_code::illegal_function);
        CHECK(parse_request(buffer{function_code, 0x00, 0x00, 0x00, 0x01}).error() == exception_code::illegal_function);
    }
    CHECK(parse_request({}).error() == exception_code::illegal_function);
}

TEST_SUITE_END();
