// A correct configuration with one value on each line, to be spoilt by the tests, and its mistakes as one text.
#pragma once

#include "daemon/config/read.hpp"

#include <string>
#include <string_view>

namespace plcgw::config {

inline constexpr std::string_view plant = R"({
  "gateway": "plant",
  "plcs": [
    { "name": "main",
      "model": "FX3U",
      "program": [
        "LD M8411",
        "MOV HC010 D8470",
        "MOV K0 D8471"
      ] },
    { "name": "spare" }
  ],
  "lines": [
    { "name": "north",
      "device": "/dev/ttyUSB0",
      "baud_rate": 9600,
      "data_bits": 8,
      "parity": "none",
      "rs485": { "enabled": true },
      "retries": 2 },
    { "name": "south",
      "device": "/dev/ttyUSB1" }
  ],
  "stations": [
    { "name": "pump",
      "line": "north",
      "unit": 1,
      "retries": 0 },
    { "name": "everyone",
      "line": "north",
      "unit": 0 },
    { "name": "meter",
      "line": "south",
      "unit": 1 }
  ],
  "routes": [
    { "name": "pump.values",
      "station": "pump",
      "table": "input",
      "first": 0,
      "count": 4,
      "plc": "main",
      "device": "D100",
      "period_ms": 200 },
    { "name": "clock",
      "station": "everyone",
      "table": "holding",
      "first": 10,
      "plc": "main",
      "device": "D10",
      "direction": "write" },
    { "name": "meter.state",
      "station": "meter",
      "table": "discrete",
      "first": 0,
      "count": 8,
      "plc": "main",
      "device": "X10" }
  ],
  "modbus_tcp": [
    { "listen": "127.0.0.1",
      "port": 1502,
      "units": [
        { "unit": 1, "plc": "main" },
        { "unit": 2, "plc": "spare" }
      ] },
    { "listen": "127.0.0.1",
      "port": 1503,
      "other_units": "spare" }
  ],
  "dds": {
    "domain": 7,
    "peers": [ "192.168.1.5" ],
    "blocks": [
      { "plc": "main", "device": "D0", "count": 20 },
      { "plc": "main", "device": "M0" }
    ]
  },
  "log": { "level": "debug" }
}
)";

// The plant, or another text, with a passage of it exchanged.
std::string changed(std::string_view from, std::string_view to, std::string_view in = plant);

// "3 /lines/0/parity is ..." for each mistake, "3 warning /plcs/0 ..." for a warning; joined by line breaks.
std::string said(const mistakes& found);
std::string said(std::string_view text, const std::filesystem::path& folder = {});

// One change of the plant, and everything that is said about it.
struct change_row {
    std::string_view from;
    std::string_view to;
    std::string_view expected;
};

void check_row(const change_row& row);

}  // namespace plcgw::config
