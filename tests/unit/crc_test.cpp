#include "protocols/modbus/crc.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;

namespace {

struct crc_row {
    const char* name;
    buffer data;
    buffer crc;  // as sent: low byte first
};

const crc_row rows[] = {
    {"FX3 manual 7.2.1, the walk-through", {0x02, 0x07}, {0x41, 0x12}},
    {"read ten holding registers", {0x01, 0x03, 0x00, 0x00, 0x00, 0x0A}, {0xC5, 0xCD}},
    {"read holding registers 107 to 109", {0x11, 0x03, 0x00, 0x6B, 0x00, 0x03}, {0x76, 0x87}},
    {"their answer", {0x11, 0x03, 0x06, 0xAE, 0x41, 0x56, 0x52, 0x43, 0x40}, {0x49, 0xAD}},
    {"exception 02 to a read of coils", {0x0A, 0x81, 0x02}, {0xB0, 0x53}},
    {"the check value of CRC-16/MODBUS", {'1', '2', '3', '4', '5', '6', '7', '8', '9'}, {0x37, 0x4B}},
    {"nothing: the start value", {}, {0xFF, 0xFF}},
};

// The manual's steps 1 to 7, a bit at a time.
std::uint16_t crc_by_hand(bytes data)
{
    unsigned crc = 0xFFFF;
    for (const std::uint8_t byte : data) {
        crc ^= byte;
        for (int shift = 0; shift < 8; ++shift)
            crc = (crc & 1U) != 0 ? (crc >> 1) ^ 0xA001U : crc >> 1;
    }
    return static_cast<std::uint16_t>(crc);
}

}  // namespace

TEST_CASE("crc: known frames, low byte first")
{
    for (const crc_row& row : rows) {
        CAPTURE(row.name);
        const std::uint16_t crc = modbus::crc16(row.data);
        CHECK(buffer{static_cast<std::uint8_t>(crc & 0xFF), static_cast<std::uint8_t>(crc >> 8)} == row.crc);
    }
}

TEST_CASE("crc: every byte value, as the manual computes it by hand")
{
    buffer data;
    for (unsigned value = 0; value < 256; ++value) {
        data.push_back(static_cast<std::uint8_t>(value));
        REQUIRE(modbus::crc16(data) == crc_by_hand(data));
    }
}

TEST_CASE("crc: data followed by its own CRC leaves zero")
{
    for (const crc_row& row : rows) {
        buffer whole = row.data;
        whole.insert(whole.end(), row.crc.begin(), row.crc.end());
        CHECK(modbus::crc16(whole) == 0);
    }
}

TEST_SUITE_END();
