#include "protocols/mewtocol/types.hpp"

#include "protocols/mewtocol/text.hpp"

namespace plcgw::mewtocol {
namespace {

struct error_row {
    error_code code;
    std::string_view text;
};

// clang-format off
constexpr error_row error_table[] = {
    {error_code::undefined,               "undefined"},
    {error_code::not_acknowledged,        "remote unit not recognised"},
    {error_code::wait_acknowledged,       "receive buffer of the remote unit full"},
    {error_code::duplicate_station,       "station number used twice"},
    {error_code::transmission_format,     "transmission format"},
    {error_code::hardware,                "link unit hardware"},
    {error_code::station_setting,         "station number"},
    {error_code::frame_too_long,          "frame too long"},
    {error_code::no_response,             "no response from the remote unit"},
    {error_code::buffer_closed,           "buffer closed"},
    {error_code::timeout,                 "time-out"},
    {error_code::transmission_impossible, "transmission impossible"},
    {error_code::communication_stopped,   "communication stopped"},
    {error_code::no_such_station,         "no such station"},
    {error_code::other,                   "other communication error"},
    {error_code::check,                   "check code"},
    {error_code::format,                  "format"},
    {error_code::not_supported,           "command not supported"},
    {error_code::procedure,               "procedure"},
    {error_code::link_setting,            "link setting"},
    {error_code::simultaneous_operation,  "too many operations at once"},
    {error_code::sending_disabled,        "sending disabled"},
    {error_code::busy,                    "busy"},
    {error_code::parameter,               "parameter"},
    {error_code::data,                    "data"},
    {error_code::registration,            "registration"},
    {error_code::mode,                    "operating mode"},
    {error_code::external_memory,         "external memory"},
    {error_code::protection,              "protected"},
    {error_code::address,                 "address"},
    {error_code::no_program,              "no program or no data"},
    {error_code::rewrite_in_run,          "cannot be rewritten in RUN"},
    {error_code::exclusive_control,       "another command in process"},
    {error_code::no_card,                 "no SD card"},
};
// clang-format on

}  // namespace

std::optional<station_id> station_of_send(unsigned operand)
{
    if (operand == 0)
        return station_id::global;
    return station_of_recv(operand);
}

std::optional<station_id> station_of_recv(unsigned operand)
{
    if (operand < 1 || operand > 99)
        return std::nullopt;
    return station_id{static_cast<std::uint8_t>(operand)};
}

std::string to_string(error_code e)
{
    std::string text;
    append_hex(text, static_cast<std::uint8_t>(e), 2);
    for (const error_row& row : error_table)
        if (row.code == e)
            return text.append(" (").append(row.text).append(")");
    return text;
}

}  // namespace plcgw::mewtocol
