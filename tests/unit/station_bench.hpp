// A PLC and its station on a line: every request comes as a good frame, every reply leaves.
#pragma once

#include "bridge/plc/models/fx3g.hpp"
#include "bridge/plc/models/fx3s.hpp"
#include "bridge/plc/models/fx3u.hpp"
#include "bridge/plc/models/ls.hpp"
#include "bridge/services/modbus_station.hpp"
#include "tests/support/print.hpp"

namespace plcgw::test {

// LD M8411 and MOVs, "H11 D8401, K1 D8414".
inline plc::setup_program program_of(const std::string& moves)
{
    std::string text = "LD M8411\n";
    for (std::size_t at = 0; at < moves.size();) {
        const std::size_t end = std::min(moves.find(", ", at), moves.size());
        text += "MOV " + moves.substr(at, end - at) + "\n";
        at = end + 2;
    }
    auto parsed = plc::parse_setup_program(text);
    REQUIRE(parsed.mistakes.empty());
    return parsed;
}

inline constexpr const char* server_1 = "H1097 D8400, H11 D8401, K1 D8414, ";  // 19200 8E1, MODBUS server, unit 1
inline constexpr const char* server_2 = "H1097 D8420, H11 D8421, K1 D8434, ";

struct station_bench {
    plc::simulated_plc plc;
    modbus_station station;

    explicit station_bench(const std::string& moves = "", const plc::model& m = plc::fx3u, unsigned channel = 1)
        : plc("main", m, program_of(moves)), station(plc, modbus::unit_id{1}, channel)
    {
    }

    std::optional<buffer> ask(const buffer& pdu) { return ask(modbus::unit_id{1}, pdu); }
    std::optional<buffer> tell_all(const buffer& pdu) { return ask(modbus::unit_id::broadcast, pdu); }

    std::optional<buffer> ask(modbus::unit_id unit, const buffer& pdu)
    {
        station.bus_message();
        auto reply = station.answer({unit, pdu});
        if (reply)
            station.sent();
        return reply;
    }

    plc::place at(const char* device) const { return plc.memory().find(*plc::parse_device(device)).value(); }
    std::uint16_t word(const char* device) const { return plc.memory().word(at(device)); }
    bool bit(const char* device) const { return plc.memory().bit(at(device)); }
    void set(const char* device, std::uint16_t value) { plc.memory().set_word(at(device), value); }
    void set_bit(const char* device, bool value) { plc.memory().set_bit(at(device), value); }

    std::uint16_t count(counter which) { return station.counters()[which]; }
    buffer log() { return station.log().newest_first(); }

    // Bus messages, communication errors, exceptions, messages, no response, NAK, busy, overruns, events.
    std::vector<std::uint16_t> counters()
    {
        const auto& all = station.counters().registers();
        CHECK(all[9] == 0);
        return {all.begin(), all.begin() + 9};
    }
};

inline const buffer listen_only{0x08, 0x00, 0x04, 0x00, 0x00};
inline const buffer restart{0x08, 0x00, 0x01, 0x00, 0x00};
inline const buffer restart_and_clear_log{0x08, 0x00, 0x01, 0xFF, 0x00};
inline const buffer clear_counters{0x08, 0x00, 0x0A, 0x00, 0x00};
inline const buffer query{0x08, 0x00, 0x00, 0x12, 0x34};
inline const buffer bad_function{0x55};

}  // namespace plcgw::test

namespace doctest {

template <>
struct StringMaker<std::vector<std::uint16_t>> {
    static String convert(const std::vector<std::uint16_t>& value)
    {
        String text;
        for (const std::uint16_t each : value)
            text += toString(static_cast<unsigned>(each)) + " ";
        return text;
    }
};

template <>
struct StringMaker<std::optional<plcgw::buffer>> {
    static String convert(const std::optional<plcgw::buffer>& value)
    {
        return value ? StringMaker<plcgw::buffer>::convert(*value) : String("nothing");
    }
};

}  // namespace doctest
