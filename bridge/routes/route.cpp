#include "bridge/routes/route.hpp"

namespace plcgw {
namespace {

std::vector<bool> bits_in_memory(const route& r)
{
    std::vector<bool> bits(r.count);
    for (std::size_t i = 0; i < bits.size(); ++i)
        bits[i] = r.plc->memory().bit({r.at.area, r.at.bit + i});
    return bits;
}

std::vector<std::uint16_t> words_in_memory(const route& r)
{
    std::vector<std::uint16_t> words(r.count);
    r.plc->memory().read(r.at, words);
    return words;
}

std::vector<std::uint16_t> packed(const std::vector<bool>& bits)
{
    std::vector<std::uint16_t> words((bits.size() + 15) / 16);
    for (std::size_t i = 0; i < bits.size(); ++i)
        if (bits[i])
            words[i / 16] = static_cast<std::uint16_t>(words[i / 16] | 1U << (i % 16));
    return words;
}

modbus::request write_question(const route& r)
{
    if (modbus::is_bit_table(r.table)) {
        std::vector<bool> bits = bits_in_memory(r);
        if (bits.size() == 1)
            return modbus::write_single_coil{r.first, bits[0]};
        return modbus::write_multiple_coils{r.first, std::move(bits)};
    }
    std::vector<std::uint16_t> words = words_in_memory(r);
    if (words.size() == 1)
        return modbus::write_single_register{r.first, words[0]};
    return modbus::write_multiple_registers{r.first, std::move(words)};
}

std::vector<std::uint16_t> written_words(const modbus::request& question)
{
    if (const auto* coil = std::get_if<modbus::write_single_coil>(&question))
        return {static_cast<std::uint16_t>(coil->on ? 1 : 0)};
    if (const auto* coils = std::get_if<modbus::write_multiple_coils>(&question))
        return packed(coils->values);
    if (const auto* single = std::get_if<modbus::write_single_register>(&question))
        return {single->value};
    if (const auto* registers = std::get_if<modbus::write_multiple_registers>(&question))
        return registers->values;
    return {};
}

// One overload for each response that carries values. The memory's images hold bit and word devices alike, so bits
// can go into words and registers into bits.
struct storer {
    route& r;
    const modbus::request& question;

    void operator()(const modbus::bits_read& answer) const
    {
        for (std::size_t i = 0; i < answer.values.size(); ++i)
            r.plc->memory().set_bit({r.at.area, r.at.bit + i}, answer.values[i]);
        r.words = packed(answer.values);
    }
    void operator()(const modbus::registers_read& answer) const
    {
        for (std::size_t i = 0; i < answer.values.size(); ++i)
            r.plc->memory().set_word({r.at.area, r.at.bit + 16 * i}, answer.values[i]);
        r.words = answer.values;
    }
    void operator()(const modbus::written&) const { r.words = written_words(question); }
    void operator()(const modbus::no_response&) const { r.words = written_words(question); }  // a broadcast
    template <class Other>
    void operator()(const Other&) const
    {
    }
};

}  // namespace

std::size_t bits_of(const route& r) { return modbus::is_bit_table(r.table) ? r.count : std::size_t{16} * r.count; }

bool touches(const route& r, const plc::simulated_plc& plc, const plc::change& changed)
{
    return r.plc == &plc && plc::overlaps(changed, r.at, bits_of(r));
}

modbus::request question_of(const route& r)
{
    if (r.way == direction::read)
        return modbus::read_table{r.table, r.first, r.count};
    return write_question(r);
}

void store(route& r, const modbus::request& question, const modbus::response& answer)
{
    std::visit(storer{r, question}, answer);
}

sample sample_of(const route& r)
{
    return {.route = r.name,
            .area = std::string(modbus::to_string(r.table)),
            .first = modbus::number(r.first),
            .format = modbus::is_bit_table(r.table) ? sample_format::bits : sample_format::words,
            .count = r.count,
            .words = r.words,
            .state = r.state,
            .source = r.source};
}

}  // namespace plcgw
