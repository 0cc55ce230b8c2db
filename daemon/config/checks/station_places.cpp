#include "daemon/config/checks/checks.hpp"
#include "daemon/config/checks/route_cuts.hpp"

namespace plcgw::config {
namespace {

constexpr unsigned most_words = 1024;             // of a DDS sample
constexpr unsigned most_numbered_contacts = 128;  // T and C: eight in a command, 16 commands in a row on the line

std::string lacks(std::string_view key, std::string_view meaning)
{
    return std::string("lacks \"").append(key).append("\": ").append(meaning);
}

std::size_t check_modbus(check_context& c, std::size_t i, const route_config& r)
{
    if (!r.table)
        c.complain(item("routes", i), lacks("table", "where the values are in its MODBUS station"));
    if (!r.first)
        c.complain(item("routes", i), lacks("first", "the address of the first one in its MODBUS station"));
    if (!r.source.empty())
        c.complain(item("routes", i, "source"),
                   "belongs to MEWTOCOL, but the station's line speaks MODBUS: give \"table\" and \"first\"");
    if (!r.table || !r.first)
        return 1;
    const bool bits = modbus::is_bit_table(*r.table);
    const bool writable = *r.table == modbus::table::coils || *r.table == modbus::table::holding_registers;
    if (writes(r.way) && !writable)
        c.complain(item("routes", i, "table"), "is read-only in MODBUS: a write route needs coil or holding");
    const unsigned most = !writes(r.way) ? (bits ? modbus::max_read_bits : modbus::max_read_registers)
                                         : (bits ? modbus::max_write_coils : modbus::max_write_registers);
    if (r.count > most)
        c.complain(item("routes", i, "count"), "is " + std::to_string(r.count) + ", but one MODBUS request carries " +
                                                   std::to_string(most) + ": split the route");
    if (*r.first + r.count > 65'536)
        c.complain(item("routes", i, "count"), "goes beyond address 65535");
    return bits ? r.count : std::size_t{16} * r.count;
}

bool is_expressible(const mewtocol::block& b, const line_config& line)
{
    if (line.protocol == line_protocol::mewtocol7_com)
        return mewtocol::plan(b, line.mewtocol.dialect).has_value();
    return mewtocol::plan(b, mewtocol::headers::automatic).has_value();
}

// Why no command does it: the first thing that an engineer can change.
std::string inexpressible(const route_config& r, const mewtocol::device& first, const line_config& line, direction way)
{
    const std::string name = mewtocol::to_string(first);
    const bool seven = line.protocol == line_protocol::mewtocol7_com;
    route_config one = r;
    one.count = 1;
    if (mewtocol::is_contact(first) && seven && way == direction::write) {
        const bool whole = mewtocol::number(first) % 16 == 0 && r.count % 16 == 0;
        if (!whole)
            return "is " + name + ", but MEWTOCOL7-COM writes contacts as whole words: begin at bit 0 and give " +
                   "\"count\" a multiple of 16, or write the words";
    }
    if (is_expressible(block_of(one, first, way), line))
        return "is " + name + ", but from there the count goes beyond what " +
               (seven ? "MEWTOCOL7-COM" : "MEWTOCOL-COM") + " can address";
    return "is " + name + ", which " + (seven ? "MEWTOCOL7-COM" : "MEWTOCOL-COM") + " cannot " +
           (way == direction::read ? "read" : "write");
}

void check_commands(check_context& c, std::size_t i, const route_config& r, const mewtocol::device& first,
                    const line_config& line)
{
    for (const direction way : {direction::read, direction::write}) {
        const bool is_wanted = way == direction::read ? reads(r.way) : writes(r.way);
        if (!is_wanted || is_expressible(block_of(r, first, way), line))
            continue;
        c.complain(item("routes", i, "source"), inexpressible(r, first, line, way));
        return;
    }
}

std::size_t check_mewtocol(check_context& c, std::size_t i, const route_config& r, const line_config& line)
{
    if (r.table || r.first)
        c.complain(item("routes", i, r.table ? "table" : "first"),
                   "belongs to MODBUS, but the station's line speaks MEWTOCOL: give \"source\", for example DT100");
    if (r.source.empty()) {
        c.complain(item("routes", i), lacks("source", "the first device in its MEWTOCOL station, for example DT100"));
        return 1;
    }
    const auto first = mewtocol::parse_device(r.source);
    if (!first) {
        c.complain(item("routes", i, "source"),
                   "is \"" + r.source + "\", expected a device such as DT100, LD5, WR3, R1F (word 1, bit F) or T12");
        return 1;
    }
    const auto* const contact = std::get_if<mewtocol::contact>(&*first);
    const bool numbered = contact != nullptr && mewtocol::is_numbered(contact->area);
    const unsigned most = numbered ? most_numbered_contacts : most_words;
    if ((contact == nullptr || numbered) && r.count > most)
        c.complain(item("routes", i, "count"),
                   "is " + std::to_string(r.count) + ", but a route carries " + std::to_string(most) +
                       (numbered ? " contacts of timers or counters" : " words") + ": split it");
    else
        check_commands(c, i, r, *first, line);
    return contact != nullptr ? r.count : std::size_t{16} * r.count;
}

}  // namespace

std::size_t check_station_place(check_context& c, std::size_t i, const route_config& r, const line_config* line)
{
    if (line != nullptr && is_mewtocol(line->protocol))
        return check_mewtocol(c, i, r, *line);
    // Of a station or line that does not exist nobody knows what it speaks.
    if (line == nullptr && !r.source.empty())
        return 1;
    return check_modbus(c, i, r);
}

}  // namespace plcgw::config
