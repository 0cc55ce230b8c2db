#include "bridge/orders/order_targets.hpp"

namespace plcgw {
namespace {

order_outcome rejected(std::string why) { return {order_result::rejected, 0, std::move(why)}; }

std::string named(const char* what, const std::string& name) { return std::string(what) + " \"" + name + "\" "; }

std::string run_text(std::uint32_t first, std::uint64_t count)
{
    return std::to_string(first) + "-" + std::to_string(first + count - 1);
}

// What a RegisterBlock says of itself.
struct shown_block {
    std::string label;
    std::string area;
    std::uint32_t first{};
    std::uint32_t count{};
    bool are_bits = false;
    write_span all;
};

// Protected devices stay as they are, whoever writes: nobody should believe that he did.
found_span open_span(const write_span& span, const std::string& label)
{
    if (!span.plc->memory().is_open(span.at, span.bits))
        return rejected(label + "has devices among these that only the PLC itself sets");
    return span;
}

found_span part_of(const shown_block& b, const route_order& o)
{
    if (o.area != b.area)
        return rejected(b.label + "has area \"" + b.area + "\", not \"" + o.area + "\"");
    if (o.values.are_bits != b.are_bits)
        return rejected(b.label + (b.are_bits ? "has bits: give format 1 (bits)" : "has words: give format 0 (words)"));
    if (!is_whole(o.values))
        return rejected(b.label + "got count " + std::to_string(o.values.count) + " with " +
                        std::to_string(o.values.words.size()) +
                        " words: each word is one register, or 16 bits of which the last may be unused");
    if (o.first < b.first || std::uint64_t{o.first} + o.values.count > std::uint64_t{b.first} + b.count)
        return rejected(b.label + "has " + b.area + " " + run_text(b.first, b.count) + ", not " +
                        run_text(o.first, o.values.count));
    const std::size_t each = b.are_bits ? 1 : 16;
    const plc::place at{b.all.at.area, b.all.at.bit + each * (o.first - b.first)};
    return open_span({b.all.plc, at, each * o.values.count}, b.label);
}

}  // namespace

found_span part_of(const route& r, const route_order& o)
{
    const std::string label = named("route", r.name);
    if (!writes(r.way))
        return rejected(label + "is read-only: direction write, read-write or write-through would allow it");
    return part_of({label, area_name(r.there), number(r.there), r.count, is_bits(r.there), {r.plc, r.at, bits_of(r)}},
                   o);
}

found_span part_of(const plc_block& b, const route_order& o)
{
    const bool bits = plc::is_bit_kind(b.head.kind);
    const std::string area(plc::to_string(b.head.kind, b.plc->model().names));
    return part_of({named("block", b.name), area, b.head.number, b.count, bits, {b.plc, b.at, bits_of(b)}}, o);
}

found_span devices_of(plc::simulated_plc& plc, const device_order& o)
{
    const std::string label = named("PLC", plc.name());
    const auto device = plc::parse_device(o.device, plc.model().names);
    const auto at = device ? plc.memory().find(*device) : std::nullopt;
    if (!at)
        return order_outcome{order_result::not_found, 0,
                             label + "has no device \"" + o.device + "\": give one such as " +
                                 std::string(plc.model().examples)};
    const bool bits = plc::is_bit_kind(device->kind);
    if (bits != o.values.are_bits)
        return rejected(o.device + (bits ? " is a bit: give 0 or 1" : " is a word: give numbers"));
    if (!is_whole(o.values))
        return rejected("there is no value for " + o.device);
    const std::size_t wanted = std::size_t{bits ? 1U : 16U} * o.values.count;
    if (wanted > plc.memory().bits_from(*at))
        return rejected(label + "has fewer devices from " + o.device + " on than " + std::to_string(o.values.count));
    return open_span({&plc, *at, wanted}, label);
}

}  // namespace plcgw
