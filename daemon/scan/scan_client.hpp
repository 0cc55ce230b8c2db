// `plc-gateway scan`: looks for stations on a line, through the running gateway or on a port of its own.
#pragma once

#include "daemon/scan/unit_list.hpp"

#include <nlohmann/json_fwd.hpp>

namespace plcgw {

struct scan_options {
    std::string line;         // of the configuration
    std::string config_file;  // not empty: on a port of its own
    std::string socket;       // of the running gateway; empty: where it usually is
    std::string device;       // or a host instead of a configuration
    std::string host;
    unsigned port = 502;
    std::string units;        // "1-32,40"; empty: all
    std::string bauds;        // "9600,19200"; empty: those of the line, or the common ones
    std::string formats;      // "8E1,8N1"
    std::string protocols;    // "modbus-rtu,modbus-ascii"
    unsigned timeout_ms = 0;  // 0: derived
    bool all = false;         // go on behind the first combination with stations
    bool json = false;
    std::string output;  // file for the configuration; "-": standard output, and the table on the other one
};

// Exit status 0: stations were found; 1: it could not be done, said on stderr; 2: the options make no sense; 4: nobody
// answered; 130: interrupted, what was found until then is printed.
int scan_stations(const scan_options& o);

// The two ways. They fill an array of what scan_json() makes; the exit status, of which 0 and scan_interrupted have
// something to print.
int scan_through_gateway(const scan_options& o, nlohmann::json& scans);
int scan_alone(const scan_options& o, nlohmann::json& scans);

// On stderr: on a terminal one line that is overwritten, else a line each 5 s.
class scan_progress {
public:
    void show(const nlohmann::json& scan, const std::string& what);
    void end();

private:
    std::string shown_;
    long long shown_at_s_ = -1;
};

inline constexpr int scan_refused = 1;
inline constexpr int scan_misused = 2;
inline constexpr int scan_interrupted = 130;

// Complains and returns the status.
int scan_failure(int status, const std::string& why);

}  // namespace plcgw
