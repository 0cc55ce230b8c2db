// One place that says how each struct of config.hpp is written in JSON: key, rule, description. A visitor walks it: the
// reader fills the struct, the schema writer describes it, so that both always agree with the structs.
#pragma once

#include "daemon/config/config.hpp"
#include "daemon/config/dds_fields.hpp"
#include "daemon/config/message_fields.hpp"
#include "daemon/config/mewtocol_fields.hpp"
#include "daemon/config/point_fields.hpp"
#include "daemon/config/standby_fields.hpp"

namespace plcgw::config {

inline constexpr choice<line_protocol> line_protocols[] = {
    {"modbus-rtu", line_protocol::modbus_rtu},       {"modbus-ascii", line_protocol::modbus_ascii},
    {"modbus-tcp", line_protocol::modbus_tcp},       {"mewtocol-com", line_protocol::mewtocol_com},
    {"mewtocol7-com", line_protocol::mewtocol7_com}, {"general-purpose", line_protocol::general_purpose}};
inline constexpr choice<line_role> line_roles[] = {{"client", line_role::client}, {"server", line_role::server}};
inline constexpr choice<server_framing> server_framings[] = {
    {"tcp", server_framing::tcp}, {"rtu", server_framing::rtu}, {"ascii", server_framing::ascii}};
inline constexpr choice<local_echo> local_echoes[] = {
    {"off", local_echo::off}, {"on", local_echo::on}, {"auto", local_echo::automatic}};
inline constexpr choice<parity> parities[] = {{"none", parity::none}, {"odd", parity::odd}, {"even", parity::even}};
inline constexpr choice<direction> directions[] = {{"read", direction::read},
                                                   {"write", direction::write},
                                                   {"write-through", direction::write_through},
                                                   {"read-write", direction::read_write},
                                                   {"periodic-write", direction::periodic_write}};
inline constexpr choice<merge_mode> merge_modes[] = {
    {"auto", merge_mode::automatic}, {"adjacent", merge_mode::adjacent}, {"off", merge_mode::off}};
inline constexpr choice<modbus::table> tables[] = {{"coil", modbus::table::coils},
                                                   {"discrete", modbus::table::discrete_inputs},
                                                   {"input", modbus::table::input_registers},
                                                   {"holding", modbus::table::holding_registers}};
inline constexpr choice<log_level> log_levels[] = {{"debug", log_level::debug},
                                                   {"info", log_level::info},
                                                   {"warning", log_level::warning},
                                                   {"error", log_level::error}};

template <class Visitor>
void describe(Visitor& v, channel_config& c)
{
    v.required("channel", c.channel, "Number of the PLC's MODBUS channel; of an FP7 that of the COM port", range{0, 3});
    v.required(
        "line", c.line,
        "Name of the client line that it asks with ADPRW. Of an FP7 a general-purpose line or a client line, whose "
        "flags and PMGET words it shows",
        name_rule);
}

template <class Visitor>
void describe(Visitor& v, plc_config& c)
{
    v.required("name", c.name, "Name of the simulated PLC", name_rule);
    v.optional("model", c.model, "PLC family: FX3S, FX3G, FX3GC, FX3U, FX3UC, LS22, LS32 or FP7", name_rule);
    v.optional("program", c.program,
               "PLC program, one instruction per string: LD M8411, MOV H5002 D8470, ... and ADPRW lines", text{});
    v.optional("channels", c.channels,
               "Lines on which the PLC's own program is client; of an FP7 those of its COM ports");
    v.optional("program_file", c.program_file,
               "File with the program instead; relative to the folder of this configuration", text{});
}

template <class Visitor>
void describe(Visitor& v, plc_link_config& c)
{
    plc_link_settings& s = c.as.settings;
    v.required("name", c.name, "Name of the PLC link, the same in all its stations", name_rule);
    v.required("plc", c.plc, "Name of the simulated PLC that takes part, an FP7", name_rule);
    v.required("station", c.as.station, "Its number, which no other station of the link has", range{1, 16});
    v.optional("block", s.block, "0: WL0-WL63 and LD0-LD127; 1: WL64-WL127 and LD128-LD255", range{0, 1});
    v.optional("max_station", s.max_station, "Highest number of the link, the same in all stations; 0 and 1 = 16",
               range{0, 16});
    v.optional("relay_words", s.relay_words, "Words of link relays in the block that the link uses", range{0, 64});
    v.optional("register_words", s.register_words, "Link registers in the block that the link uses", range{0, 128});
    v.optional("relay_first", s.relay_first, "First word of link relays that this station sends, from 0 in the block",
               range{0, 63});
    v.optional("relay_count", s.relay_count, "Words of link relays that it sends", range{0, 64});
    v.optional("register_first", s.register_first, "First link register that it sends, from 0 in the block",
               range{0, 127});
    v.optional("register_count", s.register_count, "Link registers that it sends", range{0, 127});
}

template <class Visitor>
void describe(Visitor& v, rs485_config& c)
{
    v.optional("enabled", c.enabled, "Let the driver switch the direction (TIOCSRS485)");
    v.optional("rts_on_send", c.rts_on_send, "Level of RTS while sending");
    v.optional("rts_after_send", c.rts_after_send, "Level of RTS while receiving");
    v.optional("rx_during_tx", c.rx_during_tx, "Hear what we send ourselves");
    v.optional("delay_before_send_ms", c.delay_before_send, "Milliseconds from RTS to the first bit", range{0, 1000});
    v.optional("delay_after_send_ms", c.delay_after_send, "Milliseconds from the last bit to RTS", range{0, 1000});
}

template <class Visitor>
void describe_target(Visitor& v, unit_config& c)
{
    v.optional("plc", c.plc, "Name of the simulated PLC that answers", text{0, 64});
    v.optional("line", c.line, "Or name of the line to which requests are forwarded", text{0, 64});
    v.optional("line_unit", c.line_unit, "Unit id or MEWTOCOL station on that line; 0 = the same", range{0, 999});
    v.optional("channel", c.channel,
               "Channel of the PLC that a server line stands for: its special D and M show it. Of an FP7 the number of "
               "the COM port",
               range{0, 3});
}

template <class Visitor>
void describe(Visitor& v, unit_config& c)
{
    v.required("unit", c.unit, "MODBUS unit id", range{0, 255});
    describe_target(v, c);
}

template <class Visitor>
void describe(Visitor& v, line_unit_config& c)
{
    v.required("unit", c.unit, "MODBUS unit id, or MEWTOCOL station", range{0, 999});
    describe_target(v, c);
}

template <class Visitor>
void describe(Visitor& v, line_config& c)
{
    v.required("name", c.name, "Name of the line", name_rule);
    v.optional("device", c.device, "Serial port, best a stable name such as /dev/serial/by-id/...", text{});
    v.optional(
        "host", c.host,
        "Host instead of a serial port: a MODBUS TCP server, or a device server that passes on what is on its line",
        text{});
    v.optional("port", c.port, "TCP port of the host", range{1, 65'535});
    v.optional("protocol", c.protocol,
               "What is spoken on the line; with a host, all but modbus-tcp mean a serial device server",
               line_protocols);
    v.optional("role", c.role, "client: the gateway asks the stations; server: it answers, for the units below",
               line_roles);
    v.optional("units", c.units, "Of a server line: which unit id or MEWTOCOL station leads to which PLC");
    v.optional("mewtocol", c.mewtocol, "Of a MEWTOCOL line");
    v.optional("baud_rate", c.baud_rate, "Bits per second", range{300, 4'000'000});
    v.optional("data_bits", c.data_bits, "Data bits; RTU needs 8, ASCII takes 7 or 8", range{7, 8});
    v.optional("parity", c.check, "Parity bit", parities);
    v.optional("stop_bits", c.stop_bits, "Stop bits", range{1, 2});
    v.optional("rs485", c.rs485, "RS-485 direction control by the driver");
    v.optional("low_latency", c.low_latency,
               "Ask the driver to deliver bytes at once (ASYNC_LOW_LATENCY): USB adapters keep them for up to 16 ms");
    v.optional("response_timeout_ms", c.response_timeout,
               "Milliseconds from the end of a request to the first byte of its answer", range{1, 60'000});
    v.optional("learn_timeout", c.learn_timeout,
               "Learn each station's timeout from its response times; response_timeout_ms is the longest then");
    v.optional("least_timeout_ms", c.least_timeout, "Shortest timeout that is learned", range{1, 60'000});
    v.optional("forward_cache_ms", c.forward_cache,
               "Age of values that forwarded reads may be answered with instead of asking the station; 0: none",
               range{0, 60'000});
    v.optional("retries", c.retries, "Repetitions of a request that got no good answer", range{0, 20});
    v.optional("turnaround_delay_ms", c.turnaround_delay, "Milliseconds of silence after a broadcast",
               range{0, 32'767});
    v.optional(
        "gap_us", c.gap,
        "Microseconds of silence before a request; 0 = 3.5 characters, never less. MEWTOCOL server: before a response",
        range{0, 16'382'000});
    v.optional("silence_ms", c.silence, "Milliseconds of silence that end a damaged frame; at least 50 with a host",
               range{1, 1000});
    v.optional("local_echo", c.echo, "Whether the adapter returns what it sends; auto finds out at the first read",
               local_echoes);
    v.optional("max_outstanding", c.max_outstanding, "Requests under way at a time, modbus-tcp only", range{1, 64});
    v.optional("general_purpose", c.messages, "Of a general-purpose line: its messages, and what becomes of them");
}

template <class Visitor>
void describe(Visitor& v, station_config& c)
{
    v.required("name", c.name, "Name of the device", name_rule);
    v.required("line", c.line, "Name of its line", name_rule);
    v.required(
        "unit", c.unit,
        "MODBUS unit id to 247, MEWTOCOL station to 99, MEWTOCOL7 to 999; 0 = all of them, for write routes only",
        range{0, 999});
    v.optional("response_timeout_ms", c.response_timeout, "As at the line, for this station", range{1, 60'000});
    v.optional("retries", c.retries, "As at the line, for this station", range{0, 20});
    v.optional("merge", c.merge,
               "Which reads share a request. auto: whatever costs least bus time; adjacent: nothing is read that no "
               "route wants; off: each route has its own",
               merge_modes);
    v.optional(
        "max_registers", c.max_registers,
        "Registers or words at most in one request that serves several routes; 0 = as many as the protocol allows",
        range{0, 125});
    v.optional("max_bits", c.max_bits, "Bits, likewise", range{0, 2000});
    v.optional("status", c.status, "Words of a PLC that show how it does");
}

template <class Visitor>
void describe(Visitor& v, route_config& c)
{
    v.required("name", c.name, "Name of the route: key of its DDS instance", name_rule);
    v.optional("station", c.station, "Name of the station", text{0, 64});
    v.optional("from", c.from, "Or devices of a PLC, which are copied when they change");
    v.optional("table", c.table, "MODBUS: table of the station's registers or bits", tables);
    v.optional("first", c.first, "MODBUS: protocol address of the first one, zero-based: 40001 is 0", range{0, 65'535});
    v.optional("source", c.source,
               "MEWTOCOL instead: first device of the station, such as DT100, WR3 or R1F; a write route writes there",
               text{0, 16});
    v.optional("count", c.count, "Registers, words or bits", range{1, 2000});
    v.required("plc", c.plc, "Name of the simulated PLC", name_rule);
    v.required("device", c.device,
               "First device in its memory, for example D100, M0, X17 (octal); DT100, R1F, WR3 in an FP7", text{2, 16});
    v.optional(
        "direction", c.way,
        "read: station to PLC, periodically; write: PLC to station, on change; read-write: both; periodic-write: on "
        "change and periodically",
        directions);
    v.optional("period_ms", c.period, "Milliseconds from one read, or periodic write, to the next",
               range{10, 86'400'000});
    v.optional("on_loss", c.on_loss,
               "What the PLC's memory shows when the station is lost: keep the last values, zero, or value",
               loss_policies);
    v.optional("loss_value", c.loss_value, "Of on_loss value: one for all registers or bits, or one for each",
               range{0, 65'535});
    v.optional("status", c.status, "Words of a PLC that show how the route does");
    v.optional("upstream", c.upstream, "Of a write route: safe values when nobody writes its devices any more");
}

template <class Visitor>
void describe(Visitor& v, tcp_server_config& c)
{
    v.optional("listen", c.listen, "Address to listen on; 0.0.0.0 or :: for every interface", text{1});
    v.optional("port", c.port, "TCP port", range{1, 65'535});
    v.optional("framing", c.framing,
               "tcp: MODBUS TCP; rtu or ascii: serial device servers connect and pass on what is said on their lines",
               server_framings);
    v.optional("units", c.units, "Which unit id leads to which PLC");
    v.optional("other_units", c.other_units, "PLC or line for all other unit ids; empty: they get exception 0A",
               text{0, 64});
    v.optional("max_clients", c.max_clients, "Connections at a time", range{1, 10'000});
    v.optional("idle_timeout_s", c.idle_timeout, "Seconds until a silent client is disconnected; 0 = never",
               range{0, 86'400});
    v.optional("max_outstanding", c.max_outstanding,
               "Forwarded requests of one client under way at a time; then it is not read until one is answered",
               range{1, 256});
}

template <class Visitor>
void describe(Visitor& v, log_config& c)
{
    v.optional("level", c.level, "Least important message that is logged", log_levels);
}

template <class Visitor>
void describe(Visitor& v, control_config& c)
{
    v.optional("socket", c.socket, "Unix socket for commands; empty: control.sock in the runtime directory",
               text{0, 100});
}

template <class Visitor>
void describe(Visitor& v, state_config& c)
{
    v.optional("folder", c.folder,
               "Folder of what is kept across restarts; empty: systemd's state directory, or the user's", text{});
}

template <class Visitor>
void describe(Visitor& v, gateway_config& c)
{
    v.optional("$schema", c.schema, "Path of the JSON Schema, for editors", text{});
    v.optional("gateway", c.gateway, "Name of this gateway in DDS", name_rule);
    v.optional("plcs", c.plcs, "Simulated PLCs");
    v.optional("lines", c.lines, "Serial lines");
    v.optional("stations", c.stations, "Devices on the lines");
    v.optional("routes", c.routes, "Routing table: registers of stations to devices of PLCs");
    v.optional("points", c.points, "Typed values on top of the PLCs' words, published as DDS points");
    v.optional("modbus_tcp", c.modbus_tcp, "MODBUS TCP servers");
    v.optional("plc_links", c.plc_links, "PLC links: link relays and registers that FP7s of several gateways share");
    v.optional("dds", c.dds, "DDS");
    v.optional("standby", c.standby, "Two gateways of the same name that stand in for each other");
    v.optional("log", c.log, "Logging");
    v.optional("control", c.control, "Commands for the running gateway");
    v.optional("state", c.state, "What the gateway has learned about its devices");
}

}  // namespace plcgw::config
