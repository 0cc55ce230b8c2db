// Areas as MEWTOCOL writes them, in the memory of an FP7 (FP7 manual 7.3, 7.4 and 11.2). Of a model that lacks an area,
// every letter of it is unknown.
//
//     RCS X001F     contact_at(memory, 'X', 1, 15)          T0099, C0012    timer_contact_at(memory, 'T', 99)
//     RCC R 1-3     contact_words_at(memory, 'R', 1, 3)     RD D 100-109    data_at(memory, 'D', 100, 10)
//     RS, RK 0-1    value_at(memory, 'S' or 'K', 0), then 1: a word each
//
// The bits of a run follow each other in the memory's image: word i stands 16 * i bits behind the first.
#pragma once

#include "bridge/plc/memory.hpp"

#include <boost/system/result.hpp>

namespace plcgw::plc {

enum class area_fault : std::uint8_t {
    no_such_area,  // the letter is unknown, or stands for another kind of device: MEWTOCOL error 60
    out_of_range,  // a number that the PLC does not have: error 61
};

using area_place = boost::system::result<place, area_fault>;

area_place contact_at(const memory& of, char letter, std::uint32_t word, unsigned bit);  // X Y R L; bit 0 to 15
area_place timer_contact_at(const memory& of, char letter, std::uint32_t number);        // T C

// `count` words of which all must exist, at least one.
area_place contact_words_at(const memory& of, char letter, std::uint32_t first, std::size_t count);  // X Y R L
area_place data_at(const memory& of, char letter, std::uint32_t first, std::size_t count);           // D L
area_place named_words_at(const memory& of, std::string_view name, std::uint32_t first,
                          std::size_t count);  // WX WY WR WL DT LD, as MEWTOCOL7 writes them

// A set value (S) or elapsed value (K). MEWTOCOL-COM has one row of numbers for timers and counters and one word for
// each value; an FP7 has two rows and 32 bits. So the counters follow the timers, C0 is number 4096, and the word is
// the low one.
area_place value_at(const memory& of, char letter, std::uint32_t number);

// Sets the 32-bit value whose low word is there: the high word becomes 0.
void set_value(memory& in, place low_word, std::uint16_t value);

}  // namespace plcgw::plc
