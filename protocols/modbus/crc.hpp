// CRC-16 of MODBUS over Serial Line V1.02 section 6.2.2 (FX3 manual 7.2.1): polynomial A001H, start FFFFH.
#pragma once

#include "protocols/bytes.hpp"

namespace plcgw::modbus {

// Sent low byte first. `before` is the CRC of the bytes that came before these.
std::uint16_t crc16(bytes data, std::uint16_t before = 0xFFFF);

inline bool crc_fits(bytes adu) { return crc16(adu) == 0; }  // over data and its own CRC the remainder is zero

}  // namespace plcgw::modbus
