// How the structs of point_config.hpp are written in JSON.
#pragma once

#include "daemon/config/point_config.hpp"
#include "daemon/config/rules.hpp"

namespace plcgw::config {

inline constexpr choice<value_type> point_types[] = {
    {"bool", value_type::boolean},  {"int16", value_type::int16},   {"uint16", value_type::uint16},
    {"int32", value_type::int32},   {"uint32", value_type::uint32}, {"int64", value_type::int64},
    {"uint64", value_type::uint64}, {"float", value_type::float32}, {"double", value_type::float64},
    {"bcd16", value_type::bcd16},   {"bcd32", value_type::bcd32},   {"text", value_type::text},
};
inline constexpr choice<byte_order> value_orders[] = {
    {"ABCD", byte_order::abcd}, {"CDAB", byte_order::cdab}, {"BADC", byte_order::badc}, {"DCBA", byte_order::dcba}};
inline constexpr choice<outside_limits> limit_policies[] = {
    {"clamp", outside_limits::clamp}, {"reject", outside_limits::reject}, {"uncertain", outside_limits::uncertain}};
inline constexpr choice<loss_policy> loss_policies[] = {
    {"keep", loss_policy::keep}, {"zero", loss_policy::zero}, {"value", loss_policy::value}};

template <class Visitor>
void describe(Visitor& v, point_config& c)
{
    v.required("name", c.name, "Name of the point: key of its DDS instance, for example line1.boiler.temp",
               text{1, 128});
    v.required("plc", c.plc, "Name of the simulated PLC that has its devices", name_rule);
    v.required("device", c.device, "First device: a word, or the bit of a bool", text{2, 16});
    v.optional("bit", c.bit, "Of a bool in a word device: which bit, 0 = lowest", range{0, 15});
    v.optional("type", c.type, "What the devices hold", point_types);
    v.optional("order", c.order,
               "How bytes and registers of a value follow each other: ABCD high byte and high register first, CDAB low "
               "register first, BADC with the bytes of each register turned round, DCBA both",
               value_orders);
    v.optional("characters", c.characters, "Of text: room for so many bytes, two in a register", range{0, 255});
    v.optional("scale", c.scale, "The value is what the devices hold times this, plus the offset",
               real_range{-1e30, 1e30});
    v.optional("offset", c.offset, "See scale", real_range{-1e30, 1e30});
    v.optional("unit", c.unit, "UCUM code, such as Cel, kPa, m3/h", text{0, 16});
    v.optional("min", c.least, "Least value that makes sense", real_range{-1e30, 1e30});
    v.optional("max", c.most, "Largest value that makes sense", real_range{-1e30, 1e30});
    v.optional(
        "outside", c.outside,
        "What a value outside min and max is: clamp to the limit; reject and keep the last one inside; uncertain "
        "and shown. Written: clamp, or else refused",
        limit_policies);
    v.optional("deadband", c.deadband, "Changes up to this are not published", real_range{0, 1e30});
    v.optional("deadband_percent", c.deadband_percent, "The same in percent of the span from min to max",
               real_range{0, 100});
    v.optional("longest_silence_ms", c.longest_silence, "Published again after this time; 0 = only when it changes",
               range{0, 86'400'000});
    v.optional("writable", c.writable, "DDS clients may write it");
}

template <class Visitor>
void describe(Visitor& v, copy_source_config& c)
{
    v.optional("plc", c.plc, "Name of the simulated PLC", text{0, 64});
    v.optional("device", c.device, "First device", text{0, 16});
}

template <class Visitor>
void describe(Visitor& v, status_config& c)
{
    v.optional("plc", c.plc, "Name of the simulated PLC; of a route, if empty, that of the route", text{0, 64});
    v.optional("device", c.device, "First of eight words, of a station four; empty: none", text{0, 16});
    v.optional("order", c.order, "How the two words of the source time follow each other", value_orders);
}

template <class Visitor>
void describe(Visitor& v, upstream_config& c)
{
    v.optional("longest_silence_ms", c.longest_silence,
               "When nobody wrote the devices for so long, the safe values are written; 0 = nobody is missed",
               range{0, 86'400'000});
    v.optional("safe", c.safe, "Safe values: one for all registers or bits, or one for each", range{0, 65'535});
}

}  // namespace plcgw::config
