// MEWTOCOL-COM commands as structs. The bytes: FP7 serial communication manual 7.2.1 and 11.2, FP0H Ethernet
// manual 11.4.
#pragma once

#include "protocols/mewtocol/types.hpp"

#include <boost/system/result.hpp>

#include <initializer_list>
#include <variant>
#include <vector>

namespace plcgw::mewtocol {

struct read_contact {  // RCS
    contact at{};
    bool operator==(const read_contact&) const = default;
};

struct read_contacts {  // RCP: 1 to 8
    std::vector<contact> at;
    bool operator==(const read_contacts&) const = default;
};

struct contact_value {
    contact at{};
    bool on{};
    bool operator==(const contact_value&) const = default;
};

struct write_contact {  // WCS: Y, R or L
    contact_value value{};
    bool operator==(const write_contact&) const = default;
};

struct write_contacts {  // WCP: 1 to 8
    std::vector<contact_value> values;
    bool operator==(const write_contacts&) const = default;
};

struct read_words {  // RCC, RD, RS, RK, RR, as the area wants it
    word_area from{};
    std::uint32_t first{};
    std::uint32_t count{};
    bool operator==(const read_words&) const = default;
};

struct write_words {  // WCC, WD, WS, WK, WR
    word_area to{};
    std::uint32_t first{};
    std::vector<std::uint16_t> values;
    bool operator==(const write_words&) const = default;
};

struct fill_words {  // SC, SD: one word over the range
    word_area to{};
    std::uint32_t first{};
    std::uint32_t count{};
    std::uint16_t value{};
    bool operator==(const fill_words&) const = default;
};

struct register_contacts {  // MC
    std::vector<contact> items;
    bool operator==(const register_contacts&) const = default;
};

struct forget_contacts {  // MC FFFFF
    bool operator==(const forget_contacts&) const = default;
};

struct data_item {
    word_area area{};
    std::uint32_t number{};
    bool operator==(const data_item&) const = default;
};

struct register_data {  // MD
    std::vector<data_item> items;
    bool operator==(const register_data&) const = default;
};

struct forget_data {  // MD FFFFFF
    bool operator==(const forget_data&) const = default;
};

struct monitor {  // MG: what MC and MD registered
    bool operator==(const monitor&) const = default;
};

enum class operating_mode : char { run = 'R', prog = 'P' };

struct change_mode {  // RM
    operating_mode to{};
    bool operator==(const change_mode&) const = default;
};

struct read_status {  // RT
    bool operator==(const read_status&) const = default;
};

struct read_extended_status {  // EX00RT
    bool operator==(const read_extended_status&) const = default;
};

struct abort_transfer {  // AB: gives up a response in several frames. Nobody answers it
    bool operator==(const abort_transfer&) const = default;
};

using command = std::variant<read_contact, read_contacts, write_contact, write_contacts, read_words, write_words,
                             fill_words, register_contacts, forget_contacts, register_data, forget_data, monitor,
                             change_mode, read_status, read_extended_status, abort_transfer>;

// The two letters that a command begins with and a response repeats.
enum class command_code : std::uint8_t { RC, WC, RD, WD, RS, WS, RK, WK, MC, MD, MG, SC, SD, RR, WR, RM, RT, EX, AB };

std::string_view to_string(command_code c);
std::optional<command_code> command_code_named(std::string_view two_letters);
command_code code_of(const command& c);

// What a device offers: everything else is answered with `!42`.
class command_set {
public:
    constexpr command_set(std::initializer_list<command_code> codes)
    {
        for (const command_code c : codes)
            bits_ |= 1U << static_cast<unsigned>(c);
    }
    constexpr bool contains(command_code c) const { return (bits_ >> static_cast<unsigned>(c) & 1U) != 0; }

private:
    std::uint32_t bits_ = 0;
};

// The list of 7.2.1.
inline constexpr command_set fp7_commands{command_code::RC, command_code::WC, command_code::RD, command_code::WD,
                                          command_code::MC, command_code::MD, command_code::MG, command_code::SC,
                                          command_code::SD, command_code::RT, command_code::AB};

// FP programming manual 40.11.
inline constexpr command_set all_commands{command_code::RC, command_code::WC, command_code::RD, command_code::WD,
                                          command_code::RS, command_code::WS, command_code::RK, command_code::WK,
                                          command_code::MC, command_code::MD, command_code::MG, command_code::SC,
                                          command_code::SD, command_code::RR, command_code::WR, command_code::RM,
                                          command_code::RT, command_code::EX, command_code::AB};

inline constexpr std::size_t max_contacts = 8;  // of RCP and WCP

// The text behind `#`. Fails with the code that the server answers: 42 for a command that is not offered, 41 for its
// form, 60 for areas, 61 for numbers, ranges and digits. What the memory holds is the memory's business.
boost::system::result<command, error_code> parse_command(std::string_view text, const command_set& offered);

// Whether the numbers fit into the digits of their fields and the area has such a command. A DT from 100000 on does
// not.
bool is_expressible(const command& c);

std::string encode_command(const command& c);  // the text behind `#`; c is expressible

bool is_write(const command& c);  // changes something: what a global station may be told

}  // namespace plcgw::mewtocol
