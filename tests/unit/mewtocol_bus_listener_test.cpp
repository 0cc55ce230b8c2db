// What is heard of others on a MEWTOCOL line where we are a silent client.
#include "protocols/mewtocol/bus_listener.hpp"
#include "protocols/mewtocol/mewtocol7_frame.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/unit/mewtocol_vectors.hpp"

namespace plcgw::test {
namespace {

using namespace mewtocol;

// Frames come one after the other, in virtual time.
struct mewtocol_listening {
    time_point now = t0;
    bus_listener in{500ms, 100ms};
    std::vector<heard_exchange> heard;

    void hear(bytes received)
    {
        in.feed(now, received);
        take();
    }
    void hear(const std::string& characters) { hear(with_cr(characters)); }
    void pause(duration how_long)
    {
        const time_point end = now + how_long;
        while (in.deadline() <= end) {
            now = std::max(now, in.deadline());
            take();
        }
        now = end;
    }
    void take()
    {
        while (auto each = in.next(now))
            heard.push_back(std::move(*each));
    }
};

const std::string read_dt = "%01#RDD0000000001**";
const std::string dt_read = "%01$RD07000201**";

}  // namespace

TEST_SUITE_BEGIN("mewtocol");

TEST_CASE("mewtocol listener: every exchange that a station answers is heard")
{
    mewtocol_bench station;
    for (const vector_row& row : com_vectors()) {
        prepare(station, row);
        if (!row.asked || row.response.empty() || !row.answer)
            continue;
        CAPTURE(row.id);
        mewtocol_listening of;
        of.hear(row.request);
        of.hear(row.response);
        of.pause(1s);
        REQUIRE(of.heard.size() == 1);
        CHECK(of.heard[0].asked == *row.asked);
        CHECK(of.heard[0].answer == row.answer);
        CHECK(of.in.foreign_question() == t0);
    }
}

TEST_CASE("mewtocol listener: frames are heard however they are cut and glued, and from the middle on")
{
    const buffer all = with_cr(dt_read.substr(3) + "\r" + read_dt + "\r" + dt_read);
    every_cut(all, [](const pieces& received) {
        mewtocol_listening of;
        for (const bytes each : received)
            of.hear(each);
        REQUIRE(of.heard.size() == 1);
        CHECK(of.heard[0].station == station_id{1});
        CHECK(of.heard[0].answer == response{words_read{{0x0007, 0x0102}}});
    });
}

TEST_CASE("mewtocol listener: silence, damage and strangers' answers")
{
    const std::string after_it[] = {"", "%01$RD07000201FF", "%02$RD07000201**", "%01$RD0700**", "%01$WD**"};
    for (const std::string& each : after_it) {
        CAPTURE(each);
        mewtocol_listening of;
        of.hear(read_dt);
        if (!each.empty())
            of.hear(each);
        of.pause(2s);
        REQUIRE(of.heard.size() == 1);
        CHECK_FALSE(of.heard[0].answer.has_value());
    }
    mewtocol_listening of;
    of.hear(read_dt);
    of.hear("%02#RDD0000500005**");
    of.hear("%02$RD0100**");
    REQUIRE(of.heard.size() == 2);
    CHECK_FALSE(of.heard[0].answer.has_value());
    CHECK(of.heard[1].answer == response{words_read{{1}}});
}

TEST_CASE("mewtocol listener: what is told to all is done when it was said")
{
    mewtocol_listening of;
    of.hear("%FF#WDD00000000000700**");
    REQUIRE(of.heard.size() == 1);
    CHECK(of.heard[0].station == station_id::global);
    CHECK(of.heard[0].answer == response{no_response{}});
}

TEST_CASE("mewtocol listener: our own questions are nobody else's, with or without their echo")
{
    for (const bool echoes : {false, true}) {
        mewtocol_listening of;
        of.in.spoke(of.now, with_cr(read_dt));
        if (echoes)
            of.hear(read_dt);
        of.hear(dt_read);
        of.pause(1s);
        CHECK(of.heard.empty());
        CHECK_FALSE(of.in.foreign_question().has_value());
        of.hear("%02#RDD0000500005**");
        CHECK(of.in.foreign_question() == of.now);
    }
}

TEST_CASE("mewtocol listener: of MEWTOCOL7 it is known that somebody asked")
{
    const mewtocol7::frame asks{mewtocol7::station_id{1}, 5, "#MMRD", false, check::good};
    const mewtocol7::frame answers{mewtocol7::station_id{1}, 5, "$MMRD", false, check::good};
    mewtocol_listening of;
    of.hear(mewtocol7::encode_frame(answers));
    CHECK_FALSE(of.in.foreign_question().has_value());
    of.in.spoke(of.now, mewtocol7::encode_frame(asks));
    of.take();
    CHECK_FALSE(of.in.foreign_question().has_value());
    of.pause(1s);
    mewtocol7::frame other = asks;
    other.number = 6;
    of.hear(mewtocol7::encode_frame(other));
    CHECK(of.in.foreign_question() == of.now);
    CHECK(of.heard.empty());
}

TEST_SUITE_END();

}  // namespace plcgw::test
