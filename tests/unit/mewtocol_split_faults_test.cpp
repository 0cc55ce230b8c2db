// Messages in several frames, each frame in turn damaged or doubled: the vectors M01 to M14, W02 and W03, in both
// roles.
#include "protocols/mewtocol/conversation.hpp"
#include "protocols/mewtocol/mewtocol7_conversation.hpp"
#include "protocols/mewtocol/text.hpp"
#include "tests/unit/mewtocol_damage.hpp"

#include <numeric>

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::test;
namespace com = plcgw::mewtocol;
namespace com7 = plcgw::mewtocol7;

namespace {

using frames = std::vector<std::string>;

// What the client says and hears.
const frames asked = {"%01#RDD000000005959", "%0124&", "%0124&"};
const frames answered = {
    "%01$"
    "RD00000100020003000400050006000700080009000A000B000C000D000E000F0010001100120013001400150016001700180019001A0061&",
    "%011B001C001D001E001F0020002100220023002400250026002700280029002A002B002C002D002E002F0030003100320033003400350054"
    "&",
    "%0136003700380039003A003B0027"};

const frames written = {
    "%01#"
    "WDD000000002900000100020003000400050006000700080009000A000B000C000D000E000F001000110012001300140015001600170016C&",
    "%0180019001A001B001C001D0010"};
const frames accepted = {"%0124&", "%01$WD13"};

std::vector<std::uint16_t> counting(std::size_t count)
{
    std::vector<std::uint16_t> words(count);
    std::iota(words.begin(), words.end(), std::uint16_t{0});
    return words;
}

std::string checked7(std::string characters)
{
    com::append_hex(characters, com7::crc16(characters), 4);
    return characters;
}

// A conversation that hears these bytes, one string for each of its own frames. What it answers at last.
template <class Conversation>
std::optional<typename Conversation::answer_type> played(Conversation talk, const std::vector<buffer>& station)
{
    talk.begin();
    for (const buffer& said : station) {
        com::line_framer framer(1s);
        framer.feed(t0, said);
        bool asks_on = false;
        while (const auto r = framer.next(t0 + 1s)) {
            const auto verdict = talk.hear(*r);
            if (const auto* answer = std::get_if<typename Conversation::answer_type>(&verdict))
                return *answer;
            if (std::holds_alternative<com::damaged_answer>(verdict))
                return std::nullopt;
            asks_on = asks_on || std::holds_alternative<com::ask_on>(verdict);
        }
        if (!asks_on)
            return std::nullopt;
    }
    return std::nullopt;
}

template <class Conversation>
void check_every_damage(const Conversation& talk, const frames& station, const typename Conversation::answer_type& good)
{
    std::vector<buffer> said;
    for (const std::string& each : station)
        said.push_back(with_cr(each));
    REQUIRE(played(talk, said) == std::optional(good));
    for (std::size_t i = 0; i < said.size(); ++i) {
        CAPTURE(i);
        every_damage(said[i], [&](const buffer& damaged) {
            auto spoilt = said;
            spoilt[i] = damaged;
            CHECK_FALSE(played(talk, spoilt).has_value());
        });
    }
}

}  // namespace

TEST_CASE("mewtocol split faults: M02, M04 and M06, a frame in turn damaged: no answer")
{
    const com::command question = com::read_words{com::word_area::dt, 0, 60};
    check_every_damage(com::conversation(com::header::normal, com::station_id{1}, question), answered,
                       com::response{com::words_read{counting(60)}});
}

TEST_CASE("mewtocol split faults: M01, M03 and M05 damaged: the station says nothing that is not asked for")
{
    for (std::size_t i = 0; i < asked.size(); ++i) {
        CAPTURE(i);
        every_damage(with_cr(asked[i]), [&](const buffer& damaged) {
            mewtocol_bench b;
            b.device.set(com::word_area::dt, 0, counting(100));
            for (std::size_t before = 0; before < i; ++before)
                REQUIRE(b.say(asked[before]) == answered[before]);
            const buffer reply = b.hear(damaged);
            const std::string said(reply.begin(), reply.end());
            CHECK((said.empty() || said.find("!4") == 3));
            // Who asked is answered anew, after AB at the latest.
            b.say("%01#AB04");
            CHECK(b.say("%01#RT01").starts_with("%01$RT"));
        });
    }
}

