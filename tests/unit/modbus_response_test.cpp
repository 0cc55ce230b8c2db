#include "tests/support/damage.hpp"
#include "tests/support/frames.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;

namespace {

using test::bits;
using test::exchange;

// Those that the server answers.
std::vector<exchange> answered()
{
    std::vector<exchange> rows = test::exchanges();
    std::erase_if(rows, [](const exchange& each) { return each.answers.empty(); });
    return rows;
}

// How many leading bytes of a response the question decides. The others are what was read, and can be anything.
std::size_t told_by_question(const exchange& row)
{
    if (row.answer == response{written{}})
        return row.answers.size();
    switch (static_cast<function>(row.answers[0])) {
    case function::read_exception_status:
    case function::get_comm_event_counter: return 1;
    case function::encapsulated_interface: return 3;  // function, MEI type, access
    case function::diagnostics: break;
    default: return 2;  // function, byte count
    }
    const diagnostic sub{row.answers[2]};
    const bool echoes = sub <= diagnostic::clear_counters && sub != diagnostic::return_diagnostic_register;
    return echoes ? row.answers.size() : 3;
}

void check_unexpected(const request& question, bytes pdu)
{
    const auto answer = parse_response(question, pdu);
    REQUIRE(answer.has_error());
    CHECK(answer.error() == errc::unexpected_answer);
}

}  // namespace

TEST_CASE("modbus response: a server that stays silent sends no PDU")
{
    for (const exchange& row : test::exchanges())
        CHECK(row.answers.empty() == (row.answer == response{no_response{}}));
    const diagnostics listen_only{diagnostic::force_listen_only, {0x00, 0x00}};
    CHECK(encode_response(listen_only, no_response{}).empty());
    CHECK_FALSE(expects_answer(unit_id{1}, listen_only));
}

TEST_CASE("modbus response: each question with its answer, both ways")
{
    for (const exchange& row : answered()) {
        CAPTURE(row.name);
        CHECK(encode_response(row.question, row.answer) == row.answers);
        CHECK(response_size(row.question, row.answers) == row.answers.size());
        const auto parsed = parse_response(row.question, row.answers);
        REQUIRE(parsed.has_value());
        CHECK(*parsed == row.answer);
    }
}

TEST_CASE("modbus response: an answer of the wrong length does not fit")
{
    for (const exchange& row : answered()) {
        CAPTURE(row.name);
        for (std::size_t size = 0; size < row.answers.size(); ++size)
            check_unexpected(row.question, bytes(row.answers).first(size));
        buffer longer = row.answers;
        longer.push_back(0x00);
        check_unexpected(row.question, longer);
    }
}

TEST_CASE("modbus response: function code and byte count or echo must fit the question, bit by bit")
{
    for (const exchange& row : answered()) {
        CAPTURE(row.name);
        for (std::size_t bit = 0; bit < 8 * told_by_question(row); ++bit) {
            CAPTURE(bit);
            const buffer wrong = test::with_bit_flipped(row.answers, bit);
            const bool is_exception = wrong.size() == exception_size && bit == 7;  // by chance
            if (!is_exception)
                check_unexpected(row.question, wrong);
        }
    }
}

TEST_CASE("modbus response: an exception is an answer, to each function its own")
{
    for (const exchange& row : test::exchanges())
        for (const test::exception_row& refused : test::exceptions) {
            CAPTURE(row.name);
            CAPTURE(refused.byte);
            const buffer pdu{static_cast<std::uint8_t>(row.asks[0] | 0x80), refused.byte};
            CHECK(encode_response(row.question, refused.code) == pdu);
            CHECK(encode_exception(row.asks[0], refused.code) == pdu);
            CHECK(*parse_response(row.question, pdu) == response{refused.code});

            check_unexpected(row.question, buffer{static_cast<std::uint8_t>(pdu[0] ^ 0x08), refused.byte});
            check_unexpected(row.question, bytes(pdu).first(1));
            check_unexpected(row.question, buffer{pdu[0], refused.byte, 0x00});
        }
    CHECK(encode_exception(0x41, exception_code::illegal_function) == buffer{0xC1, 0x01});
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
