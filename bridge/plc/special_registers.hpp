// The numbers of the special D and M devices of each MODBUS channel: FX3 manual 6.1 and 6.3, LS manual 4-1 and 4-3.
#pragma once

#include <cstddef>
#include <cstdint>

namespace plcgw::plc {

// D numbers; 0 = this model or channel does not have it.
struct channel_registers {
    std::uint32_t format = 0;
    std::uint32_t protocol = 0;  // LS has one register for both: this is 0
    std::uint32_t error_code = 0;
    std::uint32_t error_detail = 0;
    std::uint32_t error_step = 0;
    std::uint32_t format_display = 0;
    std::uint32_t delimiter = 0;  // second end character of ASCII
    std::uint32_t executing_step = 0;
    std::uint32_t retry_value = 0;
    std::uint32_t response_timeout = 0;  // ms
    std::uint32_t turnaround_delay = 0;  // ms
    std::uint32_t message_delay = 0;     // ms
    std::uint32_t retries = 0;
    std::uint32_t station = 0;
    std::uint32_t status_setup = 0;  // what of counters and event log is mirrored
    std::uint32_t status_head = 0;   // and where
    std::uint32_t serial_error = 0;  // takes serial_error_value
    std::uint32_t mode = 0;          // who uses the port: 9 = MODBUS
    bool operator==(const channel_registers&) const = default;
};

// M numbers; 0 = this model or channel does not have it.
struct channel_flags {
    std::uint32_t setup_request = 0;  // LD M8411 begins the setup program
    std::uint32_t completed = 0;      // M8029
    std::uint32_t busy = 0;
    std::uint32_t error = 0;
    std::uint32_t error_latched = 0;
    std::uint32_t listen_only = 0;
    std::uint32_t retrying = 0;
    std::uint32_t timeout = 0;
    std::uint32_t serial_error = 0;
    bool operator==(const channel_flags&) const = default;
};

struct channel {
    unsigned number = 0;  // as the manual counts: 1, 2, 3
    bool client = false;  // may ask with ADPRW; every channel can serve
    channel_registers registers{};
    channel_flags flags{};
    std::uint16_t serial_error_value = 0;  // in registers.serial_error; 0 where that does not exist
    bool operator==(const channel&) const = default;
};

inline constexpr std::uint16_t mode_modbus = 9;  // in registers.mode

// FX3U and FX3UC.
inline constexpr channel fx3u_channels[] = {
    {.number = 1,
     .client = true,
     .registers = {.format = 8400,
                   .protocol = 8401,
                   .error_code = 8402,
                   .error_detail = 8403,
                   .error_step = 8404,
                   .format_display = 8405,
                   .delimiter = 8406,
                   .executing_step = 8407,
                   .retry_value = 8408,
                   .response_timeout = 8409,
                   .turnaround_delay = 8410,
                   .message_delay = 8411,
                   .retries = 8412,
                   .station = 8414,
                   .status_setup = 8415,
                   .status_head = 8416,
                   .serial_error = 8063,
                   .mode = 8419},
     .flags = {.setup_request = 8411,
               .completed = 8029,
               .busy = 8401,
               .error = 8402,
               .error_latched = 8403,
               .listen_only = 8404,
               .retrying = 8408,
               .timeout = 8409,
               .serial_error = 8063},
     .serial_error_value = 6321},
    {.number = 2,
     .client = true,
     .registers = {.format = 8420,
                   .protocol = 8421,
                   .error_code = 8422,
                   .error_detail = 8423,
                   .error_step = 8424,
                   .format_display = 8425,
                   .delimiter = 8426,
                   .executing_step = 8427,
                   .retry_value = 8428,
                   .response_timeout = 8429,
                   .turnaround_delay = 8430,
                   .message_delay = 8431,
                   .retries = 8432,
                   .station = 8434,
                   .status_setup = 8435,
                   .status_head = 8436,
                   .serial_error = 8438,
                   .mode = 8439},
     .flags = {.setup_request = 8411,
               .completed = 8029,
               .busy = 8421,
               .error = 8422,
               .error_latched = 8423,
               .listen_only = 8424,
               .retrying = 8428,
               .timeout = 8429,
               .serial_error = 8438},
     .serial_error_value = 3821},
};

// What the manual's footnotes keep for FX3U and FX3UC: ASCII, counters and event log in devices, listen-only mode.
constexpr channel without_fx3u_only(channel c)
{
    c.registers.delimiter = c.registers.status_setup = c.registers.status_head = 0;
    c.flags.listen_only = 0;
    return c;
}

// FX3G and FX3GC; FX3S has the first of them, as section 3.2 shows it with one adapter.
inline constexpr channel fx3g_channels[] = {
    without_fx3u_only(fx3u_channels[0]),
    without_fx3u_only(fx3u_channels[1]),
};

// LS22 and LS32: 1 is the RS-485 port, 2 PORT0-232, 3 PORT1-232. Errors and timing exist for the client alone, which is
// on channel 1. M8411 is ours: the drawing of the manual's program (8-3) is lost, and the PLC is an FX3U in its
// program.
inline constexpr channel ls_channels[] = {
    {.number = 1,
     .client = true,
     .registers = {.format = 8400,
                   .error_code = 8402,
                   .error_step = 8404,
                   .executing_step = 8407,
                   .retry_value = 8408,
                   .response_timeout = 8409,
                   .retries = 8412,
                   .station = 8414},
     .flags = {.setup_request = 8411,
               .completed = 8029,
               .busy = 8401,
               .error = 8402,
               .error_latched = 8403,
               .retrying = 8408,
               .timeout = 8409}},
    {.number = 2, .registers = {.format = 8420, .station = 8434}, .flags = {.setup_request = 8411}},
    {.number = 3, .registers = {.format = 8413, .station = 8437}, .flags = {.setup_request = 8411}},
};

}  // namespace plcgw::plc
