// MEWTOCOL-COM and MEWTOCOL7-COM commands on the memory of a device. FP7 serial communication manual 7.2.
#pragma once

#include "bridge/services/mewtocol_access.hpp"
#include "protocols/mewtocol/mewtocol7_server.hpp"
#include "protocols/mewtocol/server.hpp"

namespace plcgw {

// What MC and MD registered and MG reads. It belongs to a line of a station, and is lost at power-off.
struct mewtocol_registrations {
    std::size_t max_contacts = 80;  // at most 1016
    std::size_t max_words = 16;     // at most 63
    std::vector<mewtocol::contact> contacts{};
    std::vector<mewtocol::data_item> words{};
    std::uint64_t scans_seen = 0;  // of the device, at the last MG, or when the first was registered
};

mewtocol::response serve(const mewtocol::command& asked, mewtocol_access& device, mewtocol_registrations& registered);
mewtocol7::response serve(const mewtocol7::command& asked, mewtocol_access& device);

// From what a line's framer brought to the bytes that are sent; nothing if nobody answers.
std::optional<buffer> reply_to(const mewtocol::reception& r, time_point now, mewtocol::server& station,
                               mewtocol_access& device, mewtocol_registrations& registered);
std::optional<buffer> reply_to(const mewtocol::reception& r, time_point now, mewtocol7::server& station,
                               mewtocol_access& device);

}  // namespace plcgw
