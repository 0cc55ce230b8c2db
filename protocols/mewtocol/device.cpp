#include "protocols/mewtocol/device.hpp"

#include "protocols/mewtocol/text.hpp"

namespace plcgw::mewtocol {
namespace {

constexpr std::uint32_t highest_contact_word = UINT16_MAX / 16;

std::string_view letter_of(contact_area a)
{
    static constexpr std::string_view letters = "XYRLTC";
    return letters.substr(letters.find(static_cast<char>(a)), 1);
}

std::optional<device> word_named(const word_area_row& row, std::string_view digits)
{
    if (row.digits == 0)
        return digits.empty() ? std::optional<device>(word_device{row.area, 0}) : std::nullopt;
    const auto number = read_dec(digits);
    if (!number || *number > highest_number(row.digits))
        return std::nullopt;
    return word_device{row.area, *number};
}

std::optional<device> contact_named(contact_area area, std::string_view digits)
{
    if (is_numbered(area)) {
        const auto number = read_dec(digits);
        if (!number || *number > max_timer_number)
            return std::nullopt;
        return contact{area, static_cast<std::uint16_t>(*number)};
    }
    if (digits.empty())
        return std::nullopt;
    const std::string_view word_digits = digits.substr(0, digits.size() - 1);
    const auto word = word_digits.empty() ? std::optional<std::uint32_t>(0) : read_dec(word_digits);
    const auto bit = read_hex(digits.substr(digits.size() - 1));
    if (!word || !bit || *word > highest_contact_word)
        return std::nullopt;
    return contact{area, static_cast<std::uint16_t>(16 * *word + *bit)};
}

}  // namespace

std::optional<device> parse_device(std::string_view text)
{
    for (const word_area_row& row : word_area_table)
        if (text.starts_with(row.name))
            if (const auto found = word_named(row, text.substr(row.name.size())))
                return found;
    // LD without a number would be bit D of L0, and is a data register that lost its digits.
    if (text.empty() || text == "LD" || !is_contact_area(text[0]))
        return std::nullopt;
    return contact_named(contact_area{text[0]}, text.substr(1));
}

std::string to_string(const device& d)
{
    std::string text(area_name(d));
    const auto* const point = std::get_if<contact>(&d);
    if (point == nullptr) {
        const word_area area = std::get<word_device>(d).area;
        return row_of(area).digits == 0 ? text : text + std::to_string(number(d));
    }
    if (is_numbered(point->area))
        return text + std::to_string(point->number);
    if (point->number >= 16)
        text += std::to_string(point->number / 16);
    append_hex(text, point->number % 16U, 1);
    return text;
}

std::string_view area_name(const device& d)
{
    if (const auto* const point = std::get_if<contact>(&d))
        return letter_of(point->area);
    return to_string(std::get<word_device>(d).area);
}

std::uint32_t number(const device& d)
{
    if (const auto* const point = std::get_if<contact>(&d))
        return point->number;
    return std::get<word_device>(d).number;
}

std::optional<word_area> words_of(contact_area a)
{
    switch (a) {
    case contact_area::external_input: return word_area::wx;
    case contact_area::external_output: return word_area::wy;
    case contact_area::internal_relay: return word_area::wr;
    case contact_area::link_relay: return word_area::wl;
    case contact_area::timer:
    case contact_area::counter: break;
    }
    return std::nullopt;
}

}  // namespace plcgw::mewtocol
