#include "daemon/config/check.hpp"

#include "bridge/plc/adprw_program.hpp"
#include "bridge/plc/simulated_plc.hpp"
#include "daemon/config/device_check.hpp"
#include "daemon/config/ip_address.hpp"
#include "daemon/config/program_file.hpp"
#include "daemon/config/reader.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

namespace plcgw::config {
namespace {

// One spelling of each path. Symbolic links stay: their ports come and go.
std::filesystem::path port_of(const line_config& l) { return std::filesystem::path(l.device).lexically_normal(); }

// As daemon/gateway.cpp calls it in DDS: "main.D0".
std::string block_name(const std::string& plc, const plc::model& model, plc::device head)
{
    return plc + "." + plc::to_string(head, model.names);
}

// The devices that a row of the configuration takes in a PLC's memory.
struct occupied {
    std::string plc;
    plc::place at;
    std::size_t bits;
    std::string by;
};

std::string item(const char* list, std::size_t index, const char* key = nullptr)
{
    std::string pointer = std::string("/") + list + "/" + std::to_string(index);
    return key == nullptr ? pointer : pointer + "/" + key;
}

class checker {
public:
    checker(const gateway_config& c, const located_json& file, const std::string& folder, mistakes& found)
        : c_(c), file_(file), folder_(folder), found_(found)
    {
        for (const mistake& each : found)
            unread_.insert(each.pointer);
    }

    void run()
    {
        unique_names("plcs", c_.plcs);
        unique_names("lines", c_.lines);
        unique_names("stations", c_.stations);
        unique_names("routes", c_.routes);
        for (std::size_t i = 0; i < c_.plcs.size(); ++i)
            check_plc(i, c_.plcs[i]);
        for (std::size_t i = 0; i < c_.lines.size(); ++i)
            check_line(i, c_.lines[i]);
        for (std::size_t i = 0; i < c_.stations.size(); ++i)
            check_station(i, c_.stations[i]);
        for (std::size_t i = 0; i < c_.routes.size(); ++i)
            check_route(i, c_.routes[i]);
        for (std::size_t i = 0; i < c_.modbus_tcp.size(); ++i)
            check_server(i, c_.modbus_tcp[i]);
        check_peers();
        check_blocks();
    }

private:
    void complain(const std::string& at, std::string what, mistake::weight how = mistake::weight::error)
    {
        found_.push_back({at, file_.line_of(at), std::move(what), how});
    }

    template <class Row>
    void unique_names(const char* list, const std::vector<Row>& rows)
    {
        std::set<std::string> seen;
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (!rows[i].name.empty() && !seen.insert(rows[i].name).second)
                complain(item(list, i, "name"), "\"" + rows[i].name + "\" stands twice: give each its own name");
    }

    // Nothing in this row was complained about while it was read: no default stands in for what was meant.
    bool is_sound(const std::string& row) const
    {
        const auto inside = unread_.lower_bound(row + "/");
        return !unread_.contains(row) && (inside == unread_.end() || !inside->starts_with(row + "/"));
    }

    const plc_config* find_plc(const std::string& name, const std::string& at)
    {
        return find("plcs", c_.plcs, "PLC", name, at);
    }

    // The row with this name. An absent name was already complained about, here or in the list.
    template <class Row>
    const Row* find(const char* list, const std::vector<Row>& rows, const char* what, const std::string& name,
                    const std::string& at)
    {
        std::vector<std::string> known;
        for (const Row& each : rows) {
            if (each.name == name)
                return &each;
            known.push_back(each.name);
        }
        const bool unread = std::find(known.begin(), known.end(), "") != known.end();
        if (name.empty() || unread || (rows.empty() && !is_sound(std::string("/") + list)))
            return nullptr;
        const std::string meant = nearest(name, known);
        std::string cure = meant.empty() ? std::string("add it") : "did you mean \"" + meant + "\"?";
        complain(at, "names the " + std::string(what) + " \"" + name + "\", which does not exist: " + cure);
        return nullptr;
    }

    void check_plc(std::size_t i, const plc_config& p)
    {
        const plc::model* const model = plc::find_model(p.model);
        if (model == nullptr) {
            std::string known;
            for (const plc::model* each : plc::all_models())
                known.append(known.empty() ? "" : ", ").append(each->name);
            complain(item("plcs", i, "model"), "is \"" + p.model + "\", expected one of: " + known);
            return;
        }
        if (!p.program.empty() && !p.program_file.empty())
            complain(item("plcs", i, "program_file"), "stands beside \"program\": keep one of them");
        const auto program = program_text(p, folder_);
        if (!program) {
            complain(item("plcs", i, "program_file"), "names \"" + p.program_file + "\", which cannot be read");
            return;
        }
        if (!model->programs && !(p.program.empty() && p.program_file.empty()))
            complain(item("plcs", i, p.program.empty() ? "program_file" : "program"),
                     "does not belong to a " + std::string(model->name) +
                         ", which has neither D8400-D8485 nor ADPRW: remove it, the lines say how it communicates");
        else if (is_sound(item("plcs", i, "program")))
            check_program(i, p, *model, *program);
        check_channels(i, p, *model);
    }

