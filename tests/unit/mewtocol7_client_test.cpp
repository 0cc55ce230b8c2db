// A MEWTOCOL7 client on a line. The rest of the transaction's timing is tested with MEWTOCOL-COM: it is the same.
#include "protocols/mewtocol/mewtocol7_conversation.hpp"
#include "protocols/mewtocol/plan.hpp"
#include "protocols/mewtocol/text.hpp"
#include "protocols/mewtocol/transaction.hpp"
#include "tests/unit/mewtocol_fake.hpp"

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol7;
using namespace plcgw::test;

namespace {

using client = mewtocol::transaction<conversation>;

constexpr mewtocol::line_options timing{.response_timeout = 500ms, .retries = 1, .silence = 100ms};
const command two_registers = read_words{word_area::dt, 0, 2};

client ask(const command& question, std::uint8_t number)
{
    return client(conversation(station_id{1}, question, number), timing, t0, t0);
}

// What it wants to be sent now, without CR. Tells it that it was.
std::string sent_by(client& t, time_point now)
{
    const auto action = t.next(now);
    const auto* send = std::get_if<client::send>(&action);
    if (send == nullptr)
        return {};
    std::string characters(send->adu.begin(), send->adu.end() - 1);
    t.sent(now);
    return characters;
}

bool is_done(client& t, time_point now) { return std::holds_alternative<client::done>(t.next(now)); }

std::string checked(std::string characters)
{
    mewtocol::append_hex(characters, crc16(characters), 4);
    return characters;
}

}  // namespace

TEST_CASE("mewtocol7 client: each attempt has the next number, and only its own answer counts")
{
    client t = ask(two_registers, 0xFF);
    CHECK(sent_by(t, t0) == checked(">@001FF#00MMRDD001G0DT0000000000002"));
    const time_point second = t0 + 1s;
    CHECK(sent_by(t, second) == checked(">@00100#00MMRDD001G0DT0000000000002"));
    t.feed(second + 10ms, with_cr(checked(">@001FF$00MMRD11112222")));  // late
    CHECK_FALSE(is_done(t, second + 10ms));
    t.feed(second + 50ms, with_cr(">@00100$00MMRD05000A0075BF"));  // W05
    REQUIRE(is_done(t, second + 50ms));
    CHECK(t.outcome().value() == response{words_read{{5, 10}}});
    CHECK(t.conversation().next_number() == 1);
    CHECK(mewtocol::result_of(t.outcome()) == mewtocol::result_code::good);
}

TEST_CASE("mewtocol7 client: when a later frame is lost, the question begins anew")
{
    client t = ask(read_words{word_area::dt, 0, 3}, 0x20);
    CHECK(sent_by(t, t0) == checked(">@00120#00MMRDD001G0DT0000000000003"));
    t.feed(t0 + 50ms, with_cr(checked(">@00120$00MMRD0100") + "&"));
    CHECK(sent_by(t, t0 + 60ms) == checked(">@00121") + "&");
    const time_point again = t0 + 1s;
    CHECK(sent_by(t, again) == checked(">@00122#00MMRDD001G0DT0000000000003"));
    t.feed(again + 50ms, with_cr(checked(">@00122$00MMRD010002") + "&"));  // cut inside a word
    CHECK(sent_by(t, again + 60ms) == checked(">@00123") + "&");
    t.feed(again + 90ms, with_cr(checked(">@00123000300")));
    REQUIRE(is_done(t, again + 90ms));
    CHECK(t.outcome().value() == response{words_read{{1, 2, 3}}});
}

TEST_CASE("mewtocol7 client: an answer that has the number but not the form is a wrong one")
{
    for (const char* wrong : {"$00MMRD0500", "$00MMWT", "!6", "!611", "05000A00", "$00MMRD05000A0G", ""}) {
        CAPTURE(std::string(wrong));
        client t = ask(two_registers, 0);
        sent_by(t, t0);
        t.feed(t0 + 50ms, with_cr(checked(std::string(">@00100") + wrong)));
        CHECK(sent_by(t, t0 + 60ms) == checked(">@00101#00MMRDD001G0DT0000000000002"));
        t.feed(t0 + 90ms, with_cr(checked(">@00101!61")));
        REQUIRE(is_done(t, t0 + 90ms));
        CHECK(t.outcome().value() == response{error_code::data});
    }
}

TEST_CASE("mewtocol7 client: what cannot be said is not sent")
{
    const command not_expressible[] = {read_words{word_area::fl, 0, 1}, read_words{word_area::dt, 0, 0},
                                       read_words{word_area::dt, 100'000'000, 1},
                                       write_words{word_area::dt, 0, std::vector<std::uint16_t>(1015)}};
    for (const command& each : not_expressible) {
        client t = ask(each, 0);
        REQUIRE(is_done(t, t0));
        CHECK(t.outcome().error() == errc::not_expressible);
    }
    client nobody(conversation(station_id{1000}, two_registers, 0), timing, t0, t0);
    CHECK(is_done(nobody, t0));
}

TEST_SUITE_END();
