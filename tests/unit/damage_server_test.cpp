// Requests that are cut, doubled, one byte short or changed by one bit on their way to a server, RTU and ASCII: never
// carried out, never answered, and counted as FX3 manual 6.4, 9.5 and 12.6 say.
#include "tests/support/damage.hpp"
#include "tests/support/frames.hpp"
#include "tests/unit/server_line.hpp"

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using namespace plcgw::test;

namespace {

using modbus::framing;
using modbus::unit_id;

constexpr unit_id us = server_line::us;
constexpr std::uint16_t crc_or_lrc = 205;
constexpr std::uint16_t no_hex_digit = 208;

const aftermath nothing{{}, std::vector<std::uint16_t>(9), {event::restarted}, 0, false};

// 6.4: communication errors count, and nothing else does. 9.5.2: a receive event with bit 1 for each.
aftermath lost(std::uint16_t error, std::uint16_t times = 1)
{
    aftermath after = nothing;
    after.counters[1] = times;
    after.log.insert(after.log.begin(), times, event::received | event::damaged);
    after.error = error;
    return after;
}

// Thousands of comparisons, one check: the first that failed is shown.
class comparisons {
public:
    void compare(const aftermath& got, const aftermath& expected, const exchange& row, const char* harm, std::size_t at)
    {
        ++made_;
        if (got == expected || failures_++ > 0)
            return;
        CAPTURE(row.name);
        CAPTURE(harm);
        CAPTURE(at);
        CHECK(got.replies.size() == expected.replies.size());
        CHECK(got.counters == expected.counters);
        CHECK(got.log == expected.log);
        CHECK(got.error == expected.error);
        CHECK(got.acted == expected.acted);
        if (!got.replies.empty() && !expected.replies.empty())
            CHECK(got.replies.front() == expected.replies.front());
    }

    void check(std::size_t at_least) const
    {
        CHECK(failures_ == 0);
        CHECK(made_ >= at_least);
    }

private:
    std::size_t made_ = 0;
    std::size_t failures_ = 0;
};

// Nobody but silence ends it: glued to another it is another frame.
bool is_long_loop(const exchange& each) { return each.asks[0] == 0x08 && each.asks.size() > 5; }

// A CRC that ends with 00 fits without it, too: for whoever goes by the CRC it is then a whole frame.
bool fits_without_last_byte(const buffer& rtu) { return rtu.back() == 0; }

bool is_hex(std::uint8_t c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'F') || (c >= 'a' && c <= 'f'); }

// What one changed character does to an ASCII frame.
aftermath after_change(const buffer& adu, std::size_t at, std::uint8_t character, const aftermath& executed)
{
    if (at == 0)
        return nothing;  // without ':' there is no frame
    const bool is_digit = at < adu.size() - 2;
    if (is_digit && character == ':')
        return lost(crc_or_lrc, 2);  // the frame breaks off, and what follows is another with a wrong LRC
    if (!is_digit || !is_hex(character))
        return lost(no_hex_digit);
    return (character ^ adu[at]) == 0x20 ? executed : lost(crc_or_lrc);  // a small letter is the same digit
}

}  // namespace