    void check_program(std::size_t i, const plc_config& p, const plc::model& model, const std::string& text)
    {
        plc::setup_program program = plc::parse_setup_program(text);
        for (const plc::program_mistake& m : program.mistakes)
            complain_program(i, p, m.line, m.text, mistake::weight::error);
        for (const plc::program_mistake& m : plc::parse_adprw_program(text).mistakes)
            complain_program(i, p, m.line, m.text, mistake::weight::error);
        const plc::simulated_plc powered_on(p.name, model, std::move(program));
        for (const plc::setup_fault& fault : powered_on.faults())
            complain_program(i, p, fault.what.line,
                             fault.what.reason + "; the PLC runs without it and shows error " +
                                 std::to_string(static_cast<unsigned>(fault.code)) + " with detail " +
                                 std::to_string(fault.what.detail) + shown_in(model, fault.channel),
                             mistake::weight::warning);
    }

    // " in D8402 and D8403", as far as the model has them.
    static std::string shown_in(const plc::model& model, unsigned channel)
    {
        for (const plc::channel& each : model.channels)
            if (each.number == channel && each.registers.error_detail != 0)
                return " in D" + std::to_string(each.registers.error_code) + " and D" +
                       std::to_string(each.registers.error_detail);
        return {};
    }

    void check_channels(std::size_t i, const plc_config& p, const plc::model& model)
    {
        for (std::size_t n = 0; n < p.channels.size(); ++n) {
            const std::string at = item("plcs", i, "channels") + "/" + std::to_string(n);
            const auto* const line = find("lines", c_.lines, "line", p.channels[n].line, at + "/line");
            if (line != nullptr && line->role != line_role::client)
                complain(at + "/line",
                         "is a server line: a PLC asks on a client line; on a server line give it a unit");
            const bool exists = std::any_of(model.channels.begin(), model.channels.end(), [&](const plc::channel& c) {
                return c.number == p.channels[n].channel && c.client;
            });
            if (!exists && is_sound(at))
                complain(at + "/channel", "is " + std::to_string(p.channels[n].channel) + ", where a " +
                                              std::string(model.name) + " cannot be client");
        }
    }

    void complain_program(std::size_t i, const plc_config& p, std::size_t line, const std::string& what,
                          mistake::weight how)
    {
        if (!p.program_file.empty()) {
            complain(item("plcs", i, "program_file"), p.program_file + " line " + std::to_string(line) + ": " + what,
                     how);
            return;
        }
        const std::string row = line == 0 ? "" : "/" + std::to_string(line - 1);
        complain(item("plcs", i, "program") + row, what, how);
    }

    void check_line(std::size_t i, const line_config& l)
    {
        const bool serial = l.protocol == line_protocol::modbus_rtu;
        if (is_sound(item("lines", i)) && (serial ? l.device : l.host).empty())
            complain(item("lines", i), serial ? "lacks \"device\": the path of a serial port"
                                              : "lacks \"host\": the address of a MODBUS TCP server");
        if (l.role == line_role::server)
            check_server_line(i, l, serial);
        else if (!l.units.empty() && is_sound(item("lines", i)))
            complain(item("lines", i, "units"), "stands at a client line: its stations are listed under \"stations\"");
        if (l.data_bits != 8)
            complain(item("lines", i, "data_bits"), "is 7, but MODBUS RTU needs 8 data bits");
        for (std::size_t other = 0; other < i; ++other)
            if (!l.device.empty() && port_of(c_.lines[other]) == port_of(l))
                complain(item("lines", i, "device"),
                         "is already the device of line \"" + c_.lines[other].name + "\": a port belongs to one line");
    }

