#include "protocols/modbus/answer_fault.hpp"

namespace plcgw::modbus {

mismatch mismatch_of(unit_id asked, const request& question, const frame& received)
{
    if (received.unit != asked)
        return mismatch::unit;
    const auto code = static_cast<std::uint8_t>(function_of(question));
    if (received.pdu.empty() || (received.pdu[0] & 0x7F) != code)
        return mismatch::function;
    const bool exception = received.pdu[0] != code;
    const auto size = exception ? std::optional(exception_size) : response_size(question, received.pdu);
    return size == received.pdu.size() ? mismatch::content : mismatch::length;
}

}  // namespace plcgw::modbus
