#include "daemon/access_target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace plcgw {
namespace {

using parsed_target = boost::system::result<access_target, order_outcome>;
using parsed_place = boost::system::result<station_place, order_outcome>;

order_outcome not_found(std::string why) { return {order_result::not_found, 0, std::move(why)}; }
order_outcome rejected(std::string why) { return {order_result::rejected, 0, std::move(why)}; }

std::optional<unsigned> whole(std::string_view text)
{
    const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
    text.remove_prefix(hexadecimal ? 2 : 0);
    unsigned number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, hexadecimal ? 16 : 10);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

template <class Row>
const Row* find(const std::vector<Row>& rows, const std::string& name)
{
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const Row& each) { return each.name == name; });
    return found == rows.end() ? nullptr : &*found;
}

parsed_place modbus_place_of(const std::string& text)
{
    constexpr modbus::table tables[] = {modbus::table::coils, modbus::table::discrete_inputs,
                                        modbus::table::input_registers, modbus::table::holding_registers};
    const std::size_t colon = text.find(':');
    const auto number = colon == std::string::npos ? std::nullopt : whole(std::string_view(text).substr(colon + 1));
    for (const modbus::table each : tables)
        if (number && *number <= 0xFFFF && text.substr(0, colon) == modbus::to_string(each))
            return station_place(modbus_place{each, modbus::address{static_cast<std::uint16_t>(*number)}});
    return rejected(
        fmt::format("\"{}\" is nothing in a MODBUS station: give coil:0, discrete:0, input:0 or holding:100, "
                    "the number zero-based",
                    text));
}

parsed_place place_of(const std::string& text, const line_config& line)
{
    if (!is_mewtocol(line.protocol))
        return modbus_place_of(text);
    const auto device = mewtocol::parse_device(text);
    if (!device)
        return rejected(
            fmt::format("\"{}\" is no device of a MEWTOCOL station: give one such as DT100, R1F or Y0", text));
    return station_place(*device);
}

parsed_target station_of(const std::string& who, const std::string& what, const gateway_config& config)
{
    const std::size_t mark = who.rfind('#');
    const station_config* const station = find(config.stations, who);
    const auto unit =
        station != nullptr || mark == std::string::npos ? std::nullopt : whole(std::string_view(who).substr(mark + 1));
    const std::string line_name = station != nullptr ? station->line : who.substr(0, mark);
    if (station == nullptr && !unit)
        return not_found(fmt::format("there is no station \"{}\": give its name, or line#unit for one that is not "
                                     "configured",
                                     who));
    const line_config* const line = find(config.lines, line_name);
    const bool asks =
        line != nullptr && line->role == line_role::client && line->protocol != line_protocol::general_purpose;
    if (!asks)
        return not_found(fmt::format("there is no line \"{}\" on which the gateway asks stations", line_name));
    if (unit && *unit > (is_mewtocol(line->protocol) ? 999U : 255U))
        return rejected(fmt::format("{} is no unit id or station number", *unit));
    const auto place = place_of(what, *line);
    if (!place)
        return place.error();
    return access_target(station_target{line_name, station_number(unit ? *unit : station->unit), *place});
}

}  // namespace

parsed_target parse_target(const std::string& text, const gateway_config& config)
{
    if (find(config.points, text) != nullptr)
        return access_target(point_target{text});
    if (const std::size_t slash = text.find('/'); slash != std::string::npos)
        return station_of(text.substr(0, slash), text.substr(slash + 1), config);
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos)
        return not_found(fmt::format("there is no point \"{}\": give a point's name, plc:device such as main:D100, or "
                                     "station/holding:100",
                                     text));
    return access_target(device_target{text.substr(0, colon), text.substr(colon + 1)});
}

}  // namespace plcgw
