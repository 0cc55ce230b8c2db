#include "bridge/plc/mewtocol_areas.hpp"

#include <algorithm>

namespace plcgw::plc {
namespace {

using enum device_kind;

struct area_letter {
    char letter;
    device_kind kind;
};

constexpr area_letter contacts[] = {{'X', x}, {'Y', y}, {'R', relay}, {'L', link_relay}};
constexpr area_letter contact_words[] = {{'X', wx}, {'Y', wy}, {'R', wr}, {'L', wl}};
constexpr area_letter timer_contacts[] = {{'T', ts}, {'C', cs}};
constexpr area_letter data[] = {{'D', d}, {'L', ld}};
constexpr area_letter timer_values[] = {{'S', timer_set}, {'K', tn}};
constexpr area_letter counter_values[] = {{'S', counter_set}, {'K', cn}};

constexpr device_kind word_kinds[] = {wx, wy, wr, wl, d, ld};

constexpr std::size_t bits_of_value = 32;

std::optional<device_kind> kind_of(std::span<const area_letter> letters, char letter)
{
    const auto row =
        std::find_if(letters.begin(), letters.end(), [letter](const area_letter& a) { return a.letter == letter; });
    return row == letters.end() ? std::nullopt : std::optional(row->kind);
}

// The first of the area decides whether the model has it at all.
area_place run_at(const memory& of, std::optional<device_kind> kind, std::uint32_t first, std::size_t bits)
{
    if (!kind || !of.find({*kind, 0}))
        return area_fault::no_such_area;
    const auto at = of.find({*kind, first});
    if (!at || of.bits_from(*at) < bits)
        return area_fault::out_of_range;
    return *at;
}

}  // namespace

area_place contact_at(const memory& of, char letter, std::uint32_t word, unsigned bit)
{
    const auto kind = kind_of(contacts, letter);
    if (kind && (bit > 15 || word > 0xFFFF))
        return area_fault::out_of_range;
    return run_at(of, kind, 16 * word + bit, 1);
}

area_place timer_contact_at(const memory& of, char letter, std::uint32_t number)
{
    return run_at(of, kind_of(timer_contacts, letter), number, 1);
}

area_place contact_words_at(const memory& of, char letter, std::uint32_t first, std::size_t count)
{
    return run_at(of, kind_of(contact_words, letter), first, 16 * count);
}

area_place data_at(const memory& of, char letter, std::uint32_t first, std::size_t count)
{
    return run_at(of, kind_of(data, letter), first, 16 * count);
}

area_place named_words_at(const memory& of, std::string_view name, std::uint32_t first, std::size_t count)
{
    for (const device_name& row : of.model().names) {
        const bool words = std::find(std::begin(word_kinds), std::end(word_kinds), row.kind) != std::end(word_kinds);
        if (words && row.name == name)
            return run_at(of, row.kind, first, 16 * count);
    }
    return area_fault::no_such_area;
}

area_place value_at(const memory& of, char letter, std::uint32_t number)
{
    const auto timer = kind_of(timer_values, letter);
    const auto timers_at = timer ? of.find({*timer, 0}) : std::nullopt;
    if (!timers_at)
        return area_fault::no_such_area;
    const auto timers = static_cast<std::uint32_t>(of.bits_from(*timers_at) / bits_of_value);
    if (number < timers)
        return run_at(of, timer, number, bits_of_value);
    return run_at(of, kind_of(counter_values, letter), number - timers, bits_of_value);
}

void set_value(memory& in, place low_word, std::uint16_t value)
{
    in.set_word(low_word, value);
    in.set_word({low_word.area, low_word.bit + 16}, 0);
}

}  // namespace plcgw::plc
