#include "bridge/plc/model.hpp"

#include "bridge/plc/models/fx3u.hpp"

#include <algorithm>
#include <cctype>

namespace plcgw::plc {
namespace {

const model* const models[] = {&fx3u, &fx3uc};

bool same_letters(char a, char b)
{
    return std::toupper(static_cast<unsigned char>(a)) == std::toupper(static_cast<unsigned char>(b));
}

}  // namespace

std::span<const model* const> all_models() { return models; }

const model* find_model(std::string_view name)
{
    for (const model* candidate : models)
        if (std::equal(name.begin(), name.end(), candidate->name.begin(), candidate->name.end(), same_letters))
            return candidate;
    return nullptr;
}

}  // namespace plcgw::plc
