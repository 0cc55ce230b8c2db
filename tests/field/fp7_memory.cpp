#include "tests/field/fp7_memory.hpp"

#include <sstream>
#include <stdexcept>

namespace plcgw::field {

namespace {

struct place {
    const fp7_area_row* row;
    bool words;          // or contacts
    std::size_t number;  // of the word, or of the contact in its area
};

// All of the text must be a number.
std::size_t number(const std::string& text, int base)
{
    std::size_t used = 0;
    const auto value = std::stoul(text, &used, base);
    if (used != text.size())
        throw std::invalid_argument(text + " is no number");
    return value;
}

place find(const std::string& device)
{
    for (const fp7_area_row& row : fp7_data) {
        if (device.starts_with(row.view))
            return {&row, true, number(device.substr(2), 10)};
    }
    for (const fp7_area_row& row : fp7_contacts) {
        if (!row.view.empty() && device.starts_with(row.view))
            return {&row, true, number(device.substr(2), 10)};
        if (device.empty() || device.front() != row.letter)
            continue;
        if (!row.numbered_in_words)
            return {&row, false, number(device.substr(1), 10)};
        const std::string word = device.substr(1, device.size() - 2);
        return {&row, false, (word.empty() ? 0 : number(word, 10)) * 16 + number(device.substr(device.size() - 1), 16)};
    }
    throw std::invalid_argument("an FP7 has no device " + device);
}

}  // namespace

fp7_memory::fp7_memory()
{
    for (const fp7_area_row& row : fp7_contacts)
        areas_[index(row.area)].resize(row.words);
    for (const fp7_area_row& row : fp7_data)
        areas_[index(row.area)].resize(row.words);
}

void fp7_memory::set_contact(fp7_area area, std::size_t word, unsigned bit, bool on)
{
    std::uint16_t& held = areas_[index(area)][word];
    held = static_cast<std::uint16_t>(on ? held | 1U << bit : held & ~(1U << bit));
}

void fp7_memory::assign(const std::string& assignment)
{
    const auto equals = assignment.find('=');
    if (equals == std::string::npos)
        throw std::invalid_argument(assignment + ": expected DEVICE=VALUE[,VALUE...]");
    const place first = find(assignment.substr(0, equals));
    std::istringstream values(assignment.substr(equals + 1));
    std::string value;
    for (std::size_t at = first.number; std::getline(values, value, ','); ++at) {
        const std::size_t word = first.words ? at : at / 16;
        if (word >= first.row->words)
            throw std::invalid_argument(assignment + ": beyond the area");
        if (first.words)
            areas_[index(first.row->area)][word] = static_cast<std::uint16_t>(number(value, 0));
        else
            set_contact(first.row->area, word, at % 16, number(value, 0) != 0);
    }
}

}  // namespace plcgw::field
