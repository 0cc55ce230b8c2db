#include "protocols/modbus/rtu.hpp"

#include "protocols/modbus/crc.hpp"

namespace plcgw::modbus {
namespace {

// Bytes that are kept although no answer is in them yet: enough for any noise before the longest frame.
constexpr std::size_t most_kept = 4 * max_rtu_size;

}  // namespace

buffer encode_rtu(const frame& f)
{
    buffer adu;
    adu.reserve(f.pdu.size() + rtu_overhead);
    adu.push_back(static_cast<std::uint8_t>(f.unit));
    adu.insert(adu.end(), f.pdu.begin(), f.pdu.end());
    const std::uint16_t crc = crc16(adu);
    adu.push_back(static_cast<std::uint8_t>(crc & 0xFF));
    adu.push_back(static_cast<std::uint8_t>(crc >> 8));
    return adu;
}

rtu_answer::rtu_answer(unit_id unit, const request& question)
    : unit_(unit), question_(&question), function_(static_cast<std::uint8_t>(function_of(question)))
{
}

std::optional<response> rtu_answer::feed(bytes received)
{
    received_.insert(received_.end(), received.begin(), received.end());
    for (std::size_t start = 0; start + 2 <= received_.size(); ++start)
        if (auto answer = answer_at(start))
            return answer;
    if (received_.size() > most_kept)
        received_.erase(received_.begin(), received_.end() - most_kept / 2);
    return std::nullopt;
}

std::optional<response> rtu_answer::answer_at(std::size_t start) const
{
    const bytes rest = bytes(received_).subspan(start);
    if (rest[0] != static_cast<std::uint8_t>(unit_) || (rest[1] & 0x7F) != function_)
        return std::nullopt;
    const auto size = rest[1] == function_ ? response_size(*question_, rest.subspan(1)) : exception_size;
    if (!size || rest.size() < *size + rtu_overhead || !crc_fits(rest.first(*size + rtu_overhead)))
        return std::nullopt;
    auto answer = parse_response(*question_, rest.subspan(1, *size));
    if (!answer)
        return std::nullopt;
    return std::move(*answer);
}

bool rtu_answer::begun() const
{
    for (std::size_t i = 0; i < received_.size(); ++i)
        if (received_[i] == static_cast<std::uint8_t>(unit_) &&
            (i + 1 == received_.size() || (received_[i + 1] & 0x7F) == function_))
            return true;
    return false;
}

bool rtu_answer::whole() const
{
    for (std::size_t i = 0; i + exception_size + rtu_overhead <= received_.size(); ++i) {
        const bytes rest = bytes(received_).subspan(i);
        if (rest[0] != static_cast<std::uint8_t>(unit_) || (rest[1] & 0x7F) != function_)
            continue;
        const auto size = rest[1] == function_ ? response_size(*question_, rest.subspan(1)) : exception_size;
        if (size && rest.size() >= *size + rtu_overhead)
            return true;
    }
    return false;
}

errc rtu_answer::failure() const
{
    if (received_.empty())
        return errc::timed_out;
    if (received_.size() < exception_size + rtu_overhead)
        return errc::incomplete;
    if (crc_fits(received_))
        return errc::unexpected_answer;
    if (received_.size() > max_rtu_size)
        return errc::overlong;  // FX3 error 206
    const bool answers_us = received_[0] == static_cast<std::uint8_t>(unit_) && received_[1] == function_;
    const auto whole = response_size(*question_, bytes(received_).subspan(1));
    return answers_us && (!whole || received_.size() < *whole + rtu_overhead) ? errc::incomplete : errc::bad_checksum;
}

answer_fault rtu_answer::fault() const
{
    const errc why = failure();
    if (why != errc::unexpected_answer)
        return {why, {}};
    const bytes pdu = bytes(received_).subspan(1, received_.size() - rtu_overhead);
    return {why, frame{unit_id{received_[0]}, buffer(pdu.begin(), pdu.end())}};
}

}  // namespace plcgw::modbus
