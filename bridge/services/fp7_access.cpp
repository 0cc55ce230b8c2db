#include "bridge/services/fp7_access.hpp"

#include "bridge/plc/mewtocol_areas.hpp"

#include <algorithm>

namespace plcgw {
namespace {

using mewtocol::error_code;
using mewtocol::word_area;
using plc::device_kind;

struct area_row {
    word_area area;
    device_kind kind;
    std::optional<device_kind> then = {};  // the values behind the first kind
    char letter = 0;                       // of values: one word stands for 32 bits
};

// clang-format off
constexpr area_row areas[] = {
    {word_area::wx, device_kind::wx},
    {word_area::wy, device_kind::wy},
    {word_area::wr, device_kind::wr},
    {word_area::wl, device_kind::wl},
    {word_area::dt, device_kind::d},
    {word_area::ld, device_kind::ld},
    {word_area::sv, device_kind::timer_set, device_kind::counter_set, 'S'},
    {word_area::ev, device_kind::tn,        device_kind::cn,          'K'},
};
// clang-format on

const area_row* find_area(word_area area)
{
    const auto* const row =
        std::find_if(std::begin(areas), std::end(areas), [area](const area_row& r) { return r.area == area; });
    return row == std::end(areas) ? nullptr : row;
}

std::uint32_t devices_of(const plc::memory& memory, device_kind kind, std::size_t bits)
{
    const auto first = memory.find({kind, 0});
    return first ? static_cast<std::uint32_t>(memory.bits_from(*first) / bits) : 0;
}

error_code code_of(plc::area_fault f)
{
    return f == plc::area_fault::no_such_area ? error_code::parameter : error_code::data;
}

plc::area_place find_contact(const plc::memory& memory, const mewtocol::contact& at)
{
    const char letter = static_cast<char>(at.area);
    if (mewtocol::is_numbered(at.area))
        return plc::timer_contact_at(memory, letter, at.number);
    return plc::contact_at(memory, letter, at.number / 16U, at.number % 16U);
}

// The caller has asked words_in().
plc::place find_word(const plc::memory& memory, const area_row& row, std::uint32_t number)
{
    if (row.letter != 0)
        return *plc::value_at(memory, row.letter, number);
    return memory.find({row.kind, number}).value();
}

}  // namespace

fp7_access::fp7_access(plc::simulated_plc& plc, duration scan) : plc_(&plc), scan_(scan) {}

void fp7_access::look(time_point now)
{
    if (looked_ && plc_->state() == plc::run_state::run)
        in_run_ += now - *looked_;
    looked_ = now;
}

fp7_access::answer<std::vector<std::uint16_t>> fp7_access::read_words(word_area from, std::uint32_t first,
                                                                      std::uint32_t count) const
{
    const area_row* const row = find_area(from);
    if (row == nullptr)
        return error_code::parameter;
    std::vector<std::uint16_t> words;
    for (std::uint32_t number = first; number < first + count; ++number)
        words.push_back(plc_->memory().word(find_word(plc_->memory(), *row, number)));
    return words;
}

fp7_access::refusal fp7_access::write_words(word_area to, std::uint32_t first, std::span<const std::uint16_t> values)
{
    const area_row* const row = find_area(to);
    if (row == nullptr || to == word_area::wx)
        return error_code::parameter;
    for (const std::uint16_t value : values) {
        const plc::place at = find_word(plc_->memory(), *row, first++);
        if (row->letter != 0)
            plc::set_value(plc_->memory(), at, value);
        else
            plc_->memory().set_word(at, value);
    }
    return std::nullopt;
}

fp7_access::answer<bool> fp7_access::read_contact(const mewtocol::contact& at) const
{
    const auto found = find_contact(plc_->memory(), at);
    if (!found)
        return code_of(found.error());
    return plc_->memory().bit(*found);
}

fp7_access::refusal fp7_access::write_contacts(std::span<const mewtocol::contact_value> values)
{
    std::vector<plc::place> places;
    for (const mewtocol::contact_value& each : values) {
        if (!mewtocol::is_writable(each.at.area))
            return error_code::parameter;
        const auto found = find_contact(plc_->memory(), each.at);
        if (!found)
            return code_of(found.error());
        places.push_back(*found);
    }
    for (std::size_t i = 0; i < values.size(); ++i)
        plc_->memory().set_bit(places[i], values[i].on);
    return std::nullopt;
}

std::uint32_t fp7_access::words_in(word_area area) const
{
    const area_row* const row = find_area(area);
    if (row == nullptr)
        return 0;
    const std::size_t bits = row->letter == 0 ? 16 : 32;
    const std::uint32_t words = devices_of(plc_->memory(), row->kind, bits);
    return row->then ? words + devices_of(plc_->memory(), *row->then, bits) : words;
}

mewtocol::plc_status fp7_access::status() const
{
    return {.mode = static_cast<std::uint8_t>(plc_->state() == plc::run_state::run ? 1 : 0)};
}

// The unit of which an answer was recorded: CPS41E, version 4.53.
fp7_access::answer<mewtocol7::state_read> fp7_access::state() const
{
    constexpr std::uint16_t version = 0x0453;
    return mewtocol7::state_read{.model = 3,
                                 .newest_version = version,
                                 .communication_version = version,
                                 .operation_version = version,
                                 .mode = status().mode,
                                 .rest = "660100"};
}

fp7_access::refusal fp7_access::change_mode(mewtocol::operating_mode to)
{
    if (to == mewtocol::operating_mode::run)
        plc_->run();
    else
        plc_->stop();
    return std::nullopt;
}

std::uint64_t fp7_access::scans() const { return static_cast<std::uint64_t>(in_run_ / scan_); }

}  // namespace plcgw
