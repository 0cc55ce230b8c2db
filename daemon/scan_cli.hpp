// The options of `plc-gateway scan`.
#pragma once

#include "daemon/scan/scan_client.hpp"

#include <CLI/CLI.hpp>

namespace plcgw {

inline void add_scan(CLI::App& command, scan_options& o)
{
    command.add_option("line", o.line, "Line of the running gateway, or with -c of a configuration");
    command.add_option("-c,--config", o.config_file, "Open the port of this configuration's line; the gateway is off");
    command.add_option("--socket", o.socket, "Control socket of the gateway; default: where it usually is");
    command.add_option("--device", o.device, "Scan this serial port, without a configuration");
    command.add_option("--host", o.host, "Scan a MODBUS TCP server, or a device server with --protocols");
    command.add_option("--port", o.port, "TCP port of the host")->check(CLI::Range(1, 65'535))->capture_default_str();
    command.add_option("--units", o.units, "Unit ids or station numbers, as 1-32,40; default: all");
    command.add_option("--bauds", o.bauds, "Baud rates, as 9600,19200");
    command.add_option("--formats", o.formats, "Data bits, parity and stop bits, as 8E1,8N1");
    command.add_option("--protocols", o.protocols, "As modbus-rtu,modbus-ascii,mewtocol-com");
    command.add_option("--timeout-ms", o.timeout_ms, "How long a station may take to answer")
        ->check(CLI::Range(1, 10'000));
    command.add_flag("--all", o.all, "Go on when a combination of rate and format has found stations");
    command.add_flag("--json", o.json, "One JSON object instead of a table");
    command.add_option("-o,--output", o.output, "Write a configuration to begin with; -: to standard output");
}

}  // namespace plcgw
