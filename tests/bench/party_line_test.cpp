// A wire that several members share, in virtual time.
#include "tests/bench/party_line.hpp"

#include <doctest/doctest.h>

using namespace plcgw::bench;

namespace {

using kind = party_line::event::kind;

constexpr nanoseconds ms = 1'000'000;
constexpr nanoseconds t0 = 1000 * ms;
constexpr wire_format ten_kilobaud{10'000, 10, delivery::byte};  // a character lasts 1 ms, the silence 3.5 ms
constexpr nanoseconds turnaround = 5 * ms;

const byte_vector question{0x01, 0x03, 0x00, 0x05, 0x00, 0x02, 0xD4, 0x0A};
const byte_vector answer{0x01, 0x03, 0x04, 0x00, 0x05, 0x00, 0x06, 0x6A, 0x30};
const byte_vector write{0x01, 0x06, 0x00, 0x03, 0x00, 0x09, 0xB9, 0xCC};
constexpr nanoseconds answered = t0 + 8 * ms + turnaround + 9 * ms;

party_line three_members()
{
    station device;
    device.turnaround = turnaround;
    device.registers = {0, 1, 2, 3, 4, 5, 6, 7};
    station_table stations;
    stations.add(1, device);
    return {ten_kilobaud, std::move(stations), 3};
}

// What a member hears until then.
std::vector<byte_vector> heard_until(party_line& line, nanoseconds end)
{
    std::vector<byte_vector> all(3);
    while (line.deadline() <= end)
        for (const auto& each : line.due(line.deadline()))
            all[each.by].push_back(each.byte);
    return all;
}

byte_vector joined(byte_vector a, const byte_vector& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

std::vector<party_line::event> only(kind what, party_line& line)
{
    std::vector<party_line::event> found;
    for (const auto& each : line.take_events())
        if (each.what == what)
            found.push_back(each);
    return found;
}

}  // namespace

TEST_CASE("party line: all others hear a question, all hear the answer, at the pace of the wire")
{
    party_line line = three_members();
    line.heard(t0, 0, question);
    CHECK(line.deadline() == t0 + 1 * ms);
    CHECK(line.due(t0 + 1 * ms - 1).empty());
    CHECK(line.due(t0 + 1 * ms).size() == 2);
    const auto heard = heard_until(line, answered - 1);
    CHECK(heard[0].size() == answer.size() - 1);
    const auto last = heard_until(line, answered);
    CHECK(last[0] == byte_vector{answer.back()});
    CHECK(joined(joined({question[0]}, heard[1]), last[1]) == joined(question, answer));
    CHECK(heard[2] == heard[1]);
    CHECK(line.deadline() == party_line::never());
    const auto requests = only(kind::request, line);
    REQUIRE(requests.size() == 1);
    CHECK(requests[0].at == t0);
    CHECK(requests[0].talker == 0);
    CHECK(requests[0].unit == 1);
    CHECK(requests[0].function == 3);
    CHECK(requests[0].first == 5);
    CHECK(requests[0].value == 2);
    CHECK_FALSE(requests[0].damaged);
}

TEST_CASE("party line: silence before a question is counted from the last byte of anybody")
{
    party_line line = three_members();
    line.heard(t0, 0, question);
    heard_until(line, answered);
    line.heard(answered + 7 * ms, 2, question);
    heard_until(line, answered + 100 * ms);
    const auto requests = only(kind::request, line);
    REQUIRE(requests.size() == 2);
    CHECK(requests[1].talker == 2);
    CHECK(requests[1].silence == 7 * ms);
}

TEST_CASE("party line: two who speak at a time damage each other, and no station acts")
{
    party_line line = three_members();
    line.heard(t0, 0, write);
    line.heard(t0 + 3 * ms + ms / 2, 1, question);
    const auto heard = heard_until(line, t0 + 100 * ms);
    CHECK(heard[2].size() == 16);
    const auto events = line.take_events();
    REQUIRE(events.size() == 3);
    CHECK(events[0].what == kind::collision);
    CHECK(events[0].at == t0 + 3 * ms + ms / 2);
    CHECK(events[0].talker == 1);
    CHECK(events[0].other == 0);
    CHECK(events[1].damaged);
    CHECK(events[2].damaged);
}

TEST_CASE("party line: who speaks into an answer collides with the station")
{
    party_line line = three_members();
    line.heard(t0, 0, question);
    heard_until(line, t0 + 8 * ms);
    line.take_events();
    line.heard(t0 + 10 * ms, 1, question);
    const auto heard = heard_until(line, t0 + 100 * ms);
    const auto collisions = only(kind::collision, line);
    REQUIRE(collisions.size() == 1);
    CHECK(collisions[0].other == party_line::stations);
    CHECK(heard[0].size() == question.size() + answer.size());
}

TEST_CASE("party line: bytes that follow each other at once are no collision")
{
    party_line line = three_members();
    line.heard(t0, 0, question);
    heard_until(line, answered);
    line.heard(answered, 1, question);
    heard_until(line, answered + 100 * ms);
    CHECK(only(kind::collision, line).empty());
}

TEST_CASE("party line: writes that a station executes are told, register by register")
{
    party_line line = three_members();
    line.heard(t0, 1, write);
    heard_until(line, t0 + 100 * ms);
    const auto writes = only(kind::write, line);
    REQUIRE(writes.size() == 1);
    CHECK(writes[0].talker == 1);
    CHECK(writes[0].unit == 1);
    CHECK(writes[0].first == 3);
    CHECK(writes[0].value == 9);
    CHECK(writes[0].at == t0 + 8 * ms);
}

TEST_CASE("party line: a cable that is pulled carries nothing")
{
    party_line line = three_members();
    line.cut(0, true);
    line.heard(t0, 0, question);
    CHECK(line.deadline() == party_line::never());
    line.heard(t0, 1, question);
    const auto heard = heard_until(line, answered);
    CHECK(heard[0].empty());
    CHECK(heard[1] == answer);
    line.cut(0, false);
    line.heard(answered + 10 * ms, 1, question);
    CHECK(heard_until(line, answered + 100 * ms)[0] == joined(question, answer));
}
