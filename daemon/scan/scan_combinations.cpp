#include "daemon/scan/scan_combinations.hpp"

#include <fmt/core.h>

namespace plcgw {
namespace {

std::vector<scan_format> common_formats(line_protocol p)
{
    const scan_format even{8, parity::even, 1};
    const scan_format none{8, parity::none, 1};
    const scan_format odd{8, parity::odd, 1};
    const scan_format seven{7, parity::even, 1};
    if (is_mewtocol(p))
        return {odd, none, even};
    if (p == line_protocol::modbus_ascii)
        return {seven, even, none};
    return {even, none, odd};
}

bool is_possible(const line_config& line) { return line.protocol != line_protocol::modbus_rtu || line.data_bits == 8; }

struct choices {
    std::vector<line_protocol> protocols;
    std::vector<unsigned> bauds;
    std::optional<std::vector<scan_format>> formats;  // none: the common ones of each protocol
};

scan_combinations all_of(const line_config& base, const choices& from)
{
    scan_combinations made;
    for (const line_protocol protocol : from.protocols)
        for (const unsigned baud : from.bauds)
            for (const scan_format& format : from.formats.value_or(common_formats(protocol))) {
                line_config line = base;
                line.protocol = protocol;
                line.baud_rate = baud;
                line.data_bits = format.data_bits;
                line.check = format.check;
                line.stop_bits = format.stop_bits;
                const bool is_known = protocol == line_protocol::modbus_tcp && !made.lines.empty();
                if (is_possible(line) && !is_known)
                    made.lines.push_back(line);
            }
    return made;
}

}  // namespace

scan_combinations combinations_of(const scan_options& o, const line_config& base)
{
    const bool is_port = o.config_file.empty();
    const scan_format own{base.data_bits, base.check, base.stop_bits};
    choices from{{base.protocol}, {base.baud_rate}, std::vector<scan_format>{own}};
    if (is_port && !base.device.empty()) {
        from.protocols = {line_protocol::modbus_rtu, line_protocol::modbus_ascii, line_protocol::mewtocol_com};
        from.bauds = {9600, 19'200, 38'400, 57'600, 115'200, 4800, 2400, 1200};
        from.formats.reset();
    }
    const auto wrong = [](const std::string& what, const std::string& given, const char* example) {
        return scan_combinations{
            {}, scan_failure(scan_misused, fmt::format("{} {}: give a list, as {}", what, given, example))};
    };
    if (!o.protocols.empty()) {
        const auto given = parse_protocols(o.protocols);
        if (!given)
            return wrong("--protocols", o.protocols, "modbus-rtu,modbus-ascii,mewtocol-com");
        for (const line_protocol each : *given)
            if (each == line_protocol::modbus_tcp && !base.device.empty())
                return {{}, scan_failure(scan_misused, "modbus-tcp needs --host, it is not spoken on a serial port")};
        from.protocols = *given;
    }
    if (!o.bauds.empty()) {
        const bool has_range = o.bauds.find('-') != std::string::npos;
        const auto given = has_range ? std::nullopt : parse_numbers(o.bauds, 50, 4'000'000);
        if (!given)
            return wrong("--bauds", o.bauds, "9600,19200");
        from.bauds = *given;
    }
    if (!o.formats.empty()) {
        from.formats = parse_formats(o.formats);
        if (!from.formats)
            return wrong("--formats", o.formats, "8E1,8N1");
    }
    scan_combinations made = all_of(base, from);
    if (made.lines.empty())
        made.status = scan_failure(scan_misused, "no combination is left: MODBUS RTU needs 8 data bits");
    return made;
}

}  // namespace plcgw
