// What somebody else's question means for the registers of a station: which it reads, and which it writes with what.
#pragma once

#include "bridge/routes/station_question.hpp"

namespace plcgw {

struct asked_registers {
    station_place first;
    std::uint32_t count{};
};

struct written_registers {
    station_place first;
    std::vector<std::uint16_t> values;  // of registers and words; of bits 0 or 1 each
};

// Function 17H has both. A mask (16H) says what changes, not what comes of it: neither.
std::optional<asked_registers> read_in(const station_question& asked);
std::optional<written_registers> written_in(const station_question& asked);

bool is_in_one_area(const station_place& a, const station_place& b);

// Registers [first, first + count) of a place hold all of the other ones.
bool covers(const station_place& first, std::uint32_t count, const station_place& others, std::uint32_t of_these);
bool overlap(const station_place& first, std::uint32_t count, const station_place& others, std::uint32_t of_these);

// The words of a route, packed as there (16 bits in each if it has bits), with what was written into its registers.
void overlay(std::vector<std::uint16_t>& words, const station_place& first, std::uint32_t count,
             const written_registers& written);

}  // namespace plcgw
