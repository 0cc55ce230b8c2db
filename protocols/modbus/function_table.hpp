// How long requests and responses are, by function code: what ends a frame on a line where silence cannot be trusted.
// V1.1b3 chapter 6; section 7 for exceptions.
#pragma once

#include "protocols/bytes.hpp"

#include <optional>

namespace plcgw::modbus {

// Sizes are those of the PDU: function code first, without unit and CRC.
struct length_rule {
    enum class shape : std::uint8_t {
        unknown,         // only silence ends it
        fixed,           // `size` bytes
        counted,         // `size` bytes, and as many more as the byte at `count_at` says: a multiple of `step`
        counted_items,   // counted, and the two bytes before the count say how many items: bits, or words if step is 2
        counted_word,    // the count has two bytes
        identify,        // 2B/0E: `size` bytes; other MEI types are unknown
        identification,  // its response: objects with a length each
    };
    shape kind = shape::unknown;
    std::uint8_t size = 0;
    std::uint8_t count_at = 0;
    std::uint8_t step = 1;
};

struct function_row {
    std::uint8_t code;
    length_rule request;
    length_rule response;
};

namespace rules {
using enum length_rule::shape;
}

// clang-format off
inline constexpr function_row function_table[] = {
    // code  request                              response
    { 0x01, { rules::fixed, 5 },                { rules::counted, 2, 1 } },          // read coils
    { 0x02, { rules::fixed, 5 },                { rules::counted, 2, 1 } },          // read discrete inputs
    { 0x03, { rules::fixed, 5 },                { rules::counted, 2, 1, 2 } },       // read holding registers
    { 0x04, { rules::fixed, 5 },                { rules::counted, 2, 1, 2 } },       // read input registers
    { 0x05, { rules::fixed, 5 },                { rules::fixed, 5 } },               // write single coil
    { 0x06, { rules::fixed, 5 },                { rules::fixed, 5 } },               // write single register
    { 0x07, { rules::fixed, 1 },                { rules::fixed, 2 } },               // read exception status
    { 0x08, { rules::fixed, 5 },                {} },  // diagnostics: the response is as long as it
    { 0x0B, { rules::fixed, 1 },                { rules::fixed, 5 } },               // get comm event counter
    { 0x0C, { rules::fixed, 1 },                { rules::counted, 2, 1 } },          // get comm event log
    { 0x0F, { rules::counted_items, 6, 5 },     { rules::fixed, 5 } },               // write multiple coils
    { 0x10, { rules::counted_items, 6, 5, 2 },  { rules::fixed, 5 } },               // write multiple registers
    { 0x11, { rules::fixed, 1 },                { rules::counted, 2, 1 } },          // report server id
    { 0x14, { rules::counted, 2, 1, 7 },        { rules::counted, 2, 1 } },          // read file record
    { 0x15, { rules::counted, 2, 1 },           { rules::counted, 2, 1 } },          // write file record
    { 0x16, { rules::fixed, 7 },                { rules::fixed, 7 } },               // mask write register
    { 0x17, { rules::counted_items, 10, 9, 2 }, { rules::counted, 2, 1, 2 } },       // read/write multiple registers
    { 0x18, { rules::fixed, 3 },                { rules::counted_word, 3, 1, 2 } },  // read FIFO queue
    { 0x2B, { rules::identify, 4 },             { rules::identification, 7 } },      // 2B/0E: device identification
};
// clang-format on

// Size of the PDU that begins with these bytes. Nothing while they do not tell yet; 0 when no length is known, or when
// no such PDU can begin like this.
std::optional<std::size_t> request_length(bytes begin);
std::optional<std::size_t> response_length(bytes begin);

}  // namespace plcgw::modbus
