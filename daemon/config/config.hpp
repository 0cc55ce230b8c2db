// The configuration file as structs. Defaults stand here and nowhere else; fields.hpp says how each is written in JSON.
#pragma once

#include "bridge/dds/settings.hpp"
#include "bridge/routes/read_plan.hpp"
#include "bridge/routes/route.hpp"
#include "daemon/config/message_config.hpp"
#include "daemon/config/mewtocol_config.hpp"
#include "daemon/config/plc_link_config.hpp"
#include "daemon/config/point_config.hpp"
#include "daemon/config/standby_config.hpp"
#include "daemon/config/topics_config.hpp"
#include "protocols/serial_timing.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace plcgw {

using std::chrono::microseconds;
using std::chrono::milliseconds;

// On which line a PLC's channel asks with its ADPRW instructions; of an FP7 the line that its COM port shows.
struct channel_config {
    unsigned channel = 1;
    std::string line;
};

struct plc_config {
    std::string name;
    std::string model = "FX3U";
    std::vector<std::string> program;  // lines of the PLC's program
    std::vector<channel_config> channels;
    std::string program_file;  // the same in a file, relative to the configuration's folder
};

// RS-485 direction by TIOCSRS485, where the driver has it.
struct rs485_config {
    bool enabled = false;
    bool rts_on_send = true;
    bool rts_after_send = false;
    bool rx_during_tx = false;
    milliseconds delay_before_send{0};
    milliseconds delay_after_send{0};
};

// Where a unit id leads: to a PLC, or to a station of a line.
struct unit_config {
    unsigned unit = 1;
    std::string plc;
    std::string line;
    unsigned line_unit = 0;  // unit id on that line; 0 = the same
    unsigned channel = 1;    // of the PLC, on a serial line: whose special devices show the communication
};

// At a server line: the unit may be a MEWTOCOL station as well.
struct line_unit_config : unit_config {};

enum class line_protocol : std::uint8_t {
    modbus_rtu,
    modbus_ascii,
    modbus_tcp,
    mewtocol_com,
    mewtocol7_com,
    general_purpose,
};

constexpr bool is_mewtocol(line_protocol p)
{
    return p == line_protocol::mewtocol_com || p == line_protocol::mewtocol7_com;
}

enum class line_role : std::uint8_t { client, server };

struct line_config {
    std::string name;
    std::string device;  // serial port, or else
    std::string host;    // MODBUS TCP server, or device server behind which the serial line is
    unsigned port = 502;
    line_protocol protocol = line_protocol::modbus_rtu;
    line_role role = line_role::client;
    std::vector<line_unit_config> units;  // of a server line
    unsigned baud_rate = 19200;
    unsigned data_bits = 8;
    parity check = parity::even;
    unsigned stop_bits = 1;
    rs485_config rs485;
    bool low_latency = true;  // of a serial line, where the driver has it
    milliseconds response_timeout{500};
    bool learn_timeout = false;      // from the stations' response times, between least_timeout and response_timeout
    milliseconds least_timeout{50};  // only with learn_timeout
    milliseconds forward_cache{0};   // age of values that forwarded reads may be answered with
    unsigned retries = 1;
    milliseconds turnaround_delay{100};
    microseconds gap{0};  // 0 = 3.5 characters; 1.75 ms above 19200 bit/s
    milliseconds silence{20};
    local_echo echo = local_echo::automatic;
    unsigned max_outstanding = 1;  // of MODBUS TCP
    mewtocol_config mewtocol;
    general_purpose_config messages;  // of a general-purpose line
};

struct station_config {
    std::string name;
    std::string line;
    unsigned unit = 1;
    std::optional<milliseconds> response_timeout;  // of the line, if absent
    std::optional<unsigned> retries;
    merge_mode merge = merge_mode::automatic;
    unsigned max_registers = 0;  // in one request; 0: what the protocol allows
    unsigned max_bits = 0;
    status_config status;
};

struct route_config {
    std::string name;
    std::string station;                 // or
    copy_source_config from;             // devices of a PLC
    std::optional<modbus::table> table;  // of a MODBUS station
    std::optional<unsigned> first;
    std::string source;  // of a MEWTOCOL station instead: "DT100", "R1F"
    unsigned count = 1;
    std::string plc;
    std::string device;
    direction way = direction::read;
    milliseconds period{1000};
    loss_policy on_loss = loss_policy::keep;
    std::vector<unsigned> loss_value;  // one for all registers or bits, or one for each
    status_config status;
    upstream_config upstream;
};

enum class server_framing : std::uint8_t { tcp, rtu, ascii };

struct tcp_server_config {
    std::string listen = "127.0.0.1";
    unsigned port = 502;
    std::vector<unit_config> units;
    server_framing framing = server_framing::tcp;
    std::string other_units;  // PLC or line for the unit ids that are not listed; empty: exception 0A
    unsigned max_clients = 256;
    std::chrono::seconds idle_timeout{0};  // 0 = a client may be silent for ever
    unsigned max_outstanding = 16;         // requests of one client that wait for lines at a time
};

struct block_config {
    std::string plc;
    std::string device;
    unsigned count = 1;
    bool writable = false;  // by DDS
};

struct dds_config {
    dds_settings settings;  // its topics are those below, when the file was read
    topics_config topics;
    bool writes = false;  // obey requests
    std::string member;   // empty: the host's name
    milliseconds longest_silence{1000};
    milliseconds status_silence{10'000};  // of ports and devices
    std::vector<block_config> blocks;
};

enum class log_level : std::uint8_t { debug, info, warning, error };

struct log_config {
    log_level level = log_level::info;
};

struct control_config {
    std::string socket;  // empty: control.sock in the runtime directory
};

struct state_config {
    std::string folder;  // empty: systemd's state directory, or the user's
};

struct gateway_config {
    std::string schema;  // for editors only
    std::string gateway = "gateway";
    std::vector<plc_config> plcs;
    std::vector<line_config> lines;
    std::vector<station_config> stations;
    std::vector<route_config> routes;
    std::vector<point_config> points;
    std::vector<tcp_server_config> modbus_tcp;
    std::vector<plc_link_config> plc_links;
    dds_config dds;
    standby_config standby;
    log_config log;
    control_config control;
    state_config state;
};

}  // namespace plcgw
