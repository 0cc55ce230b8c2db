// How long one MODBUS question takes between two PLCs: FX3 manual 2.2. The names of the parts are the manual's.
#pragma once

#include "bridge/plc/channel_settings.hpp"
#include "protocols/modbus/types.hpp"
#include "protocols/time.hpp"

#include <algorithm>
#include <optional>

namespace plcgw {

struct link_time_input {
    character_format format;
    plc::framing mode = plc::framing::rtu;  // or ascii
    std::size_t request_bytes = 8;          // on the wire
    std::size_t response_bytes = 8;
    duration message_delay{};  // D8411
    duration max_scan{};       // of the PLC whose time is asked for, above 0
    duration server_delay{};   // T8: until the server begins its response
};

// Tm: the client's PLC, from the instruction that asks to the answer in its devices.
struct client_link_time {
    duration t1;   // (INT(T4 / scan) + 1) * scan: waits for the line
    duration t2;   // (INT(T5 / scan) + 1) * scan: asks and is answered
    duration t3;   // "less than 1 ms"
    duration t4;   // D8411
    duration t5;   // T6 + T7 + T8 + T9 + T10
    duration t6;   // "less than 1 ms"
    duration t7;   // request
    duration t8;   // server delay
    duration t9;   // response
    duration t10;  // end of an RTU frame
    duration total;
    bool operator==(const client_link_time&) const = default;
};

// Ts: the server's PLC, from the first byte of the request to the last of the response.
struct server_link_time {
    duration t11;  // T14 + T15 + scan
    duration t12;  // "less than 1 ms"
    duration t13;  // response
    duration t14;  // request
    duration t15;  // D8411
    duration total;
    bool operator==(const server_link_time&) const = default;
};

// The 1 ms that the formulas add for rounding, and the parts that take "less than 1 ms".
inline constexpr duration about_1_ms{1000};

// D8411 as the PLC applies it: 3.5 characters when it is 0 or less than that (FX3 manual 6.1).
constexpr duration applied_message_delay(const link_time_input& in)
{
    return std::max(in.message_delay, frame_gap(in.format));
}

// (INT(t / scan) + 1) * scan: the end of the scan that t ends in.
constexpr duration whole_scans(duration t, duration scan) { return (t / scan + 1) * scan; }

constexpr client_link_time client_time(const link_time_input& in)
{
    client_link_time t{};
    t.t4 = applied_message_delay(in);
    t.t1 = whole_scans(t.t4, in.max_scan);
    t.t6 = about_1_ms;
    t.t7 = character_time(in.format, in.request_bytes) + about_1_ms;
    t.t8 = in.server_delay;
    t.t9 = character_time(in.format, in.response_bytes) + about_1_ms;
    if (in.mode == plc::framing::rtu)
        t.t10 = (character_time(in.format, 7) + duration{1}) / 2 + about_1_ms;  // 3.5 characters
    t.t5 = t.t6 + t.t7 + t.t8 + t.t9 + t.t10;
    t.t2 = whole_scans(t.t5, in.max_scan);
    t.t3 = about_1_ms;
    t.total = t.t1 + t.t2 + t.t3;
    return t;
}

constexpr server_link_time server_time(const link_time_input& in)
{
    server_link_time t{};
    t.t14 = character_time(in.format, in.request_bytes) + about_1_ms;
    t.t15 = applied_message_delay(in);
    t.t11 = t.t14 + t.t15 + in.max_scan;
    t.t12 = about_1_ms;
    t.t13 = character_time(in.format, in.response_bytes) + about_1_ms;
    t.total = t.t11 + t.t12 + t.t13;
    return t;
}

// Bytes of a request and of its normal response, without the envelope (V1.1b3 section 6).
struct pdu_sizes {
    std::size_t request;
    std::size_t response;
    bool operator==(const pdu_sizes&) const = default;
};

// count: items read or written, or the events in the response to 0C; write_count: of the written part of function 17H.
// Nothing when the function does not allow so many, or is none that the manuals list.
std::optional<pdu_sizes> sizes_of(modbus::function f, std::size_t count, std::size_t write_count);

// An ADU on a serial line: RTU adds the station and a CRC, ASCII writes each byte as two and adds ":", LRC, CR and LF.
constexpr std::size_t adu_size(std::size_t pdu, plc::framing mode)
{
    return mode == plc::framing::ascii ? 1 + 2 * (pdu + 2) + 2 : pdu + 3;
}

}  // namespace plcgw
