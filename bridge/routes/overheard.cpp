#include "bridge/routes/overheard.hpp"

namespace plcgw {
namespace {

station_place place(modbus::table of, modbus::address first) { return modbus_place{of, first}; }
station_place place(const mewtocol::contact& first) { return mewtocol::device{first}; }
station_place place(mewtocol::word_area of, std::uint32_t first)
{
    return mewtocol::device{mewtocol::word_device{of, first}};
}

std::vector<std::uint16_t> numbers(const std::vector<bool>& bits) { return {bits.begin(), bits.end()}; }

// One overload for each question that reads, and for each that writes.
struct reader {
    using found = std::optional<asked_registers>;

    found operator()(const modbus::read_table& q) const { return asked_registers{place(q.from, q.first), q.count}; }
    found operator()(const modbus::read_write_multiple_registers& q) const
    {
        return asked_registers{place(modbus::table::holding_registers, q.read_first), q.read_count};
    }
    found operator()(const mewtocol::read_words& q) const { return asked_registers{place(q.from, q.first), q.count}; }
    found operator()(const mewtocol::read_run& q) const { return asked_registers{place(q.first), q.count}; }
    template <class Other>
    found operator()(const Other&) const
    {
        return std::nullopt;
    }
};

struct writer {
    using found = std::optional<written_registers>;

    found operator()(const modbus::write_single_coil& q) const
    {
        return written_registers{place(modbus::table::coils, q.at), {static_cast<std::uint16_t>(q.on ? 1 : 0)}};
    }
    found operator()(const modbus::write_multiple_coils& q) const
    {
        return written_registers{place(modbus::table::coils, q.first), numbers(q.values)};
    }
    found operator()(const modbus::write_single_register& q) const
    {
        return written_registers{place(modbus::table::holding_registers, q.at), {q.value}};
    }
    found operator()(const modbus::write_multiple_registers& q) const
    {
        return written_registers{place(modbus::table::holding_registers, q.first), q.values};
    }
    found operator()(const modbus::read_write_multiple_registers& q) const
    {
        return written_registers{place(modbus::table::holding_registers, q.write_first), q.values};
    }
    found operator()(const mewtocol::write_words& q) const { return written_registers{place(q.to, q.first), q.values}; }
    found operator()(const mewtocol::write_run& q) const
    {
        return written_registers{place(q.first), numbers(q.values)};
    }
    template <class Other>
    found operator()(const Other&) const
    {
        return std::nullopt;
    }
};

template <class Visitor>
typename Visitor::found ask(const Visitor& what, const station_question& asked)
{
    return std::visit([&](const auto& of_protocol) { return std::visit(what, of_protocol); }, asked);
}

}  // namespace

std::optional<asked_registers> read_in(const station_question& asked) { return ask(reader{}, asked); }
std::optional<written_registers> written_in(const station_question& asked) { return ask(writer{}, asked); }

bool is_in_one_area(const station_place& a, const station_place& b)
{
    return a.index() == b.index() && is_bits(a) == is_bits(b) && area_name(a) == area_name(b);
}

bool covers(const station_place& first, std::uint32_t count, const station_place& others, std::uint32_t of_these)
{
    return is_in_one_area(first, others) && number(first) <= number(others) &&
           number(others) + of_these <= number(first) + count;
}

bool overlap(const station_place& first, std::uint32_t count, const station_place& others, std::uint32_t of_these)
{
    return is_in_one_area(first, others) && number(first) < number(others) + of_these &&
           number(others) < number(first) + count;
}

void overlay(std::vector<std::uint16_t>& words, const station_place& first, std::uint32_t count,
             const written_registers& written)
{
    for (std::size_t i = 0; i < written.values.size(); ++i) {
        const std::size_t at = number(written.first) + i - number(first);  // wraps round in front of the first
        if (at >= count)
            continue;
        if (!is_bits(first)) {
            words[at] = written.values[i];
            continue;
        }
        const auto bit = static_cast<std::uint16_t>(1U << at % 16);
        words[at / 16] =
            static_cast<std::uint16_t>(written.values[i] != 0 ? words[at / 16] | bit : words[at / 16] & ~bit);
    }
}

}  // namespace plcgw
