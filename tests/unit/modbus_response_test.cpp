#include "protocols/modbus/response.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;

namespace {

struct response_row {
    const char* name;
    request question;
    response answer;
    buffer pdu;
};

std::vector<bool> bits(std::string_view lowest_first)
{
    std::vector<bool> values;
    for (const char c : lowest_first)
        if (c != ' ')
            values.push_back(c == '1');
    return values;
}

// The examples of V1.1b3 chapter 6, and the largest answers.
// clang-format off
const response_row rows[] = {
    {"6.1 coils 20 to 38", read_table{table::coils, address{0x13}, 19},
        bits_read{bits("10110011 11010110 101")}, {0x01, 0x03, 0xCD, 0x6B, 0x05}},
    {"6.2 discrete inputs 197 to 218", read_table{table::discrete_inputs, address{0xC4}, 22},
        bits_read{bits("00110101 11011011 101011")}, {0x02, 0x03, 0xAC, 0xDB, 0x35}},
    {"6.3 holding registers 108 to 110", read_table{table::holding_registers, address{0x6B}, 3},
        registers_read{{0x022B, 0x0000, 0x0064}}, {0x03, 0x06, 0x02, 0x2B, 0x00, 0x00, 0x00, 0x64}},
    {"6.4 input register 9", read_table{table::input_registers, address{8}, 1},
        registers_read{{0x000A}}, {0x04, 0x02, 0x00, 0x0A}},
    {"6.5 coil 173 on", write_single_coil{address{0xAC}, true},
        written{}, {0x05, 0x00, 0xAC, 0xFF, 0x00}},
    {"6.6 register 2", write_single_register{address{1}, 3},
        written{}, {0x06, 0x00, 0x01, 0x00, 0x03}},
    {"6.11 coils 20 to 29", write_multiple_coils{address{0x13}, bits("10110011 10")},
        written{}, {0x0F, 0x00, 0x13, 0x00, 0x0A}},
    {"6.12 registers 2 and 3", write_multiple_registers{address{1}, {0x000A, 0x0102}},
        written{}, {0x10, 0x00, 0x01, 0x00, 0x02}},
    {"6.16 register 5", mask_write_register{address{4}, 0x00F2, 0x0025},
        written{}, {0x16, 0x00, 0x04, 0x00, 0xF2, 0x00, 0x25}},
    {"6.17 registers 4 to 9", read_write_multiple_registers{address{3}, 6, address{0x0E}, {0xFF, 0xFF, 0xFF}},
        registers_read{{0x00FE, 0x0ACD, 0x0001, 0x0003, 0x000D, 0x00FF}},
        {0x17, 0x0C, 0x00, 0xFE, 0x0A, 0xCD, 0x00, 0x01, 0x00, 0x03, 0x00, 0x0D, 0x00, 0xFF}},
};
// clang-format on

void check_unexpected(const request& question, bytes pdu)
{
    const auto answer = parse_response(question, pdu);
    REQUIRE(answer.has_error());
    CHECK(answer.error() == errc::unexpected_answer);
}

}  // namespace

TEST_CASE("modbus response: each question with its answer, both ways")
{
    for (const response_row& row : rows) {
        CAPTURE(row.name);
        CHECK(encode_response(row.question, row.answer) == row.pdu);
        CHECK(response_size(row.question, row.pdu) == row.pdu.size());
        const auto parsed = parse_response(row.question, row.pdu);
        REQUIRE(parsed.has_value());
        CHECK(*parsed == row.answer);
    }
}

TEST_CASE("modbus response: an answer of the wrong length does not fit")
{
    for (const response_row& row : rows) {
        CAPTURE(row.name);
        for (std::size_t size = 0; size < row.pdu.size(); ++size)
            check_unexpected(row.question, bytes(row.pdu).first(size));
        buffer longer = row.pdu;
        longer.push_back(0x00);
        check_unexpected(row.question, longer);
    }
}

TEST_CASE("modbus response: function code and byte count or echo must fit the question, bit by bit")
{
    for (const response_row& row : rows) {
        CAPTURE(row.name);
        const bool echo = row.answer == response{written{}};
        const std::size_t judged = echo ? row.pdu.size() : 2;  // what is read can be anything
        for (std::size_t bit = 0; bit < 8 * judged; ++bit) {
            CAPTURE(bit);
            buffer wrong = row.pdu;
            wrong[bit / 8] = static_cast<std::uint8_t>(wrong[bit / 8] ^ 1U << (bit % 8));
            check_unexpected(row.question, wrong);
        }
    }
}

TEST_CASE("modbus response: an exception is an answer, to each function its own")
{
    for (const response_row& row : rows) {
        CAPTURE(row.name);
        const auto refused = exception_code::illegal_data_address;
        const buffer pdu{static_cast<std::uint8_t>(row.pdu[0] | 0x80), 0x02};
        CHECK(encode_response(row.question, refused) == pdu);
        CHECK(encode_exception(row.pdu[0], refused) == pdu);
        CHECK(*parse_response(row.question, pdu) == response{refused});

        check_unexpected(row.question, buffer{static_cast<std::uint8_t>(pdu[0] ^ 0x08), 0x02});  // another function's
        check_unexpected(row.question, bytes(pdu).first(1));
        check_unexpected(row.question, buffer{pdu[0], 0x02, 0x00});
    }
    CHECK(encode_exception(0x2B, exception_code::illegal_function) == buffer{0xAB, 0x01});
}

TEST_CASE("modbus response: bits behind the last one asked for are dropped")
{
    const request question = read_table{table::coils, address{0}, 3};
    CHECK(*parse_response(question, buffer{0x01, 0x01, 0xFD}) == response{bits_read{bits("101")}});
}

TEST_CASE("modbus response: the largest answers fit into a PDU")
{
    const request most_bits = read_table{table::coils, address{0}, max_read_bits};
    const request most_registers = read_table{table::input_registers, address{0}, max_read_registers};
    CHECK(response_size(most_bits, {}) == 252);
    CHECK(response_size(most_registers, {}) == 252);

    const response all_on = bits_read{std::vector<bool>(max_read_bits, true)};
    const response all_set = registers_read{std::vector<std::uint16_t>(max_read_registers, 0xFFFF)};
    CHECK(*parse_response(most_bits, encode_response(most_bits, all_on)) == all_on);
    CHECK(*parse_response(most_registers, encode_response(most_registers, all_set)) == all_set);
}

TEST_SUITE_END();
