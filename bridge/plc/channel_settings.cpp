#include "bridge/plc/channel_settings.hpp"

#include <span>

namespace plcgw::plc {
namespace {

using in = settings_fault::in;

// Bits 7 to 4 of both formats.
struct baud_code {
    unsigned code;
    unsigned rate;
};

constexpr baud_code fx3_bauds[] = {
    {0x3, 300},  {0x4, 600},   {0x5, 1200},  {0x6, 2400},  {0x7, 4800},
    {0x8, 9600}, {0x9, 19200}, {0xA, 38400}, {0xB, 57600}, {0xD, 115200},
};

constexpr baud_code ls_bauds[] = {
    {0x4, 600},   {0x5, 1200},  {0x6, 2400},  {0x7, 4800},  {0x8, 9600},
    {0x9, 19200}, {0xA, 38400}, {0xB, 56000}, {0xC, 57600}, {0xD, 115200},
};

constexpr bool bit(std::uint16_t word, unsigned number) { return (word >> number & 1U) != 0; }

std::string two_digits(unsigned value) { return {value & 2 ? '1' : '0', value & 1 ? '1' : '0'}; }

settings_fault wrong_baud(unsigned code, std::span<const baud_code> known)
{
    std::string rates;
    for (const baud_code& each : known)
        rates.append(rates.empty() ? "" : ", ").append(std::to_string(each.rate));
    return {in::format, "baud rate (b7 to b4) has the code " + two_digits(code >> 2) + two_digits(code) +
                            ", which is none of " + rates + " bit/s"};
}

// Bits 0 to 7, the same in both formats but for the baud rates.
boost::system::result<character_format, settings_fault> decode_characters(std::uint16_t format,
                                                                          std::span<const baud_code> bauds)
{
    character_format decoded{.data_bits = bit(format, 0) ? 8U : 7U, .stop_bits = bit(format, 3) ? 2U : 1U};
    switch (format >> 1 & 3) {
    case 0: decoded.check = parity::none; break;
    case 1: decoded.check = parity::odd; break;
    case 3: decoded.check = parity::even; break;
    default: return settings_fault{in::format, "parity (b2, b1) is 10, expected 00 none, 01 odd or 11 even"};
    }
    const unsigned code = format >> 4 & 0xF;
    for (const baud_code& each : bauds)
        if (each.code == code) {
            decoded.baud_rate = each.rate;
            return decoded;
        }
    return wrong_baud(code, bauds);
}

settings_result with_characters(channel_settings s, std::uint16_t format, std::span<const baud_code> bauds)
{
    const auto characters = decode_characters(format, bauds);
    if (!characters)
        return characters.error();
    s.format = *characters;
    if (s.mode == framing::rtu && s.format.data_bits != 8)
        return settings_fault{in::format, "data length (b0) is 7 bits, but RTU needs 8: the PLC would lose data"};
    return s;
}

// Bits 0 to 7.
std::optional<std::uint16_t> encode_characters(const character_format& f, std::span<const baud_code> bauds)
{
    const unsigned parity_bits = f.check == parity::none ? 0U : f.check == parity::odd ? 1U : 3U;
    for (const baud_code& each : bauds)
        if (each.rate == f.baud_rate)
            return static_cast<std::uint16_t>((f.data_bits == 8 ? 1U : 0U) | parity_bits << 1 |
                                              (f.stop_bits == 2 ? 8U : 0U) | each.code << 4);
    return std::nullopt;
}

}  // namespace

settings_result decode_fx3(std::uint16_t format, std::uint16_t protocol)
{
    const channel_settings s{.enabled = bit(protocol, 0),
                             .mode = bit(protocol, 8) ? framing::ascii : framing::rtu,
                             .as = bit(protocol, 4) ? role::server : role::client,
                             .rs485 = bit(format, 12)};
    if (!s.enabled)
        return channel_settings{};
    return with_characters(s, format, fx3_bauds);
}

settings_result decode_ls(std::uint16_t format)
{
    constexpr framing modes[] = {framing::rtu, framing::ascii, framing::tcp};
    if (!bit(format, 14))
        return channel_settings{};
    const unsigned mode = format >> 12 & 3;
    if (mode == 3)
        return settings_fault{in::format, "mode (b13, b12) is 11, expected 00 RTU, 01 ASCII or 10 TCP"};
    const channel_settings s{.enabled = true, .mode = modes[mode], .as = bit(format, 15) ? role::client : role::server};
    return with_characters(s, format, ls_bauds);
}

std::optional<std::uint16_t> encode_fx3_format(const channel_settings& s)
{
    const auto characters = encode_characters(s.format, fx3_bauds);
    if (!characters)
        return std::nullopt;
    return static_cast<std::uint16_t>(*characters | (s.rs485 ? 1U << 12 : 0U));
}

std::uint16_t encode_fx3_protocol(const channel_settings& s)
{
    return static_cast<std::uint16_t>((s.enabled ? 1U : 0U) | (s.as == role::server ? 1U << 4 : 0U) |
                                      (s.mode == framing::ascii ? 1U << 8 : 0U));
}

std::optional<std::uint16_t> encode_ls(const channel_settings& s)
{
    const auto characters = encode_characters(s.format, ls_bauds);
    if (!characters)
        return std::nullopt;
    return static_cast<std::uint16_t>(*characters | static_cast<unsigned>(s.mode) << 12 | (s.enabled ? 1U << 14 : 0U) |
                                      (s.as == role::client ? 1U << 15 : 0U));
}

settings_result decode(const model& m, const channel& of, std::uint16_t format, std::uint16_t protocol)
{
    const bool one_register = m.format == format_style::ls;
    const settings_result s = one_register ? decode_ls(format) : decode_fx3(format, protocol);
    if (!s || !s->enabled)
        return s;
    const in mode_register = one_register ? in::format : in::protocol;
    const std::string name(m.name);
    if (s->mode == framing::ascii && !m.ascii)
        return settings_fault{mode_register, "mode (b8) is ASCII, but a " + name + " has RTU only"};
    if (s->format.data_bits == 7 && !m.ascii)
        return settings_fault{in::format, "data length (b0) is 7 bits, but a " + name + " has 8 only"};
    if (s->as == role::client && !of.client)
        return settings_fault{mode_register, "role (b15) is master, but channel " + std::to_string(of.number) +
                                                 " of a " + name + " is a slave only"};
    return s;
}

}  // namespace plcgw::plc
