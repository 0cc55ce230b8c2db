#include "bridge/plc/model.hpp"

#include "bridge/plc/models/fp7.hpp"
#include "bridge/plc/models/fx3g.hpp"
#include "bridge/plc/models/fx3s.hpp"
#include "bridge/plc/models/fx3u.hpp"
#include "bridge/plc/models/ls.hpp"

#include <algorithm>
#include <cctype>

namespace plcgw::plc {
namespace {

const model* const models[] = {&fx3s, &fx3g, &fx3gc, &fx3u, &fx3uc, &ls22, &ls32, &fp7};

bool same_letters(char a, char b)
{
    return std::toupper(static_cast<unsigned char>(a)) == std::toupper(static_cast<unsigned char>(b));
}

}  // namespace

bool answers(const model& m, modbus::function f, transport over)
{
    const auto list = over == transport::tcp ? m.functions : m.serial_functions;
    return std::find(list.begin(), list.end(), f) != list.end();
}

std::span<const model* const> all_models() { return models; }

bool exists(const model& m, device d)
{
    return std::any_of(m.areas.begin(), m.areas.end(), [d](const area& a) {
        const auto bit = first_bit(a, d);
        return bit && *bit >= std::size_t{a.absent} * a.bits_per_device;
    });
}

std::size_t bits_of(const area& a, device_kind kind) { return kind == a.words ? 16 : a.bits_per_device; }

std::optional<std::size_t> first_bit(const area& of, device d)
{
    if ((d.kind != of.kind && d.kind != of.words) || d.number < of.first)
        return std::nullopt;
    const std::size_t bit = std::size_t{d.number - of.first} * bits_of(of, d.kind);
    if (bit >= std::size_t{of.count} * of.bits_per_device)
        return std::nullopt;
    return bit;
}

const model* find_model(std::string_view name)
{
    for (const model* candidate : models)
        if (std::equal(name.begin(), name.end(), candidate->name.begin(), candidate->name.end(), same_letters))
            return candidate;
    return nullptr;
}

}  // namespace plcgw::plc
