// Damaged frames. A BCC is one exclusive or: it finds every single wrong bit and every single lost or doubled character
// of what it covers, but no two equal errors in one column, and no exchange of two characters.
//
// One wrong bit outside of it: a header becomes no other header; without CR there is no frame; a 5 that becomes `%`
// begins a frame that has no `#` or `$`; a last digit 6 that becomes `&` makes a check of the two characters in front
// of it, which then fits no text.
#include "protocols/mewtocol/conversation.hpp"
#include "tests/unit/mewtocol_client.hpp"
#include "tests/unit/mewtocol_damage.hpp"
#include "tests/unit/mewtocol_vectors.hpp"

#include <random>

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol;
using namespace plcgw::test;

namespace {

// The commands that a station would execute.
std::vector<command> commands_in(const buffer& received, const server_options& options)
{
    line_framer framer(1s);
    server station(options);
    framer.feed(t0, received);
    std::vector<command> commands;
    while (const auto r = framer.next(t0 + 1s)) {
        const auto action = station.hear(t0 + 1s, *r);
        if (const auto* asked = std::get_if<command>(&action))
            commands.push_back(*asked);
    }
    return commands;
}

// What a client takes for its answer. A part of one (more to come) counts too: a null response.
std::optional<std::optional<response>> answer_in(const buffer& received, const frame& asked, const command& question)
{
    line_framer framer(1s);
    conversation talk(asked.head, asked.station, question);
    talk.begin();
    framer.feed(t0, received);
    while (const auto r = framer.next(t0 + 1s)) {
        const auto said = talk.hear(*r);
        if (const auto* answer = std::get_if<response>(&said))
            return *answer;
        if (std::holds_alternative<ask_on>(said))
            return std::optional<response>{};
        if (std::holds_alternative<damaged_answer>(said))
            return std::nullopt;
    }
    return std::nullopt;
}

server_options options_of(const frame& f) { return {.own = is_server_number(f.station) ? f.station : station_id{1}}; }

struct exchange {
    const char* id;
    frame asked;
    command question;
    buffer request;
    buffer response;
    std::optional<mewtocol::response> answer;
};

// The vectors whose request has a check.
std::vector<exchange> checked_exchanges()
{
    std::vector<exchange> all;
    for (const vector_row& row : com_vectors()) {
        const auto f = parse_frame(row.request);
        if (row.asked && f->checked == check::good)
            all.push_back({row.id, *f, *row.asked, with_cr(row.request), with_cr(row.response), row.answer});
    }
    return all;
}

}  // namespace

TEST_CASE("mewtocol faults: a request with a wrong bit, a byte short or too many, or cut off is never executed")
{
    for (const exchange& e : checked_exchanges()) {
        CAPTURE(e.id);
        const auto options = options_of(e.asked);
        if (!std::holds_alternative<abort_transfer>(e.question))
            REQUIRE(commands_in(e.request, options) == std::vector{e.question});
        every_damage(e.request, [&](const buffer& damaged) { CHECK(commands_in(damaged, options).empty()); });
    }
}

TEST_CASE("mewtocol faults: a request that is refused is not executed when it is damaged")
{
    unsigned refused = 0;
    for (const vector_row& row : com_vectors()) {
        if (row.asked)
            continue;
        CAPTURE(row.id);
        ++refused;
        every_damage(with_cr(row.request), [&](const buffer& damaged) {
            CHECK(commands_in(damaged, {.own = station_id{1}, .offered = fp7_commands}).empty());
        });
    }
    CHECK(refused == 17);
}

TEST_CASE("mewtocol faults: a request behind a damaged one is executed")
{
    const buffer next = with_cr("%01#RT01");
    for (const exchange& e : checked_exchanges()) {
        CAPTURE(e.id);
        every_cut_off(e.request, [&](buffer damaged) {
            damaged.insert(damaged.end(), next.begin(), next.end());
            CHECK(commands_in(damaged, {.own = station_id{1}}) == std::vector<command>{read_status{}});
        });
    }
}

TEST_CASE("mewtocol faults: a request that comes twice is executed twice")
{
    for (const exchange& e : checked_exchanges()) {
        if (std::holds_alternative<abort_transfer>(e.question))
            continue;
        CAPTURE(e.id);
        buffer twice = e.request;
        twice.insert(twice.end(), e.request.begin(), e.request.end());
        CHECK(commands_in(twice, options_of(e.asked)) == std::vector{e.question, e.question});
    }
}

