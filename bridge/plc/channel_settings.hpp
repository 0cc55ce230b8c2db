// What the format registers of a MODBUS channel say: FX3 manual 6.1 (D8401) and 6.2 (D8400), LS manual 4-2.
#pragma once

#include "bridge/plc/model.hpp"
#include "protocols/serial_timing.hpp"

#include <boost/system/result.hpp>

#include <optional>
#include <string>

namespace plcgw::plc {

enum class framing : std::uint8_t { rtu, ascii, tcp };
enum class role : std::uint8_t { client, server };

struct channel_settings {
    bool enabled = false;  // the channel speaks MODBUS; if not, the rest says nothing
    framing mode = framing::rtu;
    role as = role::server;
    bool rs485 = false;  // FX3 only: on an LS the port decides
    character_format format{};
};

// Why the PLC refuses the setting, as error 202 reports it.
struct settings_fault {
    enum class in : std::uint8_t { format, protocol };
    in at{};             // the register that is wrong
    std::string reason;  // for the engineer: the bits and what they may be
};

using settings_result = boost::system::result<channel_settings, settings_fault>;

// Bits that the manuals call reserved or unused are not looked at.
settings_result decode_fx3(std::uint16_t format, std::uint16_t protocol);
settings_result decode_ls(std::uint16_t format);

// By the model's style, and refusing what this model or channel cannot do: ASCII, 7 data bits, to be a client.
settings_result decode(const model& m, const channel& of, std::uint16_t format, std::uint16_t protocol);

// The other way round, for a channel that the configuration sets up. Nothing when the register has no code for it: an
// odd baud rate.
std::optional<std::uint16_t> encode_fx3_format(const channel_settings& s);
std::uint16_t encode_fx3_protocol(const channel_settings& s);
std::optional<std::uint16_t> encode_ls(const channel_settings& s);

}  // namespace plcgw::plc
