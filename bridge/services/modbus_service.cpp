#include "bridge/services/modbus_service.hpp"

#include "bridge/services/device_identification.hpp"

namespace plcgw {
namespace {

using modbus::exception_code;
using modbus::response;
using modbus::table;
using extents = std::vector<plc::extent>;

std::vector<bool> read_bits(const plc::memory& memory, const extents& from)
{
    std::vector<bool> values;
    for (const plc::extent& run : from)
        for (std::size_t i = 0; i < run.count; ++i)
            values.push_back(memory.bit({run.at.area, run.at.bit + i}));
    return values;
}

std::vector<std::uint16_t> read_words(const plc::memory& memory, const extents& from)
{
    std::vector<std::uint16_t> values;
    for (const plc::extent& run : from) {
        values.resize(values.size() + run.count);
        memory.read(run.at, std::span(values).last(run.count));
    }
    return values;
}

void write_bits(plc::memory& memory, const extents& to, const std::vector<bool>& values)
{
    std::size_t next = 0;
    for (const plc::extent& run : to)
        for (std::size_t i = 0; i < run.count; ++i)
            memory.set_bit({run.at.area, run.at.bit + i}, values[next++]);
}

void write_words(plc::memory& memory, const extents& to, std::span<const std::uint16_t> values)
{
    std::size_t next = 0;
    for (const plc::extent& run : to)
        for (std::size_t i = 0; i < run.count; ++i)
            memory.set_word({run.at.area, run.at.bit + 16 * i}, values[next++]);
}

// One overload for each request.
struct server {
    plc::simulated_plc& plc;

    std::optional<extents> find(table in, modbus::address first, std::size_t count) const
    {
        return plc.map().find(plc.memory(), in, first, count);
    }

    response operator()(const modbus::read_table& r) const
    {
        const auto from = find(r.from, r.first, r.count);
        if (!from)
            return exception_code::illegal_data_address;
        if (modbus::is_bit_table(r.from))
            return modbus::bits_read{read_bits(plc.memory(), *from)};
        return modbus::registers_read{read_words(plc.memory(), *from)};
    }

    response operator()(const modbus::write_single_coil& r) const { return write_coils(r.at, {r.on}); }
    response operator()(const modbus::write_multiple_coils& r) const { return write_coils(r.first, r.values); }

    response operator()(const modbus::write_single_register& r) const
    {
        return write_registers(r.at, std::span(&r.value, 1));
    }
    response operator()(const modbus::write_multiple_registers& r) const { return write_registers(r.first, r.values); }

    // V1.1b3 section 6.16: (current AND and_mask) OR (or_mask AND NOT and_mask)
    response operator()(const modbus::mask_write_register& r) const
    {
        const auto at = find(table::holding_registers, r.at, 1);
        if (!at)
            return exception_code::illegal_data_address;
        const unsigned current = plc.memory().word(at->front().at);
        const unsigned kept = current & r.and_mask;
        const unsigned forced = r.or_mask & ~static_cast<unsigned>(r.and_mask);
        plc.memory().set_word(at->front().at, static_cast<std::uint16_t>(kept | forced));
        return modbus::written{};
    }

    // V1.1b3 section 6.17: the write happens before the read, and not at all when the read is impossible.
    response operator()(const modbus::read_write_multiple_registers& r) const
    {
        const auto from = find(table::holding_registers, r.read_first, r.read_count);
        const auto to = find(table::holding_registers, r.write_first, r.values.size());
        if (!from || !to)
            return exception_code::illegal_data_address;
        write_words(plc.memory(), *to, r.values);
        return modbus::registers_read{read_words(plc.memory(), *from)};
    }

    template <class NotMemory>
    response operator()(const NotMemory&) const
    {
        return exception_code::illegal_function;
    }

private:
    response write_coils(modbus::address first, const std::vector<bool>& values) const
    {
        const auto to = find(table::coils, first, values.size());
        if (!to)
            return exception_code::illegal_data_address;
        write_bits(plc.memory(), *to, values);
        return modbus::written{};
    }

    response write_registers(modbus::address first, std::span<const std::uint16_t> values) const
    {
        const auto to = find(table::holding_registers, first, values.size());
        if (!to)
            return exception_code::illegal_data_address;
        write_words(plc.memory(), *to, values);
        return modbus::written{};
    }
};

// One request PDU: the checks that come before memory, then `serve`.
template <class Serve>
buffer serve_checked(const plc::model& m, bytes pdu, Serve serve_one)
{
    const std::uint8_t function_code = pdu.empty() ? std::uint8_t{0} : pdu[0];
    if (!plc::answers(m, modbus::function{function_code}, plc::transport::tcp))
        return modbus::encode_exception(function_code, exception_code::illegal_function);
    const auto question = modbus::parse_request(pdu);
    if (!question)
        return modbus::encode_exception(function_code, question.error());
    return modbus::encode_response(*question, serve_one(*question));
}

}  // namespace

modbus::response serve(plc::simulated_plc& plc, const modbus::request& question)
{
    return std::visit(server{plc}, question);
}

buffer serve_pdu(plc::simulated_plc& plc, bytes pdu)
{
    return serve_checked(plc.model(), pdu, [&](const modbus::request& question) { return serve(plc, question); });
}

buffer serve_pdu(plc::simulated_plc& plc, bytes pdu, std::string_view revision)
{
    return serve_checked(plc.model(), pdu, [&](const modbus::request& question) -> response {
        if (const auto* asked = std::get_if<modbus::read_device_identification>(&question))
            return identify(plc, revision, *asked);
        return serve(plc, question);
    });
}

}  // namespace plcgw
