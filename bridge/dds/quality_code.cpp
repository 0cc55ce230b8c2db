#include "bridge/dds/quality_code.hpp"

#include "registers.h"

namespace plcgw {
namespace {

struct quality_row {
    quality state;
    std::uint16_t code;
};

constexpr quality_row quality_table[] = {
    {quality::never_read, plcgw_v1_QUALITY_BAD},
    {quality::good, plcgw_v1_QUALITY_GOOD},
    {quality::stale, plcgw_v1_QUALITY_STALE},
    {quality::comm_error, plcgw_v1_QUALITY_BAD_COMM},
    {quality::device_error, plcgw_v1_QUALITY_BAD_DEVICE},
    {quality::substituted, plcgw_v1_QUALITY_SUBSTITUTED},
    {quality::out_of_limits, plcgw_v1_QUALITY_LIMITS},
    {quality::no_value, plcgw_v1_QUALITY_BAD_SENSOR},
};

constexpr bool agrees()
{
    for (const quality_row& row : quality_table)
        if (row.code != code_of(row.state))
            return false;
    return true;
}
static_assert(agrees());

}  // namespace

std::uint16_t quality_code(quality q) { return code_of(q); }

quality quality_from_code(std::uint16_t code)
{
    for (const auto& row : quality_table)
        if (row.code == code)
            return row.state;
    if (code < plcgw_v1_QUALITY_UNCERTAIN)
        return quality::comm_error;  // bad, and unlike QUALITY_BAD there may be a last known value
    return code < plcgw_v1_QUALITY_GOOD ? quality::stale : quality::good;
}

}  // namespace plcgw
