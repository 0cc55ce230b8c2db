// The MODBUS RTU stations of an emulated wire. They share nothing with the gateway's protocol code.
#pragma once

#include "tests/bench/wire_format.hpp"

#include <map>
#include <optional>

namespace plcgw::bench {

std::uint16_t modbus_crc(byte_span bytes);

// Size of the request that begins with these bytes, with its CRC; 0 = not known yet, nullopt = no function of ours.
std::optional<std::size_t> request_size(byte_span begun);

struct station {
    nanoseconds turnaround = 0;  // from the end of a request to the start of its response
    bool dead = false;           // hears nothing
    std::uint8_t refuses = 0;    // every request with this exception; 0 = none
    unsigned moving = 0;         // registers count up with every so many reads; 0 = they stand
    std::vector<std::uint16_t> registers;
    unsigned reads = 0;
};

struct station_answer {
    nanoseconds turnaround;
    byte_vector response;  // with CRC
};

class station_table {
public:
    void add(unsigned unit, station added) { stations_[unit] = std::move(added); }

    // To a whole request; nothing where nobody answers: wrong CRC, broadcast, a dead or unknown station.
    std::optional<station_answer> ask(byte_span adu);

private:
    static byte_vector serve(station& of, byte_span pdu);

    std::map<unsigned, station> stations_;
};

}  // namespace plcgw::bench
