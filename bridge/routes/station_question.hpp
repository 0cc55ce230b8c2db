// What a line asks of a station and what that says, in either protocol: the only place where routes, quality and
// schedule know of more than one.
#pragma once

#include "protocols/mewtocol/block.hpp"
#include "protocols/modbus/response.hpp"

namespace plcgw {

// Whom a line asks: a MODBUS unit id, or the number of a MEWTOCOL station. 0 = all of them; nobody answers.
struct station_number {
    std::uint16_t value{};

    constexpr station_number() = default;
    constexpr explicit station_number(unsigned number) : value(static_cast<std::uint16_t>(number)) {}
    constexpr station_number(modbus::unit_id unit)  // NOLINT: every unit id is one
        : value(static_cast<std::uint16_t>(modbus::number(unit)))
    {
    }
    auto operator<=>(const station_number&) const = default;
};

constexpr unsigned number(station_number n) { return n.value; }

// Of a MODBUS line, whose numbers are configured as unit ids.
constexpr modbus::unit_id unit_of(station_number n) { return modbus::unit_id{static_cast<std::uint8_t>(n.value)}; }

// Registers or bits of a MODBUS station.
struct modbus_place {
    modbus::table table{};
    modbus::address first{};
    bool operator==(const modbus_place&) const = default;
};

// Where the values of a route are in its station: the first of them.
using station_place = std::variant<modbus_place, mewtocol::device>;

bool is_bits(const station_place& p);
std::string area_name(const station_place& p);  // "holding", "coil" ..., "DT", "R" ...
std::uint32_t number(const station_place& p);   // of the first register, bit, word or contact; R1F is 31

station_place moved_to(station_place p, std::uint32_t number);  // in the same table or area; it has such a number

using station_question = std::variant<modbus::request, mewtocol::block>;
using station_answer = std::variant<modbus::response, mewtocol::response>;

station_question read_question(const station_place& first, std::uint32_t count);

// What was read from the offset on: an answer as if only these had been asked. Of what is no read, nothing changes.
station_answer part_of(const station_answer& answer, std::size_t offset, std::size_t count);

struct station_refusal {
    std::string reason;  // "exception 02 (illegal data address)", "error 61 (data), result 6"
    bool may_pass{};     // "not now" rather than "never"
    // Whether a shorter request, or one of other registers, may be answered.
    enum class cause : std::uint8_t { other, place, length } about = cause::other;
    std::uint16_t code{};  // exception or error code
};

// Nothing if the station did what it was asked.
std::optional<station_refusal> refusal_in(const station_answer& answer);

// Why there was no answer, for people. Of MEWTOCOL with the result code of SEND and RECV (FP7 manual 7.3.2 note 4).
std::string reason_of(const station_question& asked, const boost::system::error_code& why);

}  // namespace plcgw
