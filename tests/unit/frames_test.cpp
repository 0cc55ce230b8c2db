// Every request, response and exception in RTU, ASCII and MODBUS TCP: written as the specifications say, and read at
// every cut.
#include "protocols/modbus/ascii.hpp"
#include "protocols/modbus/mbap.hpp"
#include "protocols/modbus/rtu.hpp"
#include "protocols/modbus/rtu_bus.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/support/frames.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

constexpr unit_id us{0x11};

struct pdu_row {
    std::string name;
    buffer pdu;
};

std::vector<pdu_row> all_pdus()
{
    std::vector<pdu_row> all;
    for (const exchange& each : exchanges()) {
        all.push_back({each.name, each.asks});
        if (!each.answers.empty())
            all.push_back({std::string(each.name) + ", answer", each.answers});
        for (const exception_row& refused : exceptions)
            all.push_back({std::string(each.name) + ", exception",
                           {static_cast<std::uint8_t>(each.asks[0] | 0x80), refused.byte}});
    }
    return all;
}

// All that a framer with a clock makes of these pieces.
std::vector<frame> ascii_frames(const pieces& received)
{
    std::vector<frame> all;
    ascii_framer in;
    for (const bytes piece : received) {
        in.feed(t0, piece);
        while (const auto each = in.next(t0))
            all.push_back(each->value());
    }
    return all;
}

std::vector<tcp_frame> tcp_frames(const pieces& received)
{
    std::vector<tcp_frame> all;
    mbap_framer in;
    for (const bytes piece : received) {
        in.feed(piece);
        while (const auto each = in.next())
            all.push_back(each->value());
    }
    return all;
}

// What a server on an RTU line is asked, silence before and behind.
std::vector<frame> rtu_questions(const pieces& received)
{
    std::vector<frame> all;
    rtu_bus_framer in({us}, 20ms);
    CHECK_FALSE(in.next(t0 - 1s));
    CHECK_FALSE(in.next(t0));
    const auto take = [&](time_point now) {
        while (const auto each = in.next(now)) {
            CHECK(each->what == bus_event::kind::question);
            all.push_back(each->content);
        }
    };
    for (const bytes piece : received) {
        in.feed(t0, piece);
        take(t0);
    }
    take(t0 + 1s);
    return all;
}

// What a client finds in the pieces; nothing may be found before the last one.
template <class Answer>
std::optional<response> answer_in(Answer collected, const pieces& received)
{
    for (std::size_t i = 0; i + 1 < received.size(); ++i)
        CHECK_FALSE(collected.feed(received[i]));
    return collected.feed(received.back());
}

void check_answer(const request& question, const buffer& pdu, const response& expected)
{
    every_cut(rtu_frame(us, pdu),
              [&](const pieces& cut) { CHECK(answer_in(rtu_answer(us, question), cut) == expected); });
    every_cut(ascii_frame(us, pdu), [&](const pieces& cut) {
        CHECK(answer_in(ascii_answer(us, question, ascii_delimiter), cut) == expected);
    });
}

}  // namespace

TEST_CASE("frames: with checks that others computed")
{
    for (const whole_frame& each : whole_frames()) {
        CAPTURE(each.name);
        CHECK(encode_rtu(each.content) == each.rtu);
        CHECK(encode_ascii(each.content) == buffer(each.ascii.begin(), each.ascii.end()));
        buffer tcp;
        append_mbap(tcp, {transaction_id{0x1501}, each.content});
        CHECK(tcp == each.tcp);
        // So do the tests themselves.
        CHECK(rtu_frame(each.content.unit, each.content.pdu) == each.rtu);
        CHECK(ascii_frame(each.content.unit, each.content.pdu) == buffer(each.ascii.begin(), each.ascii.end()));
        CHECK(tcp_frame_of(0x1501, each.content.unit, each.content.pdu) == each.tcp);
    }
}

TEST_CASE("frames: every PDU is written in every framing, and read from ASCII and MODBUS TCP at every cut")
{
    for (const pdu_row& row : all_pdus()) {
        CAPTURE(row.name);
        const frame content{us, row.pdu};
        CHECK(encode_rtu(content) == rtu_frame(us, row.pdu));

        const buffer ascii = ascii_frame(us, row.pdu);
        CHECK(encode_ascii(content) == ascii);
        every_cut(ascii, [&](const pieces& cut) { CHECK(ascii_frames(cut) == std::vector{content}); });

        const tcp_frame numbered{transaction_id{0xFFFE}, content};
        const buffer tcp = tcp_frame_of(0xFFFE, us, row.pdu);
        buffer encoded;
        append_mbap(encoded, numbered);
        CHECK(encoded == tcp);
        every_cut(tcp, [&](const pieces& cut) { CHECK(tcp_frames(cut) == std::vector{numbered}); });
    }
}

TEST_CASE("frames: every request is a question to an RTU server, at every cut, to us and to all")
{
    for (const exchange& each : exchanges())
        for (const unit_id to : {us, unit_id::broadcast}) {
            CAPTURE(each.name);
            every_cut(rtu_frame(to, each.asks), [&](const pieces& cut) {
                CHECK(rtu_questions(cut) == std::vector{frame{to, each.asks}});
            });
        }
}

TEST_CASE("frames: every response and every exception answers its question in RTU and ASCII, at every cut")
{
    for (const exchange& each : exchanges()) {
        CAPTURE(each.name);
        if (!each.answers.empty())
            check_answer(each.question, each.answers, each.answer);
        for (const exception_row& refused : exceptions)
            check_answer(each.question, {static_cast<std::uint8_t>(each.asks[0] | 0x80), refused.byte}, refused.code);
    }
}

TEST_SUITE_END();
