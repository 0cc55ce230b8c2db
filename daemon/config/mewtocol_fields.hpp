// How the settings of a MEWTOCOL line are written in JSON, as fields.hpp says it of the others.
#pragma once

#include "daemon/config/mewtocol_config.hpp"
#include "daemon/config/rules.hpp"

namespace plcgw::config {

inline constexpr choice<mewtocol_commands> mewtocol_command_sets[] = {{"fp7", mewtocol_commands::fp7},
                                                                      {"all", mewtocol_commands::all}};
inline constexpr choice<mewtocol7::number_base> number_bases[] = {{"decimal", mewtocol7::number_base::decimal},
                                                                  {"hexadecimal", mewtocol7::number_base::hexadecimal}};
inline constexpr choice<mewtocol7::byte_order> byte_orders[] = {
    {"low-byte-first", mewtocol7::byte_order::low_byte_first},
    {"high-byte-first", mewtocol7::byte_order::high_byte_first}};

// The rows of the dialect's devices, in their order.
inline constexpr const char* dialect_device_keys[] = {"dt", "ld", "wx", "wy", "wr", "wl"};

template <class Visitor>
void describe(Visitor& v, mewtocol7::dialect& c)
{
    v.optional("item", c.item, "MMRD, MMWT: text in front of the scope", text{0, 16});
    v.optional("scope", c.scope, "MMRD, MMWT: text in front of the device", text{0, 16});
    v.optional("address_digits", c.address_digits, "Digits of a device's number", range{1, 8});
    v.optional("count_digits", c.count_digits, "Digits of the number of words", range{1, 8});
    v.optional("base", c.base, "How both numbers are written", number_bases);
    v.optional("words", c.words, "Which byte of a word comes first", byte_orders);
    v.optional("before_words", c.before_words, "MMRD response: text between the name and the words", text{0, 16});
    v.optional("before_error", c.before_error, "Error response: text between ! and the code", text{0, 16});
    v.optional("before_piece", c.before_piece, "Later frames of a response: text in front of the data", text{0, 16});
    for (std::size_t i = 0; i < std::size(dialect_device_keys); ++i)
        v.optional(dialect_device_keys[i], c.devices[i].name, "Name of this area", text{1, 8});
}

template <class Visitor>
void describe(Visitor& v, mewtocol_config& c)
{
    v.optional("commands", c.commands,
               "What the PLC answers: fp7 as the manual lists it; all adds RS, WS, RK, WK and RM",
               mewtocol_command_sets);
    v.optional("expansion", c.expansion, "Knows the header < of frames up to 2048 characters");
    v.optional("several_frames", c.several_frames, "Knows messages in several frames with the header %");
    v.optional("rest_kept_ms", c.rest_kept, "Milliseconds until the unfetched rest of a response is forgotten",
               range{100, 600'000});
    v.optional("max_contacts", c.max_contacts, "Contacts that MC registers at most", range{1, 1016});
    v.optional("max_words", c.max_words, "Words that MD registers at most", range{1, 63});
    v.optional("dialect", c.dialect, "What is not published about MEWTOCOL7-COM: docs/mewtocol.md");
}

}  // namespace plcgw::config
