// What is heard of others on a line where we are a silent client.
#include "protocols/modbus/bus_listener.hpp"
#include "protocols/modbus/rtu.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/support/frames.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"
#include "tests/unit/framing_bus_traffic.hpp"

namespace plcgw::test {
namespace {

using namespace modbus;

const unit_id pump{5};
const unit_id valve{6};

constexpr serial_options rtu_line{.format = {}, .response_timeout = 200ms};
constexpr serial_options ascii_line{.format = {}, .response_timeout = 200ms, .mode = framing::ascii};

// A line on which frames come one after the other, in virtual time.
struct listening {
    explicit listening(const serial_options& how = rtu_line) : options(how), in(how)
    {
        in.next(now);
        pause(1s);
    }

    void hear(bytes received)
    {
        in.feed(now, received);
        take();
    }
    void hear(unit_id unit, const buffer& pdu) { hear(encode_adu(options.mode, {unit, pdu}, ascii_delimiter)); }

    void pause(duration how_long)
    {
        const time_point end = now + how_long;
        while (in.deadline() <= end) {
            now = std::max(now, in.deadline());
            take();
        }
        now = end;
        take();
    }
    void take()
    {
        while (auto each = in.next(now))
            heard.push_back(std::move(*each));
    }

    serial_options options;
    time_point now = t0;
    bus_listener in;
    std::vector<heard_exchange> heard;
};

const buffer read_two{0x03, 0x00, 0x10, 0x00, 0x02};
const buffer two_read{0x03, 0x04, 0x00, 0x07, 0x01, 0x02};
const buffer set_one{0x06, 0x00, 0x0A, 0x03, 0xE8};

const request asked_two = read_table{table::holding_registers, address{0x10}, 2};
const response said_two = registers_read{{0x0007, 0x0102}};

void check_one(const listening& of, unit_id unit, const request& asked, const std::optional<response>& answer)
{
    REQUIRE(of.heard.size() == 1);
    CHECK(of.heard[0].unit == unit);
    CHECK(of.heard[0].asked == asked);
    CHECK(of.heard[0].answer == answer);
}

TEST_SUITE_BEGIN("modbus");

TEST_CASE("bus listener: every exchange that is spoken here is heard, RTU and ASCII")
{
    for (const serial_options& timing : {rtu_line, ascii_line})
        for (const exchange& each : exchanges()) {
            CAPTURE(each.name);
            listening of(timing);
            of.hear(pump, each.asks);
            of.pause(5ms);
            if (!each.answers.empty())
                of.hear(pump, each.answers);
            of.pause(1s);
            check_one(of, pump, each.question, each.answer);
            CHECK(of.in.foreign_question() == t0 + 1s);
        }
}

TEST_CASE("bus listener: an exception is an answer")
{
    for (const serial_options& timing : {rtu_line, ascii_line}) {
        listening of(timing);
        of.hear(pump, read_two);
        of.hear(pump, {0x83, 0x02});
        of.pause(1s);
        check_one(of, pump, asked_two, response{exception_code::illegal_data_address});
    }
}

TEST_CASE("bus listener: an answer is told when it is whole, without waiting for more")
{
    for (const serial_options& timing : {rtu_line, ascii_line}) {
        listening of(timing);
        of.hear(pump, read_two);
        of.hear(pump, two_read);
        of.pause(timing.silence + 20ms);
        check_one(of, pump, asked_two, said_two);
    }
}

TEST_CASE("bus listener: silence is told when the response timeout is over")
{
    for (const serial_options& timing : {rtu_line, ascii_line}) {
        listening of(timing);
        const time_point asked = of.now;
        of.hear(pump, read_two);
        of.pause(190ms);
        CHECK(of.heard.empty());
        of.pause(40ms);
        check_one(of, pump, asked_two, std::nullopt);
        CHECK(of.heard[0].ended >= asked + 200ms);
    }
}

TEST_CASE("bus listener: silence is told when somebody asks on")
{
    listening of;
    of.in.set_timeout(pump, 10s);
    of.hear(pump, read_two);
    of.pause(300ms);
    of.hear(valve, read_two);
    of.hear(valve, two_read);
    of.pause(100ms);
    REQUIRE(of.heard.size() == 2);
    CHECK(of.heard[0].unit == pump);
    CHECK_FALSE(of.heard[0].answer.has_value());
    CHECK(of.heard[1].unit == valve);
    CHECK(of.heard[1].answer == said_two);
}

TEST_CASE("bus listener: an answer that is still on its way when the timeout ends counts")
{
    listening of;
    const buffer adu = encode_rtu({pump, two_read});
    of.hear(pump, read_two);
    of.pause(199ms);
    for (const std::uint8_t each : adu) {
        of.hear(bytes(&each, 1));
        of.pause(10ms);
    }
    of.pause(100ms);
    check_one(of, pump, asked_two, said_two);
}

TEST_CASE("bus listener: a write that is repeated is not its own answer")
{
    for (const serial_options& timing : {rtu_line, ascii_line})
        for (const bool answered : {false, true}) {
            listening of(timing);
            of.hear(pump, set_one);
            of.pause(225ms);
            of.hear(pump, set_one);
            of.pause(30ms);
            if (answered)
                of.hear(pump, set_one);
            of.pause(1s);
            REQUIRE(of.heard.size() == 2);
            CHECK_FALSE(of.heard[0].answer.has_value());
            CHECK(of.heard[1].asked == request{write_single_register{address{10}, 1000}});
            CHECK(of.heard[1].answer == (answered ? std::optional(response{written{}}) : std::nullopt));
        }
}

TEST_CASE("bus listener: a write to all is done when it was said")
{
    listening of;
    of.hear(unit_id::broadcast, set_one);
    of.pause(100ms);
    check_one(of, unit_id::broadcast, write_single_register{address{10}, 1000}, response{no_response{}});
}

TEST_CASE("bus listener: exchanges are heard however the bytes are cut and glued")
{
    for (const serial_options& timing : {rtu_line, ascii_line}) {
        buffer all;
        for (const auto& [unit, pdu] :
             {std::pair{pump, read_two}, {pump, two_read}, {valve, set_one}, {valve, set_one}}) {
            const buffer adu = encode_adu(timing.mode, {unit, pdu}, ascii_delimiter);
            all.insert(all.end(), adu.begin(), adu.end());
        }
        every_cut(all, [&](const pieces& received) {
            listening of(timing);
            for (const bytes each : received) {
                of.hear(each);
                of.pause(1ms);
            }
            of.pause(100ms);
            REQUIRE(of.heard.size() == 2);
            CHECK(of.heard[0].answer == said_two);
            CHECK(of.heard[1].unit == valve);
            CHECK(of.heard[1].answer == response{written{}});
        });
    }
}

TEST_CASE("bus listener: it may begin in the middle of anything")
{
    for (const serial_options& timing : {rtu_line, ascii_line}) {
        buffer talk;
        for (int i = 0; i < 3; ++i)
            for (const buffer& pdu : {read_two, two_read}) {
                const buffer adu = encode_adu(timing.mode, {pump, pdu}, ascii_delimiter);
                talk.insert(talk.end(), adu.begin(), adu.end());
            }
        const std::size_t exchange = talk.size() / 3;
        for (std::size_t from = 0; from < exchange; ++from) {
            CAPTURE(from);
            listening of(timing);
            of.hear(bytes(talk).subspan(from));
            of.pause(1s);
            REQUIRE(of.heard.size() >= 2);
            for (const heard_exchange& each : of.heard) {
                CHECK(each.asked == asked_two);
                CHECK(each.answer == said_two);
            }
        }
    }
}

TEST_CASE("bus listener: noise, damage and strangers' answers are no values")
{
    listening of;
    const buffer asks = encode_rtu({pump, read_two});
    buffer damaged = encode_rtu({pump, two_read});
    damaged[4] ^= 0x40;
    SUBCASE("noise before the answer")
    {
        of.hear(asks);
        of.hear(buffer{0x00});
        of.hear(pump, two_read);
        of.pause(1s);
        check_one(of, pump, asked_two, said_two);
    }
    SUBCASE("a damaged answer")
    {
        of.hear(asks);
        of.hear(damaged);
        of.pause(1s);
        check_one(of, pump, asked_two, std::nullopt);
    }
    SUBCASE("the answer of another station")
    {
        of.hear(asks);
        of.hear(valve, two_read);
        of.pause(1s);
        check_one(of, pump, asked_two, std::nullopt);
    }
    SUBCASE("an answer of another length")
    {
        of.hear(asks);
        of.hear(pump, {0x03, 0x02, 0x00, 0x07});
        of.pause(1s);
        check_one(of, pump, asked_two, std::nullopt);
    }
    SUBCASE("a damaged request with an answer")
    {
        buffer bad = asks;
        bad[3] ^= 0x01;
        of.hear(bad);
        of.pause(30ms);
        of.hear(pump, two_read);
        of.pause(1s);
        CHECK(of.heard.empty());
        CHECK_FALSE(of.in.foreign_question().has_value());
    }
}

TEST_CASE("bus listener: what we say ourselves is nobody else's question")
{
    for (const serial_options& timing : {rtu_line, ascii_line})
        for (const buffer& pdu : {read_two, set_one})
            for (const bool echoes : {false, true}) {
                const buffer adu = encode_adu(timing.mode, {pump, pdu}, ascii_delimiter);
                listening of(timing);
                of.in.spoke(of.now, adu);
                if (echoes)
                    of.hear(adu);
                of.pause(5ms);
                of.hear(pump, pdu == read_two ? two_read : set_one);
                of.pause(1s);
                CHECK(of.heard.empty());
                CHECK_FALSE(of.in.foreign_question().has_value());
                const time_point asked = of.now;
                of.hear(valve, read_two);
                of.pause(1s);
                CHECK(of.in.foreign_question() == asked);
            }
}

TEST_CASE("bus listener: the late answer to a write of ours is nobody's question")
{
    for (const serial_options& timing : {rtu_line, ascii_line}) {
        listening of(timing);
        of.in.spoke(of.now, encode_adu(timing.mode, {pump, set_one}, ascii_delimiter));
        of.pause(300ms);
        of.in.spoke(of.now, encode_adu(timing.mode, {valve, read_two}, ascii_delimiter));
        of.hear(pump, set_one);
        of.pause(1s);
        CHECK_FALSE(of.in.foreign_question().has_value());
    }
}

TEST_CASE("bus listener: a foreign question that comes in place of our answer is heard")
{
    for (const serial_options& timing : {rtu_line, ascii_line}) {
        listening of(timing);
        of.in.spoke(of.now, encode_adu(timing.mode, {pump, read_two}, ascii_delimiter));
        of.pause(10ms);
        const time_point asked = of.now;
        of.hear(valve, read_two);
        of.hear(valve, two_read);
        of.pause(1s);
        CHECK(of.in.foreign_question() == asked);
        check_one(of, valve, asked_two, said_two);
    }
}

// What a client and its servers say at random, with pauses that a receiver may or may not see.
TEST_CASE("bus listener: a long talk is heard as it was said")
{
    for (const serial_options& timing : {rtu_line, ascii_line}) {
        bus_traffic talk(7);
        listening of(timing);
        std::vector<heard_exchange> said;
        for (int i = 0; i < 3000; ++i) {
            const auto [asks, answers] = talk.with_neighbour(false);
            const auto asked = parse_request(asks.pdu);
            if (asked && !expects_answer(asks.unit, *asked))
                continue;
            const bool answered = talk.below(50) != 0;
            of.hear(asks.unit, asks.pdu);
            of.pause(duration(talk.below(6000)));
            if (answered)
                of.hear(answers.unit, answers.pdu);
            of.pause(answered ? duration(talk.below(6000)) : 300ms);
            if (!asked)
                continue;
            said.push_back({asks.unit, *asked, std::nullopt, {}});
            if (const auto answer = parse_response(*asked, answers.pdu); answered && answer)
                said.back().answer = *answer;
        }
        of.pause(1s);
        REQUIRE(of.heard.size() == said.size());
        std::size_t same = 0;
        for (std::size_t i = 0; i < said.size(); ++i)
            same += of.heard[i].unit == said[i].unit && of.heard[i].asked == said[i].asked &&
                            of.heard[i].answer == said[i].answer
                        ? 1
                        : 0;
        CHECK(same == said.size());
    }
}

TEST_SUITE_END();

}  // namespace
}  // namespace plcgw::test
