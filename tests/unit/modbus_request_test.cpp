#include "tests/support/frames.hpp"
#include "tests/support/print.hpp"

#include <algorithm>

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;

namespace {

using test::exchange;

// Any even number of data bytes is right.
bool is_loop(bytes pdu) { return pdu.size() >= 3 && pdu[0] == 0x08 && pdu[1] == 0x00 && pdu[2] == 0x00; }

}  // namespace

TEST_CASE("modbus request: bytes -> struct -> bytes")
{
    for (const exchange& row : test::exchanges()) {
        CAPTURE(row.name);
        const auto parsed = parse_request(row.asks);
        REQUIRE(parsed.has_value());
        CHECK(*parsed == row.question);
        CHECK(encode_request(row.question) == row.asks);
        CHECK(static_cast<unsigned>(function_of(row.question)) == row.asks[0]);
    }
}

TEST_CASE("modbus request: a PDU that is too short or too long answers exception 03")
{
    for (const exchange& row : test::exchanges()) {
        CAPTURE(row.name);
        for (std::size_t size = 1; size < row.asks.size(); ++size) {
            CAPTURE(size);
            const bytes shorter = bytes(row.asks).first(size);
            if (is_loop(shorter) && size >= 5 && size % 2 == 1)
                continue;
            const bool mei_type_is_missing = row.asks[0] == 0x2B && size == 1;
            CHECK(parse_request(shorter).error() ==
                  (mei_type_is_missing ? exception_code::illegal_function : exception_code::illegal_data_value));
        }
        buffer longer = row.asks;
        longer.push_back(0x00);
        CHECK(parse_request(longer).error() == exception_code::illegal_data_value);
    }
}

TEST_CASE("modbus request: diagnostics with another sub-function answer 01, with other data 03")
{
    for (unsigned sub = 0; sub < 0x10000; sub += sub < 0x20 ? 1 : 0xFF) {
        CAPTURE(sub);
        const bool known = sub <= 0x04 || (sub >= 0x0A && sub <= 0x12);
        const buffer pdu{0x08, static_cast<std::uint8_t>(sub >> 8), static_cast<std::uint8_t>(sub & 0xFF), 0x12, 0x34};
        const auto parsed = parse_request(pdu);
        if (sub == 0)
            CHECK(parsed.has_value());
        else
            CHECK(parsed.error() == (known ? exception_code::illegal_data_value : exception_code::illegal_function));
    }
}

TEST_CASE("modbus request: device identification of another MEI type answers 01, with another access 03")
{
    for (const std::uint8_t type : buffer{0x00, 0x0D, 0x0F, 0xFF})
        CHECK(parse_request(buffer{0x2B, type, 0x01, 0x00}).error() == exception_code::illegal_function);
    for (const std::uint8_t access : buffer{0x00, 0x05, 0xFF})
        CHECK(parse_request(buffer{0x2B, 0x0E, access, 0x00}).error() == exception_code::illegal_data_value);
}

TEST_CASE("modbus request: bits behind the last coil are not looked at")
{
    const buffer padded{0x0F, 0x00, 0x13, 0x00, 0x0A, 0x02, 0xCD, 0xFD};
    CHECK(*parse_request(padded) == request{write_multiple_coils{address{0x13}, test::bits("10110011 10")}});
}

TEST_CASE("modbus request: an unknown function code answers exception 01, whatever follows")
{
    const std::uint8_t known[] = {0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x07, 0x08,
                                  0x0B, 0x0C, 0x0F, 0x10, 0x11, 0x16, 0x17};
    for (unsigned code = 0; code < 256; ++code) {
        if (std::find(std::begin(known), std::end(known), code) != std::end(known))
            continue;
        CAPTURE(code);
        const auto function_code = static_cast<std::uint8_t>(code);
        CHECK(parse_request(buffer{function_code}).error() == exception_code::illegal_function);
        CHECK(parse_request(buffer{function_code, 0x00, 0x00, 0x00, 0x01}).error() == exception_code::illegal_function);
    }
    CHECK(parse_request({}).error() == exception_code::illegal_function);
}

TEST_SUITE_END();
