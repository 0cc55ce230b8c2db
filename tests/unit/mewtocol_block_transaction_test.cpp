// Several commands to one station, played in virtual time.
#include "protocols/mewtocol/block_transaction.hpp"
#include "tests/unit/mewtocol_client.hpp"

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol;
using namespace plcgw::test;

namespace {

using asking = block_transaction<com_client>;

// Sends what it wants sent, waits as it wants; the station's answers come `delay` after each question.
struct player {
    asking t;
    time_point now = t0;

    std::string next_frame()  // without CR; empty when it is done
    {
        for (;;) {
            const auto action = t.next(now);
            if (const auto* send = std::get_if<asking::send>(&action)) {
                std::string frame(send->adu.begin(), send->adu.end() - 1);
                t.sent(now);
                now += on_wire(frame);
                return frame;
            }
            if (std::holds_alternative<asking::done>(action))
                return {};
            now = std::get<asking::wait>(action).until;
        }
    }
    void hear(const std::string& characters, duration after = 20ms)
    {
        now += after;
        const buffer adu = with_cr(checked(characters));
        t.feed(now, adu);
    }
};

const block three_pieces = read_words{word_area::dt, 0, 60};

asking ask_all(std::vector<block> blocks, station_id station = one)
{
    return asking(com_client{station, headers::normal}, std::move(blocks), timing, t0, t0);
}

std::string words(std::size_t count, char digit) { return std::string(4 * count, digit); }

}  // namespace

TEST_CASE("mewtocol block transaction: the response time is that of the slowest command")
{
    player p{ask_all({three_pieces})};
    p.next_frame();
    p.hear("%01$RD" + words(26, '1'), 20ms);
    p.next_frame();
    p.hear("%01$RD" + words(26, '2'), 70ms);
    p.next_frame();
    p.hear("%01$RD" + words(8, '3'), 10ms);
    CHECK(p.next_frame().empty());
    REQUIRE(p.t.outcome().has_value());
    CHECK(p.t.response_time() == 70ms);
}

TEST_CASE("mewtocol block transaction: pieces are asked one after the other, the answer is one")
{
    player p{ask_all({three_pieces})};
    CHECK(p.next_frame() == checked("%01#RDD0000000025"));
    p.hear("%01$RD" + words(26, '1'));
    CHECK(p.next_frame() == checked("%01#RDD0002600051"));
    p.hear("%01$RD" + words(26, '2'));
    CHECK(p.next_frame() == checked("%01#RDD0005200059"));
    p.hear("%01$RD" + words(8, '3'));
    CHECK(p.next_frame().empty());
    REQUIRE(p.t.outcome().has_value());
    REQUIRE(p.t.outcome()->size() == 1);
    const auto& all = std::get<words_read>(p.t.outcome()->front()).values;
    CHECK(all.size() == 60);
    CHECK(all[25] == 0x1111);
    CHECK(all[26] == 0x2222);
    CHECK(all[59] == 0x3333);
    CHECK(p.t.unanswered() == 0);
    CHECK(p.t.faults().empty());
}

TEST_CASE("mewtocol block transaction: an error ends it, what follows is not asked")
{
    player p{ask_all({three_pieces, read_words{word_area::dt, 100, 1}})};
    p.next_frame();
    p.hear("%01$RD" + words(26, '1'));
    p.next_frame();
    p.hear("%01!61");
    CHECK(p.next_frame().empty());
    REQUIRE(p.t.outcome().has_value());
    CHECK((p.t.outcome()->back() == response{mewtocol::error_code::data}));
}

TEST_CASE("mewtocol block transaction: blocks follow each other, each has its answer")
{
    player p{ask_all({write_words{word_area::dt, 5, {0x1234}}, read_words{word_area::dt, 5, 1}})};
    CHECK(p.next_frame() == checked("%01#WDD00005000053412"));
    p.hear("%01$WD");
    CHECK(p.next_frame() == checked("%01#RDD0000500005"));
    p.hear("%01$RD3412");
    CHECK(p.next_frame().empty());
    CHECK((*p.t.outcome() == std::vector<response>{executed{}, words_read{{0x1234}}}));
}

