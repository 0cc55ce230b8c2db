#include "bridge/plc/model.hpp"

#include "bridge/plc/models/fx3g.hpp"
#include "bridge/plc/models/fx3s.hpp"
#include "bridge/plc/models/fx3u.hpp"
#include "bridge/plc/models/ls.hpp"

#include <algorithm>
#include <cctype>

namespace plcgw::plc {
namespace {

const model* const models[] = {&fx3s, &fx3g, &fx3gc, &fx3u, &fx3uc, &ls22, &ls32};

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
        return a.kind == d.kind && d.number >= a.first + a.absent && d.number < a.first + a.count;
    });
}

const model* find_model(std::string_view name)
{
    for (const model* candidate : models)
        if (std::equal(name.begin(), name.end(), candidate->name.begin(), candidate->name.end(), same_letters))
            return candidate;
    return nullptr;
}

}  // namespace plcgw::plc
