#include "bridge/plc/adprw_outcome.hpp"

namespace plcgw::plc {
namespace {

struct error_row {
    errc why;
    modbus_error code;
};

constexpr error_row errors[] = {
    {errc::bad_checksum, modbus_error::checksum},
    {errc::bad_header, modbus_error::checksum},
    {errc::incomplete, modbus_error::checksum},
    {errc::too_short, modbus_error::checksum},
    {errc::overlong, modbus_error::character_overrun},
    {errc::bad_character, modbus_error::unconvertible_character},
    {errc::timed_out, modbus_error::timeout},
    {errc::unexpected_answer, modbus_error::length_mismatch},
    {errc::collision, modbus_error::bit_level},
    {errc::line_not_quiet, modbus_error::character_overrun},  // more came than any frame holds
};

adprw_failure mismatch(modbus::unit_id unit, const modbus::request& asked, const modbus::frame& received)
{
    if (received.unit != unit)
        return {modbus_error::station_mismatch, static_cast<std::uint8_t>(received.unit)};
    const auto code = static_cast<std::uint8_t>(function_of(asked));
    if (!received.pdu.empty() && (received.pdu[0] & 0x7F) != code)
        return {modbus_error::function_mismatch, received.pdu[0]};
    return {modbus_error::length_mismatch};
}

}  // namespace

adprw_failure failure_of(boost::system::error_code why, modbus::unit_id unit, const modbus::request& asked,
                         const std::optional<modbus::frame>& received)
{
    if (why == errc::unexpected_answer && received)
        return mismatch(unit, asked, *received);
    for (const error_row& row : errors)
        if (why == row.why)
            return {row.code};
    return {modbus_error::invalid_hardware};  // the port or the connection is gone
}

}  // namespace plcgw::plc