    void check_server_line(std::size_t i, const line_config& l, bool serial)
    {
        if (!serial)
            complain(item("lines", i, "role"), "is server, but a MODBUS TCP server stands under \"modbus_tcp\"");
        if (l.units.empty() && is_sound(item("lines", i)))
            complain(item("lines", i), "serves nobody: give \"units\"");
        check_units(item("lines", i, "units"), l.units);
        for (std::size_t u = 0; u < l.units.size(); ++u) {
            const std::string at = item("lines", i, "units") + "/" + std::to_string(u);
            if (!l.units[u].line.empty())
                complain(at + "/line", "forwards from a serial line, which this version cannot: give \"plc\"");
            if (l.units[u].unit < 1 || l.units[u].unit > 247)
                complain(at + "/unit", "is not within 1 to 247, the unit ids of a serial line");
            check_unit_channel(at, l.units[u]);
        }
    }

    void check_unit_channel(const std::string& at, const unit_config& unit)
    {
        const plc::model* const model = model_of(unit.plc);
        if (model == nullptr)
            return;
        const bool exists = std::any_of(model->channels.begin(), model->channels.end(),
                                        [&](const plc::channel& c) { return c.number == unit.channel; });
        if (!exists)
            complain(at + "/channel", "is a channel that a " + std::string(model->name) + " does not have");
    }

    void check_units(const std::string& list, const std::vector<unit_config>& units)
    {
        std::set<unsigned> seen;
        for (std::size_t u = 0; u < units.size(); ++u) {
            const std::string at = list + "/" + std::to_string(u);
            if (!units[u].plc.empty())
                find_plc(units[u].plc, at + "/plc");
            if (!units[u].line.empty())
                check_client_line(units[u].line, at + "/line");
            if (is_sound(at) && units[u].plc.empty() == units[u].line.empty())
                complain(at, "leads " + std::string(units[u].plc.empty() ? "nowhere" : "to two places") +
                                 ": give either \"plc\" or \"line\"");
            if (is_sound(at) && !seen.insert(units[u].unit).second)
                complain(at + "/unit", "stands twice: a unit id leads to one place");
        }
    }

    void check_client_line(const std::string& name, const std::string& at)
    {
        const auto* const line = find("lines", c_.lines, "line", name, at);
        if (line != nullptr && line->role != line_role::client)
            complain(at, "is a server line: nobody can be asked there");
    }

    void check_station(std::size_t i, const station_config& s)
    {
        check_client_line(s.line, item("stations", i, "line"));
        for (std::size_t other = 0; other < i; ++other)
            if (c_.stations[other].line == s.line && c_.stations[other].unit == s.unit &&
                is_sound(item("stations", i)) && is_sound(item("stations", other)))
                complain(item("stations", i, "unit"),
                         "is already the unit id of station \"" + c_.stations[other].name + "\" on the same line");
    }

    void check_route(std::size_t i, const route_config& r)
    {
        const auto* const from = find("stations", c_.stations, "station", r.station, item("routes", i, "station"));
        if (!is_sound(item("routes", i))) {
            check_devices(item("routes", i), r.plc, r.device, 1);
            return;
        }
        if (from != nullptr && from->unit == 0 && r.way == direction::read)
            complain(item("routes", i, "station"),
                     "is unit 0, the broadcast: nobody answers, only write routes can use it");
        check_request(i, r);
        const std::size_t bits = modbus::is_bit_table(r.table) ? r.count : std::size_t{16} * r.count;
        const auto at = check_devices(item("routes", i), r.plc, r.device, bits);
        if (at && r.way == direction::read) {
            if (const std::string why = status_mistake(*model_of(r.plc), *at, bits); !why.empty())
                complain(item("routes", i, "device"), why);
            check_overlap(item("routes", i, "device"), {r.plc, *at, bits, r.name});
        }
    }

    // Null when the PLC or its model does not exist, of which somebody else complains.
    const plc::model* model_of(const std::string& plc) const
    {
        const auto owner =
            std::find_if(c_.plcs.begin(), c_.plcs.end(), [&](const plc_config& each) { return each.name == plc; });
        return owner == c_.plcs.end() ? nullptr : plc::find_model(owner->model);
    }

