#include "protocols/modbus/ascii.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

static_assert(framer<ascii_framer>);

buffer text(std::string_view of) { return buffer(of.begin(), of.end()); }

struct row {
    const char* name;
    std::string_view adu;
    frame content;
};

// clang-format off
const row rows[] = {
    {"the LRC example of FX3 manual 7.2.1", ":020100000008F5\r\n", {unit_id{2}, {0x01, 0, 0, 0, 8}}},
    {"the shortest frame", ":0207F7\r\n", {unit_id{2}, {0x07}}},
    {"every digit", ":0123456789ABCDEF40\r\n", {unit_id{1}, {0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF}}},
    {"an LRC of zero", ":800600000000007A\r\n", {unit_id{0x80}, {0x06, 0, 0, 0, 0, 0}}},
    {"a broadcast", ":00050001FF00FB\r\n", {unit_id::broadcast, {0x05, 0x00, 0x01, 0xFF, 0x00}}},
};
// clang-format on

struct outcome {
    std::vector<frame> frames;
    std::vector<errc> errors;
};

// All that comes out, with a silence behind.
outcome receive(const pieces& received, std::uint8_t delimiter = ascii_delimiter)
{
    outcome all;
    ascii_framer in(delimiter);
    time_point now = t0;
    const auto ask = [&] {
        while (auto each = in.next(now))
            if (*each)
                all.frames.push_back(**each);
            else
                all.errors.push_back(static_cast<errc>(each->error().value()));
    };
    for (const bytes piece : received) {
        in.feed(now, piece);
        ask();
        now += 999ms;
    }
    now += 1s;
    ask();
    return all;
}

outcome receive(bytes received, std::uint8_t delimiter = ascii_delimiter)
{
    return receive(pieces{received}, delimiter);
}

const row& example = rows[0];

}  // namespace

TEST_CASE("ascii: frames as they stand on the line, in capital letters")
{
    for (const row& each : rows) {
        CAPTURE(each.name);
        CHECK(encode_ascii(each.content) == text(each.adu));
    }
    CHECK(encode_ascii(example.content, 0x24) == text(":020100000008F5\r$"));
    CHECK(lrc(buffer{0x02, 0x01, 0, 0, 0, 0x08}) == 0xF5);
}

TEST_CASE("ascii: frames are read at every cut, in both cases")
{
    for (const row& each : rows) {
        CAPTURE(each.name);
        every_cut(text(each.adu), [&](const pieces& cut) {
            const outcome got = receive(cut);
            CHECK(got.frames == std::vector{each.content});
            CHECK(got.errors.empty());
        });
    }
    CHECK(receive(text(":0123456789abcdef40\r\n")).frames == std::vector{rows[2].content});
    CHECK(receive(text(":0123456789aBCdEf40\r\n")).frames == std::vector{rows[2].content});
}

TEST_CASE("ascii: what is not between ':' and the delimiter is nobody's")
{
    const outcome got = receive(text("\r\nOK 12\n:0207F7\r\n\n\r99:020100000008F5\r\n7"));
    CHECK(got.frames == std::vector{rows[1].content, rows[0].content});
    CHECK(got.errors.empty());
}

TEST_CASE("ascii: doubled, it comes twice; one character short, never")
{
    const buffer adu = text(example.adu);
    buffer twice = adu;
    twice.insert(twice.end(), adu.begin(), adu.end());
    CHECK(receive(twice).frames == std::vector(2, example.content));

    for (std::size_t missing = 0; missing < adu.size(); ++missing) {
        buffer shorter = adu;
        shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(missing));
        const outcome got = receive(shorter);
        CHECK(got.frames.empty());
        CHECK(got.errors.size() == (missing == 0 ? 0 : 1));  // without ':' there was no frame
    }
}

TEST_CASE("ascii: with one bit flipped, a frame is lost or the letter was only made small")
{
    for (const row& each : rows) {
        CAPTURE(each.name);
        for (std::size_t bit = 0; bit < 8 * each.adu.size(); ++bit) {
            buffer flipped = text(each.adu);
            flipped[bit / 8] = static_cast<std::uint8_t>(flipped[bit / 8] ^ 1U << (bit % 8));
            const bool small = bit % 8 == 5 && flipped[bit / 8] >= 'a' && flipped[bit / 8] <= 'f';
            CHECK(receive(flipped).frames == (small ? std::vector{each.content} : std::vector<frame>{}));
        }
    }
}