TEST_CASE("mewtocol faults: a response with a wrong bit, a byte short or too many, or cut off is no answer")
{
    for (const exchange& e : checked_exchanges()) {
        if (e.response.size() == 1)
            continue;
        CAPTURE(e.id);
        REQUIRE(answer_in(e.response, e.asked, e.question) == std::optional{e.answer});
        every_damage(e.response, [&](const buffer& damaged) { CHECK_FALSE(answer_in(damaged, e.asked, e.question)); });
    }
}

TEST_CASE("mewtocol faults: a damaged error response is no answer")
{
    for (const vector_row& row : com_vectors()) {
        if (row.asked || row.response.empty())
            continue;
        CAPTURE(row.id);
        // Whatever was asked, an error is an answer; `!40` and `!43` let the client ask again.
        const frame asked{.head = row.response[0] == '<' ? header::expansion : header::normal,
                          .station = parse_frame(row.response)->station};
        const command question = read_words{word_area::dt, 0, 1};
        const buffer response = with_cr(row.response);
        conversation talk(asked.head, asked.station, question);
        talk.begin();
        line_framer framer(1s);
        framer.feed(t0, response);
        const auto said = talk.hear(framer.next(t0).value());
        CHECK((std::holds_alternative<mewtocol::response>(said) ||
               std::holds_alternative<not_now<mewtocol::response>>(said)));
        every_damage(response, [&](const buffer& damaged) { CHECK_FALSE(answer_in(damaged, asked, question)); });
    }
}

TEST_CASE("mewtocol faults: a response that comes twice is the answer, and the line is busy a little longer")
{
    for (const exchange& e : checked_exchanges()) {
        if (e.response.size() == 1)
            continue;
        CAPTURE(e.id);
        client t = ask(e.question, e.asked.station, timing, e.asked.head);
        t.next(t0);
        t.sent(t0);
        buffer twice = e.response;
        twice.insert(twice.end(), e.response.begin(), e.response.end());
        t.feed(t0 + 50ms, twice);
        REQUIRE(is_done(t, t0 + 50ms));
        REQUIRE(t.outcome().has_value());
        CHECK(t.outcome().value() == *e.answer);
        CHECK(t.attempts() == 1);
        t.feed(t0 + 60ms, e.response);
        CHECK(t.stray_bytes() == e.response.size());
        CHECK(t.line_free_from() == t0 + 60ms + gap);
        CHECK(t.outcome().value() == *e.answer);
    }
}

TEST_CASE("mewtocol faults: without a check a wrong bit in the text is believed, in the frame it is not")
{
    // `**` is what the sender asks for. Here one bit makes DT1 of DT0.
    const auto unprotected = commands_in(with_cr("%01#RDD0000000001**"), {.own = station_id{1}});
    CHECK(unprotected == std::vector<command>{read_words{word_area::dt, 0, 2}});
    const auto damaged = commands_in(with_cr("%01#RDD0000100001**"), {.own = station_id{1}});
    CHECK(damaged == std::vector<command>{read_words{word_area::dt, 1, 1}});

    // A check becomes "no check" by two wrong characters only, each in several bits.
    CHECK(commands_in(with_cr("%01#RDD00000000015*"), {.own = station_id{1}}).empty());
    CHECK(commands_in(with_cr("%01#RDD0000000001*4"), {.own = station_id{1}}).empty());
}

TEST_CASE("mewtocol faults: lower-case digits of a check are wrong")
{
    mewtocol_bench b;
    CHECK(b.say("%01#RCSX000A6c") == "%01!4001");
    CHECK(b.say("%01#RCSX000A6C") == "%01$RC021");
}

TEST_CASE("mewtocol faults: whatever is said to a station, what it says is a frame, and it goes on")
{
    constexpr std::string_view alphabet = "%<>@#$!&**\r0123456789ABCDEFRDWTSPCKMGXYL";
    std::minstd_rand dice(7);
    mewtocol_bench b;
    for (int i = 0; i < 20'000; ++i) {
        std::string said = dice() % 2 == 0 ? "%01#" : ">@00100#";
        for (auto size = dice() % 24; size > 0; --size)
            said.push_back(alphabet[dice() % alphabet.size()]);
        const buffer replies = b.hear(with_cr(said + (said[0] == '%' ? "**" : "****")));
        line_framer framer(1s);
        framer.feed(t0, replies);
        while (const auto r = framer.next(t0 + 1s)) {
            REQUIRE(is_frame(*r));
            if (r->characters[0] == '>')
                CHECK(mewtocol7::parse_frame(r->characters)->checked == check::good);
            else
                CHECK(parse_frame(r->characters)->checked == check::good);
        }
    }
    b.now += 31s;
    CHECK(b.say("%01#RCSX00001D") == "%01$RC021");
}

TEST_SUITE_END();
