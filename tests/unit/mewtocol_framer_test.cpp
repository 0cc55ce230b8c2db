// What the framer makes of bytes: frames, and for everything else why it was dropped.
#include "protocols/mewtocol/line_framer.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"
#include "tests/unit/mewtocol_fake.hpp"

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol;
using namespace plcgw::test;

namespace {

// Everything that comes out of these pieces, and out of the silence behind them.
std::vector<reception> heard(const pieces& received)
{
    line_framer framer(1s);
    std::vector<reception> all;
    time_point now = t0;
    for (const bytes piece : received) {
        framer.feed(now += 10ms, piece);
        while (auto r = framer.next(now))
            all.push_back(std::move(*r));
    }
    while (auto r = framer.next(now + 1s))
        all.push_back(std::move(*r));
    CHECK(framer.deadline() == time_point::max());
    return all;
}

reception frame_of(const std::string& characters) { return {characters, {}, characters.size() + 1}; }

std::string frame_of_size(char header, std::size_t size)  // CR included
{
    return std::string(1, header) + std::string(size - 2, 'A');
}

struct framer_row {
    const char* name;
    std::string received;
    std::vector<reception> out;
};

// clang-format off
const framer_row rows[] = {
    {"a frame", "%01#RT01\r", {frame_of("%01#RT01")}},
    {"the three headers", "%01#RT01\r<01#RT18\r>@EEE00#30STRD0043F1\r",
        {frame_of("%01#RT01"), frame_of("<01#RT18"), frame_of(">@EEE00#30STRD0043F1")}},
    {"twice the same, in one piece", "%01#RT01\r%01#RT01\r", {frame_of("%01#RT01"), frame_of("%01#RT01")}},
    {"LF behind CR, and empty lines", "%01#RT01\r\n\r\n%01#RT01\r\n", {frame_of("%01#RT01"), frame_of("%01#RT01")}},
    {"noise in front", "\xff\x80#%01#RT01\r", {{"", errc::bad_header, 3}, frame_of("%01#RT01")}},
    {"a line of text", "hello\r%01#RT01\r", {{"", errc::bad_header, 6}, frame_of("%01#RT01")}},
    {"noise, then silence", "garbage", {{"", errc::bad_header, 7}}},
    {"a header in the middle", "%01#RDD0000%01#RT01\r", {{"%01#RDD0", errc::restarted, 11}, frame_of("%01#RT01")}},
    {"another protocol's header in the middle", "%01#RDD0000>@EEE00#30STRD0043F1\r",
        {{"%01#RDD0", errc::restarted, 11}, frame_of(">@EEE00#30STRD0043F1")}},
    {"headers only", "%%%", {{"%", errc::restarted, 1}, {"%", errc::restarted, 1}, {"%", errc::incomplete, 1}}},
    {"no CR", "%01#RT01", {{"%01#RT01", errc::incomplete, 8}}},
    {"a header and CR", "%\r", {frame_of("%")}},
};
// clang-format on

}  // namespace

TEST_CASE("mewtocol framer: frames come out, the rest is reported, cut at every place")
{
    for (const framer_row& row : rows) {
        CAPTURE(row.name);
        every_cut(to_bytes(row.received), [&](const pieces& received) { CHECK(heard(received) == row.out); });
    }
}

TEST_CASE("mewtocol framer: 118, 2048 and 4096 characters are a frame, one more is overlong")
{
    struct {
        char header;
        std::size_t longest;
    } const limits[] = {{'%', 118}, {'<', 2048}, {'>', 4096}};
    for (const auto& row : limits) {
        CAPTURE(row.longest);
        const std::string longest = frame_of_size(row.header, row.longest);
        CHECK(heard({with_cr(longest)}) == std::vector{frame_of(longest)});

        const std::string longer = longest + "A";
        const std::string begin = longer.substr(0, 8);
        const reception overlong{begin, errc::overlong, row.longest + 1};
        CHECK(heard({with_cr(longer)}) == std::vector{overlong});
        const buffer two = with_cr(longer + "\r%01#RT01");
        CHECK(heard({two}) == std::vector{overlong, frame_of("%01#RT01")});

        // Without CR nobody can tell that it is a frame at all.
        CHECK(heard({to_bytes(longer)}) == std::vector{reception{begin, errc::incomplete, row.longest}});
        const buffer restarted = with_cr(longer + "%01#RT01");
        CHECK(heard({restarted})[0] == reception{begin, errc::restarted, row.longest});
    }
}

TEST_CASE("mewtocol framer: silence in the middle drops the frame once")
{
    line_framer framer(1s);
    CHECK(framer.deadline() == time_point::max());
    framer.feed(t0, to_bytes("%01#"));
    CHECK(framer.in_frame());
    CHECK(framer.deadline() == t0 + 1s);
    framer.feed(t0 + 900ms, to_bytes("RT"));
    CHECK(framer.deadline() == t0 + 1900ms);
    CHECK_FALSE(framer.next(t0 + 1900ms - 1us));
    CHECK(framer.next(t0 + 1900ms) == reception{"%01#RT", errc::incomplete, 6});
    CHECK_FALSE(framer.next(t0 + 5s));
    CHECK_FALSE(framer.in_frame());

    framer.feed(t0 + 5s, to_bytes("01\r"));  // its end comes too late
    CHECK(framer.next(t0 + 5s) == reception{"", errc::bad_header, 3});
}

TEST_CASE("mewtocol framer: bytes that waited in the driver came in time")
{
    line_framer framer(1s);
    framer.feed(t0, to_bytes("%01#RT"));
    framer.feed(t0 + 10s, to_bytes("01\r"));
    CHECK(framer.next(t0 + 10s) == frame_of("%01#RT01"));
}

TEST_CASE("mewtocol framer: endless noise takes no memory and ends with the next header")
{
    line_framer framer(1s);
    const buffer noise(10'000, 'x');
    for (int i = 0; i < 100; ++i) {
        framer.feed(t0, noise);
        CHECK_FALSE(framer.next(t0));
    }
    framer.feed(t0, with_cr("%01#RT01"));
    CHECK(framer.next(t0) == reception{"", errc::bad_header, 1'000'000});
    CHECK(framer.next(t0) == frame_of("%01#RT01"));
}

TEST_SUITE_END();
