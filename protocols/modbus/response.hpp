// Responses as structs, and the check that a received one fits the question (V1.1b3 chapters 6 and 7).
#pragma once

#include "protocols/errc.hpp"
#include "protocols/modbus/request.hpp"

namespace plcgw::modbus {

struct bits_read {
    std::vector<bool> values;
    bool operator==(const bits_read&) const = default;
};

struct registers_read {
    std::vector<std::uint16_t> values;
    bool operator==(const registers_read&) const = default;
};

struct written {  // functions 05, 06, 0F, 10 and 16: the response repeats what the request said
    bool operator==(const written&) const = default;
};

using response = std::variant<bits_read, registers_read, written, exception_code>;

// The PDU that answers this request.
buffer encode_response(const request& question, const response& answer);

// The exception PDU for a request that could not even be parsed.
buffer encode_exception(std::uint8_t function_code, exception_code code);

// Size of the PDU that a server sends when it executes the request.
std::size_t response_size(const request& question);

inline constexpr std::size_t exception_size = 2;  // function code + 80H, exception code

// Fails with errc::unexpected_answer unless function, length and echoed fields fit the question.
result<response> parse_response(const request& question, bytes pdu);

}  // namespace plcgw::modbus
