#include "protocols/modbus/crc.hpp"

#include <array>

namespace plcgw::modbus {
namespace {

constexpr std::array<std::uint16_t, 256> make_table()
{
    std::array<std::uint16_t, 256> table{};
    for (unsigned i = 0; i < 256; ++i) {
        unsigned crc = i;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 1U) != 0 ? crc >> 1 ^ 0xA001U : crc >> 1;
        table[i] = static_cast<std::uint16_t>(crc);
    }
    return table;
}

constexpr auto table = make_table();

}  // namespace

std::uint16_t crc16(bytes data, std::uint16_t before)
{
    std::uint16_t crc = before;
    for (const std::uint8_t byte : data)
        crc = static_cast<std::uint16_t>(crc >> 8 ^ table[(crc ^ byte) & 0xFF]);
    return crc;
}

}  // namespace plcgw::modbus
