#include "protocols/modbus/framing.hpp"

#include "protocols/modbus/ascii.hpp"
#include "protocols/modbus/rtu.hpp"

namespace plcgw::modbus {

buffer encode_adu(framing mode, const frame& f, std::uint8_t delimiter)
{
    return mode == framing::ascii ? encode_ascii(f, delimiter) : encode_rtu(f);
}

}  // namespace plcgw::modbus
