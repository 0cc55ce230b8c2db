// The arithmetic of an emulated wire, in virtual time: nobody else checks the figures that benchmarks print.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include "tests/bench/wire.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace plcgw::bench;

namespace {

constexpr nanoseconds ms = 1'000'000;
constexpr nanoseconds t0 = 1000 * ms;
constexpr wire_format ten_kilobaud{10'000, 10, delivery::byte};  // a character lasts 1 ms, the silence 3.5 ms

const byte_vector question{0x01, 0x03, 0x00, 0x05, 0x00, 0x02, 0xD4, 0x0A};
const byte_vector answer{0x01, 0x03, 0x04, 0x00, 0x05, 0x00, 0x06, 0x6A, 0x30};
constexpr nanoseconds turnaround = 5 * ms;
constexpr nanoseconds answer_end = t0 + 8 * ms + turnaround + 9 * ms;

wire one_station(wire_format format)
{
    station device;
    device.turnaround = turnaround;
    device.registers = {0, 1, 2, 3, 4, 5, 6, 7};
    station_table stations;
    stations.add(1, device);
    return {format, std::move(stations)};
}

}  // namespace

TEST_CASE("wire: the checksum is that of the specification's example")
{
    CHECK(modbus_crc(byte_vector{0x02, 0x07}) == 0x1241);
}

TEST_CASE("wire: a response comes byte by byte, each at the end of its character")
{
    wire line = one_station(ten_kilobaud);
    line.heard(t0, question);
    for (std::size_t i = 0; i < answer.size(); ++i) {
        const nanoseconds end = t0 + 8 * ms + turnaround + static_cast<nanoseconds>(i + 1) * ms;
        CHECK(line.deadline() == end);
        CHECK(line.due(end - 1).empty());
        CHECK(line.due(end) == byte_vector{answer[i]});
    }
    CHECK(line.deadline() == wire::never());
}

TEST_CASE("wire: a 16550 hands over at its trigger level, and the rest four characters later")
{
    wire line = one_station({10'000, 10, delivery::fifo});
    line.heard(t0, question);
    CHECK(line.deadline() == answer_end - 1 * ms);
    CHECK(line.due(line.deadline()).size() == 8);
    CHECK(line.deadline() == answer_end + 4 * ms);
    CHECK(line.due(line.deadline()).size() == 1);
}

TEST_CASE("wire: bytes that are handed to the driver early wait for their turn, and no drift adds up")
{
    wire line = one_station({115'200, 11, delivery::frame});
    for (std::size_t i = 0; i < question.size(); ++i)
        line.heard(t0 + static_cast<nanoseconds>(i) * 10'000, byte_vector{question[i]});
    CHECK(line.deadline() == t0 + 8LL * 11 * 1'000'000'000 / 115'200 + turnaround + 9LL * 11 * 1'000'000'000 / 115'200);
}

TEST_CASE("wire: a request after exactly the silence is right, one nanosecond earlier it is too short")
{
    for (const nanoseconds early : {0, 1}) {
        wire line = one_station(ten_kilobaud);
        line.heard(t0, question);
        line.due(answer_end);
        line.heard(answer_end + 3 * ms + ms / 2 - early, question);
        const auto report = line.window().report();
        CHECK(report["short_silences"] == early);
        CHECK(report["collisions"] == 0);
        CHECK(report["requests"] == 2);
    }
}

TEST_CASE("wire: above 19200 the silence is 1.75 ms")
{
    CHECK(wire_format{115'200, 11, delivery::byte}.rule() == 1'750'000);
    CHECK(wire_format{19'200, 11, delivery::byte}.rule() == 2'005'208);
}

TEST_CASE("wire: who sends into a response destroys it")
{
    wire line = one_station(ten_kilobaud);
    line.heard(t0, question);
    line.due(answer_end - 2 * ms);
    line.heard(answer_end - 2 * ms, question);
    const auto report = line.window().report();
    CHECK(report["collisions"] == 1);
    CHECK(report["answered"] == 0);
}

TEST_CASE("wire: a pause inside a request tears it")
{
    wire line = one_station(ten_kilobaud);
    line.heard(t0, byte_span(question).first(3));
    line.heard(t0 + 5 * ms, byte_span(question).subspan(3));
    CHECK(line.window().report()["torn_requests"] == 1);
}

TEST_CASE("wire: a line that is never idle uses all that it can")
{
    wire line = one_station(ten_kilobaud);
    nanoseconds start = t0;
    for (int i = 0; i < 10; ++i) {
        line.heard(start, question);
        start += 8 * ms + turnaround + 9 * ms;
        line.due(start);
        start += line.format().rule();
    }
    const auto report = line.window().report();
    CHECK(report["answered"] == 10);
    CHECK(report["ideal_us"] == report["elapsed_us"]);
    CHECK(report["longest_us"] == 25'500);
}

TEST_CASE("wire: the end of a write request is remembered, and that a dead station does not answer it")
{
    wire line = one_station(ten_kilobaud);
    line.heard(t0, byte_vector{0x02, 0x06, 0x00, 0x01, 0x00, 0x09, 0x18, 0x3F});
    const auto report = line.window().report();
    CHECK(report["writes"] == nlohmann::json{{2, 1, 9, t0 + 8 * ms}});
    CHECK(report["unanswered"] == 1);
    CHECK(line.deadline() == wire::never());
}

TEST_CASE("wire: a change is remembered with the end of the response that shows it first")
{
    station counting;
    counting.turnaround = turnaround;
    counting.moving = 2;  // every second read
    counting.registers.resize(8);
    station_table stations;
    stations.add(1, counting);
    wire line(ten_kilobaud, std::move(stations));
    constexpr nanoseconds apart = 100 * ms;
    for (int i = 0; i < 4; ++i) {
        line.heard(t0 + i * apart, question);
        line.due(answer_end + i * apart);
    }
    const auto first = nlohmann::json{1, 5, 1, answer_end + apart};
    const auto second = nlohmann::json{1, 5, 2, answer_end + 3 * apart};
    CHECK(line.window().report()["changes"] == nlohmann::json{first, second});
}