TEST_CASE("damage, RTU server: of a request with any bit flipped, or one byte short, nothing is taken")
{
    server_line line(framing::rtu);
    comparisons all;
    for (const exchange& each : exchanges()) {
        const buffer adu = rtu_frame(us, each.asks);
        CHECK_FALSE(fits_without_last_byte(adu));  // see below
        for (std::size_t bit = 0; bit < 8 * adu.size(); ++bit)
            all.compare(line.hear_all(with_bit_flipped(adu, bit)), lost(crc_or_lrc), each, "bit flipped", bit);
        for (std::size_t missing = 0; missing < adu.size(); ++missing)
            all.compare(line.hear_all(without_byte(adu, missing)), lost(crc_or_lrc), each, "byte missing", missing);
    }
    all.check(2'500);
}

TEST_CASE("damage, RTU server: a request may come in parts, but silence between them makes two damaged frames")
{
    server_line line(framing::rtu);
    comparisons all;
    for (const exchange& each : exchanges()) {
        const buffer adu = rtu_frame(us, each.asks);
        const aftermath executed = line.executed(each.asks, 1);
        for (std::size_t cut = 1; cut < adu.size(); ++cut) {
            const bytes first = bytes(adu).first(cut);
            const bytes second = bytes(adu).subspan(cut);
            all.compare(line.hear_all(pieces{first, second}), executed, each, "cut", cut);
            all.compare(line.hear_all(first), lost(crc_or_lrc), each, "cut off", cut);
            line.hear(second);
            line.be_silent();
            all.compare(line.so_far(), lost(crc_or_lrc, 2), each, "silence inside", cut);
        }
    }
    all.check(700);
}

TEST_CASE("damage, RTU server: a request that comes twice is carried out and answered twice")
{
    server_line line(framing::rtu);
    comparisons all;
    for (const exchange& each : exchanges()) {
        const buffer adu = rtu_frame(us, each.asks);
        const aftermath executed = line.executed(each.asks, 2);
        if (!is_long_loop(each))
            all.compare(line.hear_all(twice(adu)), executed, each, "glued", 0);
        line.hear_all(adu);
        line.hear(adu);
        line.be_silent();
        all.compare(line.so_far(), executed, each, "separate", 0);
    }
    all.check(70);
}

TEST_CASE("damage, RTU server: a neighbour's damaged response is a communication error, not a request")
{
    server_line line(framing::rtu);
    comparisons all;
    for (const exchange& each : exchanges()) {
        if (each.answers.empty() || is_long_loop(each))
            continue;
        const buffer request = rtu_frame(unit_id{5}, each.asks);
        const buffer adu = rtu_frame(unit_id{5}, each.answers);
        aftermath expected = lost(crc_or_lrc);
        expected.counters[0] = 1;  // the request
        for (std::size_t bit = 0; bit < 8 * adu.size(); ++bit)
            all.compare(line.hear_all(pieces{request, with_bit_flipped(adu, bit)}), expected, each, "bit flipped", bit);
        for (std::size_t size = 1; size < adu.size() - (fits_without_last_byte(adu) ? 1 : 0); ++size)
            all.compare(line.hear_all(pieces{request, bytes(adu).first(size)}), expected, each, "cut off", size);
    }
    all.check(3'000);
}

TEST_CASE("damage, RTU server: where the CRC fits without the last byte, the request has the wrong length")
{
    server_line line(framing::rtu);
    unsigned found = 0;
    for (unsigned value = 0; value < 0x400; ++value) {
        const buffer pdu{0x06, 0x00, 0x01, static_cast<std::uint8_t>(value >> 8),
                         static_cast<std::uint8_t>(value & 0xFF)};
        const buffer adu = rtu_frame(us, pdu);
        if (!fits_without_last_byte(adu))
            continue;
        ++found;
        const aftermath got = line.hear_all(bytes(adu).first(adu.size() - 1));
        CHECK(got.replies == std::vector<buffer>{{0x86, 0x03}});
        CHECK(got.error == 207);
        CHECK_FALSE(got.acted);
        CHECK(line.hear_all(adu) == line.executed(pdu, 1));
    }
    CHECK(found > 0);
}

TEST_CASE("damage, ASCII server: with any bit flipped nothing is taken, but for a letter made small")
{
    server_line line(framing::ascii);
    comparisons all;
    for (const exchange& each : exchanges()) {
        const buffer adu = ascii_frame(us, each.asks);
        const aftermath executed = line.executed(each.asks, 1);
        for (std::size_t bit = 0; bit < 8 * adu.size(); ++bit) {
            const buffer flipped = with_bit_flipped(adu, bit);
            const aftermath expected = after_change(adu, bit / 8, flipped[bit / 8], executed);
            all.compare(line.hear_all(flipped), expected, each, "bit flipped", bit);
        }
    }
    all.check(5'000);
}

TEST_CASE("damage, ASCII server: one character short, nothing is taken")
{
    server_line line(framing::ascii);
    comparisons all;
    for (const exchange& each : exchanges()) {
        const buffer adu = ascii_frame(us, each.asks);
        for (std::size_t missing = 0; missing < adu.size(); ++missing) {
            const bool carriage_return = missing + 2 == adu.size();
            const aftermath expected = missing == 0 ? nothing : lost(carriage_return ? no_hex_digit : crc_or_lrc);
            all.compare(line.hear_all(without_byte(adu, missing)), expected, each, "character missing", missing);
        }
    }
    all.check(600);
}

TEST_CASE("damage, ASCII server: a request may come in parts, but a second of silence ends it")
{
    server_line line(framing::ascii);
    comparisons all;
    for (const exchange& each : exchanges()) {
        const buffer adu = ascii_frame(us, each.asks);
        const aftermath executed = line.executed(each.asks, 1);
        for (std::size_t cut = 1; cut < adu.size(); ++cut) {
            const bytes first = bytes(adu).first(cut);
            const bytes second = bytes(adu).subspan(cut);
            all.compare(line.hear_all(pieces{first, second}), executed, each, "cut", cut);
            all.compare(line.hear_all(first), lost(crc_or_lrc), each, "cut off", cut);
            line.hear(second);
            line.be_silent();
            all.compare(line.so_far(), lost(crc_or_lrc), each, "silence inside", cut);  // the rest has no ':'
        }
    }
    all.check(1'800);
}

TEST_CASE("damage, ASCII server: a request that comes twice is carried out and answered twice")
{
    server_line line(framing::ascii);
    comparisons all;
    for (const exchange& each : exchanges()) {
        const buffer adu = ascii_frame(us, each.asks);
        aftermath expected = line.executed(each.asks, 2);
        if (each.question ==
            modbus::request{modbus::diagnostics{modbus::diagnostic::change_ascii_delimiter, {'$', 0}}}) {
            // The second one ends with what is no delimiter any more (7.11.4).
            expected = line.executed(each.asks, 1);
            expected.counters[1] = 1;
            expected.log.insert(expected.log.begin(), event::received | event::damaged);
            expected.error = no_hex_digit;
        }
        all.compare(line.hear_all(twice(adu)), expected, each, "glued", 0);
    }
    all.check(30);
}

TEST_CASE("damage, server: too short is a communication error, too long a character overrun (6.4, 12.6)")
{
    aftermath overrun = nothing;
    overrun.counters[7] = 1;
    overrun.log.insert(overrun.log.begin(), event::received | event::overrun);
    overrun.error = 206;

    server_line rtu(framing::rtu);
    CHECK(rtu.hear_all(buffer{1, 7, 0}) == lost(crc_or_lrc));
    CHECK(rtu.hear_all(rtu_frame(us, buffer(254, 0x55))) == overrun);  // 257 bytes

    server_line ascii(framing::ascii);
    CHECK(ascii.hear_all(buffer{':', '0', '1', 'F', 'F', '0', '\r', '\n'}) == lost(crc_or_lrc));
    CHECK(ascii.hear_all(ascii_frame(us, buffer(254, 0x55))) == overrun);  // 515 characters
}

TEST_SUITE_END();
