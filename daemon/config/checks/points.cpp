#include "daemon/config/checks/checks.hpp"

namespace plcgw::config {
namespace {

void check_text(check_context& c, const std::string& row, const point_config& p)
{
    if (p.characters == 0)
        c.complain(row, "lacks \"characters\": a text needs room");
    if (turns_registers(p.order))
        c.complain(row + "/order",
                   "turns registers round, but a text knows only ABCD, first character in the high byte, "
                   "and BADC, in the low byte");
}

void check_number(check_context& c, const std::string& row, const point_config& p)
{
    if (p.characters != 0)
        c.complain(row + "/characters", "belongs to the type text");
    if (p.scale == 0)
        c.complain(row + "/scale", "is 0: every value would be the offset");
    if (p.least && p.most && *p.least > *p.most)
        c.complain(row + "/min", "is above \"max\"");
    if (p.deadband_percent != 0 && !(p.least && p.most))
        c.complain(row + "/deadband_percent", "is a part of the span from \"min\" to \"max\": give both");
    if (p.deadband_percent != 0 && p.deadband != 0)
        c.complain(row + "/deadband_percent", "stands beside \"deadband\": give one of them");
}

// Of texts and bits.
void check_no_number(check_context& c, const std::string& row, const point_config& p)
{
    const char* const key = p.scale != 1              ? "scale"
                            : p.offset != 0           ? "offset"
                            : p.least                 ? "min"
                            : p.most                  ? "max"
                            : p.deadband != 0         ? "deadband"
                            : p.deadband_percent != 0 ? "deadband_percent"
                                                      : nullptr;
    if (key != nullptr)
        c.complain(row + "/" + key, "belongs to numbers: a text or bool has none");
}

void check_type(check_context& c, const std::string& row, const point_config& p, bool is_bit_device)
{
    if (p.type == value_type::text)
        check_text(c, row, p);
    else
        check_number(c, row, p);
    if (p.type == value_type::text || p.type == value_type::boolean)
        check_no_number(c, row, p);
    if (p.bit && (p.type != value_type::boolean || is_bit_device))
        c.complain(row + "/bit", p.type != value_type::boolean ? "belongs to the type bool"
                                                               : "stands at a device that is a bit itself");
    if (p.type == value_type::boolean && !p.bit && !is_bit_device)
        c.complain(row, "lacks \"bit\": which one of the word, 0 = lowest");
}

// A long route of a MEWTOCOL station.
void check_cut(check_context& c, const std::string& row, const occupied_devices::taken& by, const char* way)
{
    c.complain(row + "/device", "lies on both sides of the place where " + by.who + " is cut into commands, " +
                                    std::to_string(*by.cut / 16) + " words behind its first: its registers are " + way +
                                    " at different times, and the value could be torn. Split the route so "
                                    "that a route begins with the point");
}

void check_users(check_context& c, const std::string& row, const point_config& p, plc::place at, std::size_t bits,
                 const device_users& users)
{
    for (const auto& each : users.filled.find(p.plc, at, bits)) {
        if (!each.whole)
            c.complain(row + "/device",
                       "lies only partly in the devices of " + each.who +
                           ": its registers would come at different times, and the value could be torn. "
                           "Let one route fill all of them");
        else if (each.cut)
            check_cut(c, row, each, "read");
        else if (p.writable && each.how == occupied_devices::kind::only_source)
            c.complain(row + "/writable", "is true, but " + each.who +
                                              " fills these devices and would undo each write: a "
                                              "route of direction read-write takes it to the station");
    }
    for (const auto& each : users.sent.find(p.plc, at, bits)) {
        if (p.writable && each.cut)
            check_cut(c, row, each, "written");
        if (p.writable && !each.whole)
            c.complain(row + "/device", "lies only partly in the devices of " + each.who +
                                            ": it would be written in two requests, and could be torn. Let one route "
                                            "write all of it");
    }
}

void check_point(check_context& c, device_check& devices, const device_users& users, std::size_t i,
                 const point_config& p)
{
    const std::string row = item("points", i);
    if (!c.is_sound(row)) {
        devices.place_of(row, p.plc, p.device, 1);
        return;
    }
    const plc::model* const model = c.model_of(p.plc);
    const auto device = model == nullptr ? std::nullopt : plc::parse_device(p.device, model->names);
    const bool is_bit_device = device && plc::is_bit_kind(device->kind);
    if (device)
        check_type(c, row, p, is_bit_device);
    const bool is_one_bit = p.type == value_type::boolean && is_bit_device;
    const std::size_t bits = is_one_bit ? 1 : 16 * std::max<std::size_t>(registers_of(p.type, p.characters), 1);
    auto at = devices.place_of(row, p.plc, p.device, bits);
    if (!at)
        return;
    if (p.writable)
        devices.check_filled(row + "/device", p.plc, *at, bits);
    const std::size_t used = p.type == value_type::boolean ? 1 : bits;
    check_users(c, row, p, {at->area, at->bit + p.bit.value_or(0)}, used, users);
}

}  // namespace

void check_points(check_context& c, device_check& devices, const device_users& users)
{
    for (std::size_t i = 0; i < c.config.points.size(); ++i)
        check_point(c, devices, users, i, c.config.points[i]);
}

}  // namespace plcgw::config
