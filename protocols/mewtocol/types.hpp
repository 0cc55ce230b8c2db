// The words of MEWTOCOL-COM as types: headers, stations, areas, error codes. FP7 serial communication manual 11.2.
#pragma once

#include "protocols/bytes.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace plcgw::mewtocol {

enum class header : std::uint8_t { normal = '%', expansion = '<' };

// The longest frame, header and CR included (11.2.1).
constexpr std::size_t max_frame_size(header h) { return h == header::normal ? 118 : 2048; }

// 1 to 99. `any`: the only server of a one-to-one line answers, whatever its number. `global`: all execute, none
// answers.
enum class station_id : std::uint8_t { none = 0, any = 0xEE, global = 0xFF };

constexpr unsigned number(station_id s) { return static_cast<unsigned>(s); }
constexpr bool is_server_number(station_id s) { return number(s) >= 1 && number(s) <= 99; }

// Operand D1 of SEND: 1 to 99, and 0 is all stations (7.4.2). Operand S1 of RECV: 1 to 99 (7.3.2). Nothing = not
// allowed.
std::optional<station_id> station_of_send(unsigned operand);
std::optional<station_id> station_of_recv(unsigned operand);

// X, Y, R, L: word and bit. T, C: a number.
enum class contact_area : char {
    external_input = 'X',
    external_output = 'Y',
    internal_relay = 'R',
    link_relay = 'L',
    timer = 'T',
    counter = 'C',
};

constexpr bool is_contact_area(char letter)
{
    return std::string_view("XYRLTC").find(letter) != std::string_view::npos;
}
constexpr bool is_numbered(contact_area a) { return a == contact_area::timer || a == contact_area::counter; }
constexpr bool is_writable(contact_area a)
{
    return a == contact_area::external_output || a == contact_area::internal_relay || a == contact_area::link_relay;
}

struct contact {
    contact_area area{};
    std::uint16_t number{};  // X, Y, R, L: 16 x word + bit, so R12 (word 1, bit 2) is 18. T, C: as written
    bool operator==(const contact&) const = default;
};

inline constexpr std::uint16_t max_contact_number = 16 * 1000 - 1;  // three digits for the word
inline constexpr std::uint16_t max_timer_number = 9999;

// Areas of 16-bit words, named as in a program. system: system registers. id: IX and IY as one number of 32 bits.
enum class word_area : std::uint8_t { wx, wy, wr, wl, dt, ld, fl, sv, ev, ix, iy, id, system };

std::string_view to_string(word_area a);  // "WX", "DT" ...

// What a server says instead of a response: two digits, here read as hexadecimal, so that `!61` is 0x61. FP0H Ethernet
// manual 5.3, FP2 computer communication unit manual 6-6. Codes that are not named here can come too.
enum class error_code : std::uint8_t {
    undefined = 0x20,
    not_acknowledged = 0x21,
    wait_acknowledged = 0x22,
    duplicate_station = 0x23,
    transmission_format = 0x24,
    hardware = 0x25,
    station_setting = 0x26,
    frame_too_long = 0x27,
    no_response = 0x28,
    buffer_closed = 0x29,
    timeout = 0x30,
    transmission_impossible = 0x32,
    communication_stopped = 0x33,
    no_such_station = 0x36,
    other = 0x38,
    check = 0x40,          // BCC or CRC
    format = 0x41,         // not the form of a command
    not_supported = 0x42,  // command
    procedure = 0x43,      // not while a message in several frames is under way; or it would need several
    link_setting = 0x50,
    simultaneous_operation = 0x51,
    sending_disabled = 0x52,
    busy = 0x53,
    parameter = 0x60,  // area or function letter
    data = 0x61,       // number, range, digits or value
    registration = 0x62,
    mode = 0x63,  // not while RUN or PROG
    external_memory = 0x64,
    protection = 0x65,
    address = 0x66,
    no_program = 0x67,
    rewrite_in_run = 0x68,
    exclusive_control = 0x71,
    no_card = 0x78,
};

// Nothing was executed, and the same question may be answered in a moment.
constexpr bool is_passing(error_code e)
{
    return e == error_code::check || e == error_code::procedure || e == error_code::busy;
}

std::string to_string(error_code e);  // "61 (data)", as a PLC programmer looks it up

}  // namespace plcgw::mewtocol
