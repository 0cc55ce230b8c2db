// A row of the routing table: registers, words or bits of a station, and the devices of a PLC that they belong to.
#pragma once

#include "bridge/plc/simulated_plc.hpp"
#include "bridge/routes/quality.hpp"
#include "bridge/routes/station_question.hpp"
#include "bridge/sample.hpp"

namespace plcgw {

enum class direction : std::uint8_t {
    read,            // station -> PLC, every period
    write,           // PLC -> station, when the PLC's devices change
    read_write,      // both: read every period, and written when somebody else changes the PLC's devices
    write_through,   // as write, but whoever writes by MODBUS TCP hears what the station said to it
    periodic_write,  // as write, and every period although nothing changed, once somebody wrote the PLC's devices
};

constexpr bool reads(direction d) { return d == direction::read || d == direction::read_write; }
constexpr bool writes(direction d) { return d != direction::read; }

struct route {
    std::string name;
    plc::simulated_plc* plc = nullptr;
    plc::place at;          // the first device, in the PLC's memory
    station_place there;    // the first register, word or bit, in the station
    std::uint16_t count{};  // of these; over MODBUS at most what one request carries
    direction way = direction::read;

    quality state = quality::never_read;
    wall_time source = wall_time::never;
    std::vector<std::uint16_t> words;  // as the station said last: registers, or bits packed by 16
    std::string reason;                // of a quality that is not good, for the log and the status page
    std::uint16_t reason_code = 0;     // the same as a number: route_status.hpp
    std::uint32_t answers = 0;         // good ones
    std::uint32_t errors = 0;          // exceptions, and questions without an answer

    // What the memory shows when the station is lost, packed as `words`; empty: what was read last.
    std::vector<std::uint16_t> substitute{};
};

// Bits of memory that a route covers: 16 for each register or word of the station, whatever the PLC's device is.
std::size_t bits_of(const route& r);

bool touches(const route& r, const plc::simulated_plc& plc, const plc::change& changed);

station_question question_of(const route& r);  // a read, or a write of what the memory holds now

// A good answer to that question: what was read goes into the memory, what was said either way into the route's words.
void store(route& r, const station_question& question, const station_answer& answer);

// The devices in memory, packed as the route's words.
std::vector<std::uint16_t> words_in_memory(const route& r);

// The other way round; no sign of life of who writes there.
void put_words(const route& r, const std::vector<std::uint16_t>& words);

// The substitute goes into memory and words. It is no sign of life of who writes there.
void show_substitute(route& r);

sample sample_of(const route& r);

}  // namespace plcgw
