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

std::vector<std::uint16_t> registers_in_memory(const route& r)
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

modbus::request write_question(const route& r, const modbus_place& to)
{
    if (modbus::is_bit_table(to.table)) {
        std::vector<bool> bits = bits_in_memory(r);
        if (bits.size() == 1)
            return modbus::write_single_coil{to.first, bits[0]};
        return modbus::write_multiple_coils{to.first, std::move(bits)};
    }
    std::vector<std::uint16_t> words = registers_in_memory(r);
    if (words.size() == 1)
        return modbus::write_single_register{to.first, words[0]};
    return modbus::write_multiple_registers{to.first, std::move(words)};
}

// One overload for each protocol: a write of what the memory holds.
struct write_asker {
    const route& r;

    station_question operator()(const modbus_place& there) const { return write_question(r, there); }
    station_question operator()(const mewtocol::device& there) const
    {
        if (const auto* const contact = std::get_if<mewtocol::contact>(&there))
            return mewtocol::block{mewtocol::write_run{*contact, bits_in_memory(r)}};
        const auto& [area, first] = std::get<mewtocol::word_device>(there);
        return mewtocol::block{mewtocol::write_words{area, first, registers_in_memory(r)}};
    }
};

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

std::vector<std::uint16_t> written_words(const mewtocol::block& question)
{
    if (const auto* run = std::get_if<mewtocol::write_run>(&question))
        return packed(run->values);
    if (const auto* words = std::get_if<mewtocol::write_words>(&question))
        return words->values;
    return {};
}

// One overload for each response that carries values. The memory's images hold bit and word devices alike, so bits
// can go into words and words into bits.
struct storer {
    route& r;
    const station_question& question;

    void operator()(const modbus::bits_read& answer) const { take(answer.values); }
    void operator()(const modbus::registers_read& answer) const { take(answer.values); }
    void operator()(const modbus::written&) const { say_written(); }
    void operator()(const modbus::no_response&) const { say_written(); }  // a broadcast
    void operator()(const mewtocol::contacts_read& answer) const { take(answer.values); }
    void operator()(const mewtocol::words_read& answer) const { take(answer.values); }
    void operator()(const mewtocol::executed&) const { say_written(); }
    void operator()(const mewtocol::no_response&) const { say_written(); }  // to the global station
    template <class Other>
    void operator()(const Other&) const
    {
    }

private:
    void take(const std::vector<bool>& bits) const
    {
        for (std::size_t i = 0; i < bits.size(); ++i)
            r.plc->memory().set_bit({r.at.area, r.at.bit + i}, bits[i]);
        r.words = packed(bits);
    }
    void take(const std::vector<std::uint16_t>& words) const
    {
        for (std::size_t i = 0; i < words.size(); ++i)
            r.plc->memory().set_word({r.at.area, r.at.bit + 16 * i}, words[i]);
        r.words = words;
    }
    void say_written() const
    {
        r.words = std::visit([](const auto& asked) { return written_words(asked); }, question);
    }
};

}  // namespace

std::size_t bits_of(const route& r) { return is_bits(r.there) ? r.count : std::size_t{16} * r.count; }

bool touches(const route& r, const plc::simulated_plc& plc, const plc::change& changed)
{
    return r.plc == &plc && plc::overlaps(changed, r.at, bits_of(r));
}

station_question question_of(const route& r)
{
    return r.way == direction::read ? read_question(r.there, r.count) : std::visit(write_asker{r}, r.there);
}

void store(route& r, const station_question& question, const station_answer& answer)
{
    std::visit([&](const auto& of_protocol) { std::visit(storer{r, question}, of_protocol); }, answer);
}

std::vector<std::uint16_t> words_in_memory(const route& r)
{
    return is_bits(r.there) ? packed(bits_in_memory(r)) : registers_in_memory(r);
}

void put_words(const route& r, const std::vector<std::uint16_t>& words)
{
    plc::memory& memory = r.plc->memory();
    for (std::size_t bit = 0; is_bits(r.there) && bit < r.count; ++bit)
        memory.put_bit({r.at.area, r.at.bit + bit}, (words[bit / 16] >> bit % 16 & 1U) != 0);
    for (std::size_t i = 0; !is_bits(r.there) && i < r.count; ++i)
        memory.put_word({r.at.area, r.at.bit + 16 * i}, words[i]);
}

void show_substitute(route& r)
{
    r.words = r.substitute;
    put_words(r, r.words);
}

sample sample_of(const route& r)
{
    return {.route = r.name,
            .area = area_name(r.there),
            .first = number(r.there),
            .format = is_bits(r.there) ? sample_format::bits : sample_format::words,
            .count = r.count,
            .words = r.words,
            .state = r.state,
            .source = r.source};
}

}  // namespace plcgw
