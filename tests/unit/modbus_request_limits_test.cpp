#include "protocols/modbus/request.hpp"
#include "protocols/modbus/wire.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;

namespace {

buffer read_pdu(std::uint8_t code, std::uint16_t count)
{
    buffer pdu{code, 0x00, 0x00};
    append_word(pdu, count);
    return pdu;
}

// A write of many: the byte count as the field says it, and as many bytes as really follow.
buffer write_pdu(std::uint8_t code, std::uint16_t count, std::size_t byte_count, std::size_t data)
{
    buffer pdu = read_pdu(code, count);
    pdu.push_back(static_cast<std::uint8_t>(byte_count));
    pdu.resize(pdu.size() + data, 0x55);
    return pdu;
}

buffer read_write_pdu(std::uint16_t read, std::uint16_t write, std::size_t byte_count, std::size_t data)
{
    buffer pdu = read_pdu(0x17, read);
    append_words(pdu, {0, write});
    pdu.push_back(static_cast<std::uint8_t>(byte_count));
    pdu.resize(pdu.size() + data, 0x55);
    return pdu;
}

bool valid(const buffer& pdu)
{
    const auto parsed = parse_request(pdu);
    if (parsed)
        CHECK(encode_request(*parsed).size() == pdu.size());
    else
        CHECK(parsed.error() == exception_code::illegal_data_value);
    return parsed.has_value();
}

}  // namespace

TEST_CASE("modbus request: counts of reads")
{
    struct {
        std::uint8_t code;
        std::uint16_t most;
    } const reads[] = {{0x01, 2000}, {0x02, 2000}, {0x03, 125}, {0x04, 125}};

    for (const auto& [code, most] : reads) {
        CAPTURE(code);
        CHECK_FALSE(valid(read_pdu(code, 0)));
        CHECK(valid(read_pdu(code, 1)));
        CHECK(valid(read_pdu(code, most)));
        CHECK_FALSE(valid(read_pdu(code, static_cast<std::uint16_t>(most + 1))));
        CHECK_FALSE(valid(read_pdu(code, 0xFFFF)));
    }
}

TEST_CASE("modbus request: counts and byte counts of writes")
{
    struct {
        const char* name;
        buffer pdu;
        bool is_valid;
    } const writes[] = {
        {"no coil", write_pdu(0x0F, 0, 0, 0), false},
        {"no coil, but a byte", write_pdu(0x0F, 0, 1, 1), false},
        {"one coil", write_pdu(0x0F, 1, 1, 1), true},
        {"eight coils", write_pdu(0x0F, 8, 1, 1), true},
        {"nine coils", write_pdu(0x0F, 9, 2, 2), true},
        {"nine coils in one byte", write_pdu(0x0F, 9, 1, 1), false},
        {"eight coils in two bytes", write_pdu(0x0F, 8, 2, 2), false},
        {"most coils", write_pdu(0x0F, 1968, 246, 246), true},
        {"one coil too many", write_pdu(0x0F, 1969, 247, 247), false},
        {"2056 coils: the byte count would wrap to 1", write_pdu(0x0F, 2056, 1, 1), false},
        {"no register", write_pdu(0x10, 0, 0, 0), false},
        {"no register, but two bytes", write_pdu(0x10, 0, 2, 2), false},
        {"one register", write_pdu(0x10, 1, 2, 2), true},
        {"one register of one byte", write_pdu(0x10, 1, 1, 1), false},
        {"two registers in two bytes", write_pdu(0x10, 2, 2, 2), false},
        {"byte count right, data short", write_pdu(0x10, 2, 4, 3), false},
        {"byte count right, data long", write_pdu(0x10, 2, 4, 5), false},
        {"data right, byte count wrong", write_pdu(0x10, 2, 2, 4), false},
        {"most registers", write_pdu(0x10, 123, 246, 246), true},
        {"one register too many", write_pdu(0x10, 124, 248, 248), false},
        {"129 registers: the byte count would wrap to 2", write_pdu(0x10, 129, 2, 2), false},
    };
    for (const auto& row : writes) {
        CAPTURE(row.name);
        CHECK(valid(row.pdu) == row.is_valid);
    }
}

TEST_CASE("modbus request: both counts of function 17H")
{
    CHECK_FALSE(valid(read_write_pdu(0, 1, 2, 2)));
    CHECK_FALSE(valid(read_write_pdu(1, 0, 0, 0)));
    CHECK_FALSE(valid(read_write_pdu(1, 0, 2, 2)));
    CHECK(valid(read_write_pdu(1, 1, 2, 2)));
    CHECK(valid(read_write_pdu(125, 121, 242, 242)));
    CHECK_FALSE(valid(read_write_pdu(126, 121, 242, 242)));
    CHECK_FALSE(valid(read_write_pdu(125, 122, 244, 244)));
    CHECK_FALSE(valid(read_write_pdu(1, 2, 2, 4)));
    CHECK_FALSE(valid(read_write_pdu(1, 2, 4, 3)));
}

TEST_CASE("modbus request: a coil is FF00 or 0000")
{
    for (unsigned value = 0; value <= 0xFFFF; ++value) {
        const bool is_coil_value = value == 0x0000 || value == 0xFF00;
        const auto parsed = parse_request(read_pdu(0x05, static_cast<std::uint16_t>(value)));
        REQUIRE_MESSAGE(parsed.has_value() == is_coil_value, value);
    }
}

TEST_CASE("modbus request: the longest requests fit into a PDU")
{
    CHECK(write_pdu(0x0F, 1968, 246, 246).size() <= max_pdu_size);
    CHECK(write_pdu(0x10, 123, 246, 246).size() <= max_pdu_size);
    CHECK(read_write_pdu(125, 121, 242, 242).size() <= max_pdu_size);
}

TEST_SUITE_END();
