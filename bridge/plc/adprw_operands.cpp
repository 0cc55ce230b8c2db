#include "bridge/plc/adprw_operands.hpp"

#include <algorithm>

namespace plcgw::plc {
namespace {

using enum operation_error;

unsigned kind_of(const operand& o)
{
    if (std::holds_alternative<std::uint16_t>(o))
        return operands::constants;
    switch (std::get<device>(o).kind) {
    case device_kind::d:
    case device_kind::r: return operands::registers;
    case device_kind::x: return operands::inputs;
    default: return operands::relays;
    }
}

// The system's own M and D are no operands (8.2.1).
bool is_user_device(const model& m, device at)
{
    const bool special = (at.kind == device_kind::m || at.kind == device_kind::d) && at.number >= special_first;
    return !special && std::any_of(m.areas.begin(), m.areas.end(), [&](const area& a) { return a.kind == at.kind; });
}

}  // namespace

bool operand_reader::is_constant(unsigned number) const
{
    return kind_of(operands_[number - 1]) == operands::constants;
}

void operand_reader::refuse(unsigned number, operation_error why)
{
    if (!fault_)
        fault_ = operand_fault{number, why};
}

std::optional<place> operand_reader::find(unsigned number, unsigned allowed, std::size_t bits)
{
    const auto& o = operands_[number - 1];
    if (is_constant(number) || (kind_of(o) & allowed) == 0 || !is_user_device(devices_.model(), std::get<device>(o))) {
        refuse(number, wrong_device);
        return std::nullopt;
    }
    const auto at = devices_.find(std::get<device>(o));
    if (!at || devices_.bits_from(*at) < bits) {
        refuse(number, out_of_range);
        return std::nullopt;
    }
    return at;
}

std::uint16_t operand_reader::value(unsigned number, std::uint16_t least, std::uint16_t most)
{
    std::uint16_t read = 0;
    if (is_constant(number))
        read = std::get<std::uint16_t>(operands_[number - 1]);
    else if (const auto at = find(number, operands::registers, 16))
        read = devices_.word(*at);
    if (read < least || read > most)
        refuse(number, out_of_range);
    return fault_ ? std::uint16_t{0} : read;
}

std::pair<std::uint16_t, std::uint16_t> operand_reader::pair(unsigned number)
{
    const auto at = find(number, operands::registers, 32);
    if (!at)
        return {};
    return {devices_.word(*at), devices_.word({at->area, at->bit + 16})};
}

std::optional<place> operand_reader::block(unsigned allowed, std::size_t bits) { return find(5, allowed, bits); }

std::vector<std::uint16_t> operand_reader::words(unsigned allowed, std::size_t count)
{
    if ((allowed & operands::constants) != 0 && is_constant(5))
        return std::vector<std::uint16_t>(count, std::get<std::uint16_t>(operands_[4]));
    std::vector<std::uint16_t> values(count);
    if (const auto from = block(allowed, 16 * count))
        devices_.read(*from, values);
    return values;
}

std::vector<bool> operand_reader::coils(unsigned allowed, std::size_t count)
{
    std::vector<bool> values(count);
    const bool bit_devices = !is_constant(5) && kind_of(operands_[4]) != operands::registers;
    if (bit_devices) {
        const auto from = block(allowed, count);
        for (std::size_t i = 0; from && i < count; ++i)
            values[i] = devices_.bit({from->area, from->bit + i});
        return values;
    }
    const auto packed = words(allowed, (count + 15) / 16);
    for (std::size_t i = 0; i < count; ++i)
        values[i] = (packed[i / 16] >> i % 16 & 1U) != 0;
    return values;
}

bool operand_reader::coil(unsigned allowed)
{
    if (is_constant(5) || kind_of(operands_[4]) == operands::registers) {
        const std::uint16_t state = words(allowed, 1).front();
        if (state > 1)
            refuse(5, out_of_range);
        return state == 1;
    }
    return coils(allowed, 1).front();
}

}  // namespace plcgw::plc
