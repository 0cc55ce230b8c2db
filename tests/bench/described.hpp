// Stations of an emulated wire as the plans of the programs describe them: see README.md.
#pragma once

#include "tests/bench/stations.hpp"

#include <nlohmann/json.hpp>

namespace plcgw::bench {

inline station station_of(const nlohmann::json& described, const wire_format& format)
{
    constexpr std::size_t fewest_registers = 4096;
    station made;
    // A station knows that a request is over when the line was silent.
    made.turnaround = format.rule() + described.value("turnaround_us", nanoseconds{0}) * 1000;
    made.dead = described.value("dead", false);
    made.refuses = described.value("refuses", std::uint8_t{0});
    made.moving = described.value("moving", 0U);
    made.registers.resize(described.value("registers", fewest_registers));
    for (std::size_t i = 0; i < made.registers.size(); ++i)
        made.registers[i] = static_cast<std::uint16_t>(i);
    return made;
}

inline station_table stations_of(const nlohmann::json& described, const wire_format& format)
{
    station_table stations;
    for (const nlohmann::json& each : described)
        stations.add(each.at("unit"), station_of(each, format));
    return stations;
}

}  // namespace plcgw::bench