TEST_CASE("mewtocol split faults: M11 and M13 damaged: nothing is written")
{
    for (std::size_t i = 0; i < written.size(); ++i) {
        CAPTURE(i);
        every_damage(with_cr(written[i]), [&](const buffer& damaged) {
            mewtocol_bench b;
            if (i == 1)
                REQUIRE(b.say(written[0]) == accepted[0]);
            b.hear(damaged);
            CHECK(b.device.writes == 0);
        });
    }
}

TEST_CASE("mewtocol split faults: frames that come twice")
{
    mewtocol_bench b;
    b.device.set(com::word_area::dt, 0, counting(100));
    // Each "go on" takes a frame, the station cannot know better: the client counts the words.
    for (std::size_t i = 0; i < asked.size(); ++i)
        CHECK(b.say(asked[i]) == answered[i]);
    CHECK(b.say("%0124&") == "%01!4302");

    for (std::size_t twice = 0; twice < written.size(); ++twice) {
        CAPTURE(twice);
        mewtocol_bench w;
        for (std::size_t i = 0; i < written.size(); ++i)
            for (int times = 0; times < (i == twice ? 2 : 1); ++times)
                w.say(written[i]);
        const auto& dt = w.device.memory.at(com::word_area::dt);
        const bool as_meant = std::equal(dt.begin(), dt.begin() + 30, counting(30).begin());
        CHECK((w.device.writes == 0 || as_meant));
    }

    const com::command question = com::read_words{com::word_area::dt, 0, 60};
    const com::conversation talk(com::header::normal, com::station_id{1}, question);
    CHECK_FALSE(played(talk, {with_cr(answered[0]), with_cr(answered[0]), with_cr(answered[1])}).has_value());
}

TEST_CASE("mewtocol split faults: V76, a frame without CR within 118 characters")
{
    mewtocol_bench b;
    const std::string longest = "%01#RDD" + std::string(110, '0');  // 118 with its CR, and a wrong check
    CHECK(b.say(longest) == "%01!4001");
    CHECK(b.say(longest + "0") == "%01!2700");
    CHECK(b.say(longest + std::string(3000, '0')) == "%01!2700");
    CHECK(b.say("%01#RCSX00001D") == "%01$RC021");
}

TEST_CASE("mewtocol7 split faults: W02 and W03, a frame in turn damaged: no answer, and nothing executed")
{
    const std::string first = ">@EEE00#00MMRDD001G0DT0000000001000C164";
    const std::string second = ">@EEE0117C0&";
    const com7::command question = com7::read_words{com7::word_area::dt, 0, 1000};
    const frames station = {checked7(">@EEE00$00MMRD" + std::string(240, '0')) + "&",
                            checked7(">@EEE01" + std::string(3760, '0'))};
    com7::conversation talk(com7::station_id::any, question, 0);
    const buffer request = talk.begin();
    CHECK(request == with_cr(first));
    const com::reception heard{station[0], {}, station[0].size() + 1};
    CHECK(std::get<com::ask_on>(talk.hear(heard)).request == with_cr(second));

    // The second one is shorter here: the number of its forms is the square of its length.
    const com7::command few = com7::read_words{com7::word_area::dt, 0, 20};
    check_every_damage(
        com7::conversation(com7::station_id::any, few, 0),
        {checked7(">@EEE00$00MMRD" + std::string(38, '0')) + "&", checked7(">@EEE01" + std::string(42, '0'))},
        com7::response{com7::words_read{std::vector<std::uint16_t>(20)}});

    every_damage(with_cr(first), [&](const buffer& damaged) {
        mewtocol_bench b;
        const buffer reply = b.hear(damaged);
        CHECK((reply.empty() || reply[7] == '!'));
    });
    every_damage(with_cr(second), [&](const buffer& damaged) {
        mewtocol_bench b;
        CHECK(b.say(checked7(">@EEE00#00MMRDD001G0DT0000000002000")).back() == '&');
        const buffer reply = b.hear(damaged);
        CHECK((reply.empty() || reply[7] == '!'));
    });
}

TEST_SUITE_END();