TEST_CASE("ascii: why a frame was lost, said once (FX3 errors 205, 206 and 208)")
{
    const struct {
        const char* name;
        std::string adu;
        errc why;
    } losses[] = {
        {"wrong LRC", ":020100000008F6\r\n", errc::bad_checksum},
        {"half a byte more", ":020100000008F50\r\n", errc::bad_checksum},
        {"eight characters", ":0207F\r\n", errc::too_short},
        {"three characters", ":\r\n", errc::too_short},
        {"a character that is no digit", ":02010000G008F5\r\n", errc::bad_character},
        {"two such characters", ":0201xx000008F5\r\n", errc::bad_character},
        {"the delimiter without CR", ":020100000008F5\n", errc::bad_character},
        {"another delimiter behind CR", ":020100000008F5\r$", errc::bad_character},
        {"nothing behind CR", ":020100000008F5\r", errc::incomplete},
        {"nothing behind ':'", ":", errc::incomplete},
    };
    for (const auto& each : losses) {
        CAPTURE(each.name);
        every_cut(text(each.adu), [&](const pieces& cut) {
            const outcome got = receive(cut);
            CHECK(got.frames.empty());
            CHECK(got.errors == std::vector{each.why});
        });
        const outcome next = receive(text(each.adu + std::string(example.adu)));
        CHECK(next.frames == std::vector{example.content});  // ':' begins anew
        CHECK(next.errors == std::vector{each.why});
    }
}

TEST_CASE("ascii: a frame has 513 characters at most")
{
    const frame longest{unit_id{1}, buffer(max_pdu_size, 0x5A)};
    const frame longer{unit_id{1}, buffer(max_pdu_size + 1, 0x5A)};
    CHECK(encode_ascii(longest).size() == max_ascii_size);
    CHECK(receive(encode_ascii(longest)).frames == std::vector{longest});
    CHECK(receive(encode_ascii(longer)).errors == std::vector{errc::overlong});
    CHECK(receive(buffer(encode_ascii(longest).size() + 1, ':')).errors.size() == max_ascii_size + 1);
    buffer endless(5'000, '0');
    endless[0] = ':';
    CHECK(receive(endless).errors == std::vector{errc::overlong});
}

TEST_CASE("ascii: every delimiter from 00 to FF ends a frame, and can be changed while receiving")
{
    for (unsigned each = 0; each <= 0xFF; ++each) {
        const auto delimiter = static_cast<std::uint8_t>(each);
        CAPTURE(each);
        CHECK(receive(encode_ascii(example.content, delimiter), delimiter).frames == std::vector{example.content});
    }

    ascii_framer in;
    buffer both = encode_ascii(example.content);
    const buffer second = encode_ascii(rows[1].content, 0x24);
    both.insert(both.end(), second.begin(), second.end());
    in.feed(t0, both);
    CHECK(in.next(t0)->value() == example.content);
    in.set_delimiters({0x24});  // as the first frame said
    CHECK(in.next(t0)->value() == rows[1].content);
}

TEST_CASE("ascii: a second between two characters ends a frame, not outside of one")
{
    ascii_framer in;
    CHECK(in.deadline() == time_point::max());
    in.feed(t0, text("12"));
    CHECK_FALSE(in.next(t0));
    CHECK(in.deadline() == time_point::max());

    in.feed(t0, text(":0201"));
    CHECK_FALSE(in.next(t0));
    CHECK(in.deadline() == t0 + 1s);
    in.feed(t0 + 900ms, text("00"));
    CHECK_FALSE(in.next(t0 + 900ms));
    CHECK_FALSE(in.next(t0 + 1899ms));
    CHECK(in.next(t0 + 1900ms)->error() == errc::incomplete);
    CHECK_FALSE(in.next(t0 + 3s));
    CHECK(in.deadline() == time_point::max());
    in.feed(t0 + 3s, text(example.adu));
    CHECK(in.next(t0 + 3s)->value() == example.content);
}

TEST_SUITE_END();
