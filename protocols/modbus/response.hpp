// Responses as structs, and the check that a received one fits the question (V1.1b3 chapters 6 and 7).
#pragma once

#include "protocols/errc.hpp"
#include "protocols/modbus/request.hpp"

#include <string>

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

struct exception_status_read {
    std::uint8_t status{};
    bool operator==(const exception_status_read&) const = default;
};

struct diagnostics_answered {  // the sub-function is the question's
    buffer data;               // as on the wire
    bool operator==(const diagnostics_answered&) const = default;
};

struct event_counter_read {
    std::uint16_t status{};  // FFFF while a program command runs
    std::uint16_t events{};
    bool operator==(const event_counter_read&) const = default;
};

struct event_log_read {
    std::uint16_t status{};
    std::uint16_t events{};
    std::uint16_t messages{};
    buffer log;  // newest first, at most 64
    bool operator==(const event_log_read&) const = default;
};

struct server_id_read {
    buffer data;  // an FX3: F3, then 00 (STOP) or FF (RUN)
    bool operator==(const server_id_read&) const = default;
};

struct device_identification_read {
    struct object {
        std::uint8_t id{};
        std::string value;
        bool operator==(const object&) const = default;
    };
    read_device_identification::access how{};
    std::uint8_t conformity{};
    std::uint8_t more_follows{};  // 00 or FF
    std::uint8_t next_object{};
    std::vector<object> objects;
    bool operator==(const device_identification_read&) const = default;
};

struct no_response {  // executed, and nothing is sent: "force listen only" and a restart out of it
    bool operator==(const no_response&) const = default;
};

using response =
    std::variant<bits_read, registers_read, written, exception_code, exception_status_read, diagnostics_answered,
                 event_counter_read, event_log_read, server_id_read, device_identification_read, no_response>;

// The PDU that answers this request; empty for no_response.
buffer encode_response(const request& question, const response& answer);

// The exception PDU for a request that could not even be parsed.
buffer encode_exception(std::uint8_t function_code, exception_code code);

// Nobody answers a broadcast, nor "force listen only".
bool expects_answer(unit_id unit, const request& question);

// Whether the right answer repeats the request byte for byte: functions 05 and 06, and 08 where data is echoed.
bool echoes_request(const request& question);

// Size of the PDU that a server sends when it executes the request, as far as the bytes of it that came so far tell.
// Nothing while they do not: functions 0C, 11 and 2B say it in the response itself.
std::optional<std::size_t> response_size(const request& question, bytes begin);

inline constexpr std::size_t exception_size = 2;  // function code + 80H, exception code

// Fails with errc::unexpected_answer unless function, length and echoed fields fit the question.
result<response> parse_response(const request& question, bytes pdu);

}  // namespace plcgw::modbus