TEST_CASE("mewtocol block transaction: silence ends it, and counts for the late answers")
{
    player p{ask_all({three_pieces})};
    p.next_frame();
    p.hear("%01$RD" + words(26, '1'));
    const std::string second = p.next_frame();
    CHECK(p.next_frame() == second);  // one retry
    CHECK(p.next_frame().empty());
    CHECK(p.t.outcome().error() == errc::timed_out);
    CHECK(p.t.unanswered() == 2);
    CHECK(p.t.faults() == std::vector{errc::timed_out, errc::timed_out});
}

TEST_CASE("mewtocol block transaction: a late answer does not answer the next piece")
{
    player p{ask_all({three_pieces})};
    const std::string first = p.next_frame();
    CHECK(p.next_frame() == first);            // 500 ms later
    p.hear("%01$RD" + words(26, '1'), 200ms);  // to the first attempt, 700 ms late
    const time_point answered = p.now;
    const auto action = p.t.next(p.now);  // waits for the answer to the second one
    REQUIRE(std::holds_alternative<asking::wait>(action));
    CHECK(std::get<asking::wait>(action).until >= answered + 700ms);
    p.hear("%01$RD" + words(26, '1'), 500ms);
    CHECK(p.next_frame() == checked("%01#RDD0002600051"));
    p.hear("%01$RD" + words(26, '2'));
    p.next_frame();
    p.hear("%01$RD" + words(8, '3'));
    CHECK(p.next_frame().empty());
    REQUIRE(p.t.outcome().has_value());
    CHECK(std::get<words_read>(p.t.outcome()->front()).values[26] == 0x2222);
    CHECK(p.t.unanswered() == 1);
}

TEST_CASE("mewtocol block transaction: to the global station goes what needs no answer")
{
    player p{ask_all({write_words{word_area::dt, 5, {1}}}, station_id::global)};
    CHECK(p.next_frame() == checked("%FF#WDD00005000050100"));
    CHECK(p.next_frame().empty());
    CHECK((p.t.outcome()->front() == response{no_response{}}));
}

TEST_CASE("mewtocol block transaction: nothing is sent unless all of it can be")
{
    player p{ask_all({read_words{word_area::dt, 0, 1}, read_words{word_area::dt, 99'999, 2}})};
    CHECK(p.next_frame().empty());
    CHECK(p.t.outcome().error() == errc::not_expressible);
    player nobody{ask_all({read_words{word_area::dt, 0, 1}}, station_id::none)};
    CHECK(nobody.next_frame().empty());
    CHECK(nobody.t.outcome().error() == errc::not_expressible);
    player all{ask_all({read_words{word_area::dt, 0, 1}}, station_id::global)};
    CHECK(all.next_frame().empty());
    CHECK(all.t.outcome().error() == errc::not_expressible);
}

TEST_CASE("mewtocol block transaction: MEWTOCOL7 frames are numbered on, across commands and retries")
{
    std::uint8_t number = 254;
    const mewtocol7::dialect dialect;
    const auto ask = [&] {
        return block_transaction<com7_client>({mewtocol7::station_id{1}, dialect, number},
                                              {write_words{word_area::dt, 0, std::vector<std::uint16_t>(1020)}}, timing,
                                              t0, t0);
    };
    auto t = ask();
    time_point now = t0;
    std::vector<std::string> heads;
    for (;;) {
        const auto action = t.next(now);
        if (std::holds_alternative<decltype(t)::done>(action))
            break;
        if (const auto* wait = std::get_if<decltype(t)::wait>(&action)) {
            now = wait->until;
            continue;
        }
        const bytes adu = std::get<decltype(t)::send>(action).adu;
        heads.emplace_back(adu.begin(), adu.begin() + 8);
        t.sent(now);
        now += character_time(timing.format, adu.size());
        if (heads.size() == 1)
            continue;  // no answer: asked again
        now += 20ms;
        t.feed(now, mewtocol7::encode_frame({.station = mewtocol7::station_id{1},
                                             .number = static_cast<std::uint8_t>(253 + heads.size()),
                                             .text = "$00MMWT"}));
    }
    CHECK(heads == std::vector<std::string>{">@001FE#", ">@001FF#", ">@00100#"});
    CHECK(number == 1);
    REQUIRE(t.outcome().has_value());
    CHECK((t.outcome()->front() == response{executed{}}));
}

TEST_SUITE_END();
