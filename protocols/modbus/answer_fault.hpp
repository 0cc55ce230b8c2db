// What came instead of an answer, for those who count and show it (FX3 manual 6.4 and 12.6, errors 205-208 and
// 211-214).
#pragma once

#include "protocols/errc.hpp"
#include "protocols/modbus/response.hpp"

#include <optional>

namespace plcgw::modbus {

struct answer_fault {
    errc why{};
    std::optional<frame> received;  // the whole frame of errc::unexpected_answer
    bool operator==(const answer_fault&) const = default;
};

// The first thing about a whole frame that does not fit the question.
enum class mismatch : std::uint8_t {
    unit,      // FX3 error 213
    function,  // 214
    length,    // 207: more or less data than was asked for
    content,   // the response to a write does not repeat the request
};

mismatch mismatch_of(unit_id asked, const request& question, const frame& received);

}  // namespace plcgw::modbus
