// The devices of a simulated FP7 that MEWTOCOL-COM reaches.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace plcgw::field {

enum class fp7_area : std::uint8_t { x, y, r, l, t, c, dt, ld };  // x to c: contacts, sixteen in a word

struct fp7_area_row {
    fp7_area area;
    char letter;             // in a command
    std::string_view view;   // the area's name in words; T and C have none
    bool numbered_in_words;  // R12 is bit 2 of word 1, T12 is the twelfth
    bool writable;           // by commands for contacts
    std::size_t words;
};

// clang-format off
inline constexpr std::array fp7_contacts{
    fp7_area_row{fp7_area::x, 'X', "WX", true,  false, 512},
    fp7_area_row{fp7_area::y, 'Y', "WY", true,  true,  512},
    fp7_area_row{fp7_area::r, 'R', "WR", true,  true,  2048},
    fp7_area_row{fp7_area::l, 'L', "WL", true,  true,  1024},
    fp7_area_row{fp7_area::t, 'T', "",   false, false, 256},
    fp7_area_row{fp7_area::c, 'C', "",   false, false, 64}};
inline constexpr std::array fp7_data{
    fp7_area_row{fp7_area::dt, 'D', "DT", true, true, 65536},
    fp7_area_row{fp7_area::ld, 'L', "LD", true, true, 16384}};
// clang-format on

class fp7_memory {
public:
    fp7_memory();

    std::uint16_t& word(fp7_area area, std::size_t number) { return areas_[index(area)][number]; }  // in its area
    bool contact(fp7_area area, std::size_t word, unsigned bit) const { return areas_[index(area)][word] >> bit & 1; }
    void set_contact(fp7_area area, std::size_t word, unsigned bit, bool on);

    // "DT100=5,0x10", "WR2=32769", "R1F=1", "T99=1": a device and the values from there on.
    // Throws std::invalid_argument.
    void assign(const std::string& assignment);

private:
    static std::size_t index(fp7_area area) { return static_cast<std::size_t>(area); }

    std::array<std::vector<std::uint16_t>, fp7_contacts.size() + fp7_data.size()> areas_;
};

}  // namespace plcgw::field
