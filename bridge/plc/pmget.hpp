// What an FP7's instruction PMGET reads of a COM port: parameters and monitor information, FP7 manual 10.3.2.
#pragma once

#include "bridge/plc_link.hpp"
#include "protocols/serial_timing.hpp"

#include <array>

namespace plcgw::plc {

enum class com_mode : std::uint16_t {
    mewtocol_com = 0,
    mewtocol7_com = 1,
    modbus_rtu = 2,
    general_purpose = 8,
    plc_link = 9,
};

// Who may ask on the port: neither a PLC link nor a general-purpose port (4.1, XC).
constexpr bool is_master_mode(com_mode m) { return m < com_mode::general_purpose; }

enum class com_card : std::uint16_t { none = 0, rs232c = 232, rs422 = 422, rs485 = 485 };

enum class end_code : std::uint16_t { cr, cr_lf, silence, etx };

enum class start_code : std::uint16_t { none, stx };

struct com_parameters {
    com_mode mode = com_mode::mewtocol_com;
    unsigned station = 1;
    character_format format{.baud_rate = 9600, .data_bits = 8, .check = parity::odd, .stop_bits = 1};
    bool rs_cs = false;
    duration send_wait{};  // 0 to 100 ms, shown in steps of 0.01 ms
    start_code start = start_code::none;
    end_code end = end_code::cr;
    duration end_silence{};                             // 0.01 to 100 ms, when end is silence
    std::optional<plcgw::plc_link_settings> link = {};  // COM.1 in the mode plc_link only
};

// Bits of the receive error code. The lower ones are counted.
enum class receive_error : std::uint8_t {
    overrun = 0,
    framing = 1,  // no stop bit
    parity = 2,
    buffer_overrun = 8,
    buffers_full = 9,  // all eight hold a message
};

// Bits of the setting error code.
enum class setting_error : std::uint8_t {
    mode = 0,
    parameters = 8,
    send_count = 9,  // too much data to send
};

struct com_monitor {
    com_mode mode = com_mode::mewtocol_com;
    com_card card = com_card::none;
    std::uint16_t receive_errors = 0;       // bits, since the last reset
    std::uint16_t receive_error_count = 0;  // counts on from 0 after 65535
    std::uint16_t setting_errors = 0;       // bits
    std::uint16_t wrong_parameter = 0;      // 1 to 12, with setting_error::parameters
    std::uint16_t modem = 0;                // no modem is initialised here
};

inline constexpr std::size_t pmget_parameters = 26;
inline constexpr std::size_t pmget_monitor_words = 7;

// A baud rate that the manual does not list is shown as FFFFH.
std::array<std::uint16_t, pmget_parameters> parameter_words(const com_parameters& of);
std::array<std::uint16_t, pmget_monitor_words> monitor_words(const com_monitor& of);

void note(com_monitor& in, receive_error what);
void note(com_monitor& in, setting_error what, std::uint16_t wrong_parameter = 0);

// What a channel reset clears: receive errors, their count, and too much data to send. A wrong setting stays wrong.
void clear_errors(com_monitor& in);

}  // namespace plcgw::plc
