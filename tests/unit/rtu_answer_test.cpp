#include "protocols/modbus/rtu.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;
using plcgw::test::every_cut;
using plcgw::test::pieces;

namespace {

struct answer_row {
    const char* name;
    unit_id unit;
    request question;
    buffer adu;  // of the answer
    response answer;
};

// clang-format off
const answer_row rows[] = {
    {"holding registers", unit_id{0x11}, read_table{table::holding_registers, address{0x6B}, 3},
        {0x11, 0x03, 0x06, 0xAE, 0x41, 0x56, 0x52, 0x43, 0x40, 0x49, 0xAD}, registers_read{{0xAE41, 0x5652, 0x4340}}},
    {"a refused read of coils", unit_id{0x0A}, read_table{table::coils, address{0x04A1}, 1},
        {0x0A, 0x81, 0x02, 0xB0, 0x53}, exception_code::illegal_data_address},
    {"a written register", unit_id{0x11}, write_single_register{address{1}, 3},
        {0x11, 0x06, 0x00, 0x01, 0x00, 0x03, 0x9A, 0x9B}, written{}},
};
// clang-format on

const answer_row& registers = rows[0];

// What comes out with the last piece; nothing must come out before.
std::optional<response> answer_in(const answer_row& row, const pieces& received)
{
    rtu_answer collected(row.unit, row.question);
    for (std::size_t i = 0; i + 1 < received.size(); ++i)
        CHECK_FALSE(collected.feed(received[i]));
    return collected.feed(received.back());
}

errc failure_of(const answer_row& row, bytes received)
{
    rtu_answer collected(row.unit, row.question);
    CHECK_FALSE(collected.feed(received));
    return collected.fault().why;
}

buffer flipped(buffer adu, std::size_t bit)
{
    adu[bit / 8] = static_cast<std::uint8_t>(adu[bit / 8] ^ 1U << (bit % 8));
    return adu;
}

}  // namespace

TEST_CASE("rtu: frames as they stand on the line")
{
    CHECK(encode_rtu({unit_id{2}, {0x07}}) == buffer{0x02, 0x07, 0x41, 0x12});
    CHECK(encode_rtu({unit_id{0x2A}, {0x03, 0x00, 0x10, 0x00, 0x03}}) ==
          buffer{0x2A, 0x03, 0x00, 0x10, 0x00, 0x03, 0x02, 0x15});
    CHECK(encode_rtu({unit_id{1}, buffer(max_pdu_size)}).size() == max_rtu_size);
}

TEST_CASE("rtu answer: whole at once, at every cut and byte by byte")
{
    for (const answer_row& row : rows) {
        CAPTURE(row.name);
        every_cut(row.adu, [&](const pieces& received) { CHECK(answer_in(row, received) == row.answer); });
    }
}

TEST_CASE("rtu answer: noise before it is skipped, at every cut")
{
    struct {
        const char* name;
        buffer bytes_before;
    } const noises[] = {
        {"00 of a transceiver", {0x00}},
        {"FF of a transceiver", {0xFF}},
        {"several", {0x00, 0xFF, 0xFF, 0x00}},
        {"the unit's own number", {0x11}},
        {"unit and function", {0x11, 0x03}},
        {"unit, function and byte count", {0x11, 0x03, 0x06}},
        {"a stale answer of another unit", encode_rtu({unit_id{0x12}, {0x03, 0x06, 1, 2, 3, 4, 5, 6}})},
        {"a stale answer of this unit to another function",
         encode_rtu({unit_id{0x11}, {0x04, 0x06, 1, 2, 3, 4, 5, 6}})},
        {"a stale, shorter answer of this unit", encode_rtu({unit_id{0x11}, {0x03, 0x02, 1, 2}})},
        {"our own request, echoed by a two-wire line", encode_rtu({unit_id{0x11}, {0x03, 0x00, 0x6B, 0x00, 0x03}})},
        {"the front of a longer frame", {0x11, 0x03, 0x06, 0xAE, 0x41, 0x56}},
    };
    for (const auto& row : noises) {
        CAPTURE(row.name);
        buffer received = row.bytes_before;
        received.insert(received.end(), registers.adu.begin(), registers.adu.end());
        every_cut(received, [&](const pieces& cut) { CHECK(answer_in(registers, cut) == registers.answer); });
    }
}

TEST_CASE("rtu answer: another unit's valid frame is no answer")
{
    const buffer stranger = encode_rtu({unit_id{0x12}, {0x03, 0x06, 0xAE, 0x41, 0x56, 0x52, 0x43, 0x40}});
    CHECK(failure_of(registers, stranger) == errc::unexpected_answer);
    CHECK(failure_of(registers, encode_rtu({unit_id{0x11}, {0x03, 0x02, 0x12, 0x34}})) == errc::unexpected_answer);
    CHECK(failure_of(registers, encode_rtu({unit_id{0x11}, {0x84, 0x02}})) == errc::unexpected_answer);
}

TEST_CASE("rtu answer: with one or two bits flipped it is never accepted")
{
    for (const answer_row& row : rows) {
        CAPTURE(row.name);
        for (std::size_t first = 0; first < 8 * row.adu.size(); ++first) {
            const errc why = failure_of(row, flipped(row.adu, first));
            CHECK((why == errc::bad_checksum || why == errc::incomplete));  // incomplete: 81 became 01
            for (std::size_t second = first + 1; second < 8 * row.adu.size(); ++second) {
                rtu_answer collected(row.unit, row.question);
                REQUIRE_FALSE(collected.feed(flipped(flipped(row.adu, first), second)));
            }
        }
    }
}

TEST_CASE("rtu answer: why there was none")
{
    CHECK(failure_of(registers, {}) == errc::timed_out);
    for (std::size_t size = 1; size < registers.adu.size(); ++size)
        CHECK(failure_of(registers, bytes(registers.adu).first(size)) == errc::incomplete);
    CHECK(failure_of(registers, buffer(20, 0x55)) == errc::bad_checksum);
    CHECK(failure_of(registers, buffer(256, 0x55)) == errc::bad_checksum);
    CHECK(failure_of(registers, buffer(257, 0x55)) == errc::overlong);
}

TEST_CASE("rtu answer: a line that babbles does not fill the memory nor hide the answer")
{
    for (const buffer& babble : {buffer{0xFF}, buffer{0x11, 0x03}, buffer{0x11, 0x83, 0x00}}) {
        rtu_answer collected(registers.unit, registers.question);
        for (int i = 0; i < 5'000; ++i)
            REQUIRE_FALSE(collected.feed(babble));
        CHECK(collected.feed(registers.adu) == registers.answer);
    }
}

TEST_SUITE_END();