    void check_request(std::size_t i, const route_config& r)
    {
        const bool bits = modbus::is_bit_table(r.table);
        const bool writable = r.table == modbus::table::coils || r.table == modbus::table::holding_registers;
        if (r.way == direction::write && !writable)
            complain(item("routes", i, "table"), "is read-only in MODBUS: a write route needs coil or holding");
        const unsigned most = r.way == direction::read ? (bits ? modbus::max_read_bits : modbus::max_read_registers)
                                                       : (bits ? modbus::max_write_coils : modbus::max_write_registers);
        if (r.count > most)
            complain(item("routes", i, "count"), "is " + std::to_string(r.count) + ", but one MODBUS request carries " +
                                                     std::to_string(most) + ": split the route");
        if (r.first + r.count > 65'536)
            complain(item("routes", i, "count"), "goes beyond address 65535");
    }

    std::optional<plc::place> check_devices(const std::string& row, const std::string& plc, const std::string& device,
                                            std::size_t bits)
    {
        const plc_config* const owner = find_plc(plc, row + "/plc");
        const plc::model* const model = owner == nullptr ? nullptr : plc::find_model(owner->model);
        found_devices found = find_devices(model, device, bits);
        if (!found.mistake.empty())
            complain(row + "/device", std::move(found.mistake));
        return found.at;
    }

    void check_overlap(const std::string& at, occupied taken)
    {
        for (const occupied& other : occupied_)
            if (other.plc == taken.plc && other.at.area == taken.at.area && other.at.bit < taken.at.bit + taken.bits &&
                taken.at.bit < other.at.bit + other.bits)
                complain(at, "overlaps with the devices of route \"" + other.by + "\": each device has one source");
        occupied_.push_back(std::move(taken));
    }

    void check_server(std::size_t i, const tcp_server_config& s)
    {
        if (!ip_address(s.listen))
            complain(item("modbus_tcp", i, "listen"),
                     "is \"" + s.listen + "\", expected an IP address such as 0.0.0.0");
        check_port(i, s);
        const bool is_line = std::any_of(c_.lines.begin(), c_.lines.end(),
                                         [&](const line_config& each) { return each.name == s.other_units; });
        if (is_line)
            check_client_line(s.other_units, item("modbus_tcp", i, "other_units"));
        else if (!s.other_units.empty())
            find_plc(s.other_units, item("modbus_tcp", i, "other_units"));
        if (s.units.empty() && s.other_units.empty() && is_sound(item("modbus_tcp", i)))
            complain(item("modbus_tcp", i), "leads to no PLC: give \"units\" or \"other_units\"");
        check_units(item("modbus_tcp", i, "units"), s.units);
    }

    void check_port(std::size_t i, const tcp_server_config& s)
    {
        const auto address = ip_address(s.listen);
        for (std::size_t other = 0; other < i; ++other) {
            const auto taken = ip_address(c_.modbus_tcp[other].listen);
            if (c_.modbus_tcp[other].port != s.port || !address || !taken || !exclude_each_other(*address, *taken))
                continue;
            if (is_sound(item("modbus_tcp", i)) && is_sound(item("modbus_tcp", other)))
                complain(item("modbus_tcp", i, "port"), "is " + std::to_string(s.port) + ", which " +
                                                            item("modbus_tcp", other) +
                                                            " takes already: listen on another port or address");
        }
    }

    // Cyclone runs on IPv4 here; it would look up a name while the gateway waits.
    void check_peers()
    {
        for (std::size_t i = 0; i < c_.dds.settings.peers.size(); ++i) {
            const std::string& peer = c_.dds.settings.peers[i];
            const auto address = ip_address(peer);
            if (!peer.empty() && (!address || !address->is_v4()))
                complain("/dds/peers/" + std::to_string(i),
                         "is \"" + peer + "\", expected an IPv4 address such as 192.168.1.5, not a name");
        }
    }

    void check_blocks()
    {
        std::set<std::string> seen;
        for (std::size_t i = 0; i < c_.dds.blocks.size(); ++i) {
            const block_config& b = c_.dds.blocks[i];
            const std::string row = "/dds/blocks/" + std::to_string(i);
            const plc::model* const model = model_of(b.plc);
            const auto device = model == nullptr ? std::nullopt : plc::parse_device(b.device, model->names);
            const bool bits = device && plc::is_bit_kind(device->kind);
            const std::size_t size = bits ? b.count : std::size_t{16} * b.count;
            if (!check_devices(row, b.plc, b.device, is_sound(row) ? size : 1))
                continue;
            const std::string name = block_name(b.plc, *model, *device);
            if (name.size() > name_rule.most)
                complain(row + "/plc", "makes \"" + name + "\", which is longer than the " +
                                           std::to_string(name_rule.most) +
                                           " bytes of a DDS name: shorten the PLC's name");
            else if (!seen.insert(name).second)
                complain(row + "/device", "makes \"" + name + "\" a second time: raise the count of the first one");
        }
    }

    const gateway_config& c_;
    const located_json& file_;
    const std::string& folder_;
    mistakes& found_;
    std::set<std::string> unread_;  // where the reader found mistakes
    std::vector<occupied> occupied_;
};

}  // namespace

void check(const gateway_config& c, const located_json& file, const std::string& folder, mistakes& found)
{
    checker(c, file, folder, found).run();
}

}  // namespace plcgw::config
