// A client that gets its answer in several frames, and what happens when one is lost.
#include "tests/unit/mewtocol_client.hpp"

#include <numeric>

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol;
using namespace plcgw::test;

namespace {

const std::string abort_command = "%01#AB04";

// A split answer of 60 words, as mewtocol_server_test has it, cut elsewhere and not at words.
std::vector<std::string> pieces_of_sixty()
{
    std::vector<std::uint16_t> words(60);
    std::iota(words.begin(), words.end(), std::uint16_t{0});
    std::string data;
    append_words(data, words);
    return {checked("%01$RD" + data.substr(0, 101)) + "&", checked("%01" + data.substr(101, 110)) + "&",
            checked("%01" + data.substr(211))};
}

const read_words sixty_registers{word_area::dt, 0, 60};
const std::string asked_sixty = "%01#RDD000000005959";
const std::string go_on = "%0124&";

}  // namespace

TEST_CASE("mewtocol client: an answer in several frames is collected, wherever it is cut")
{
    client t = ask(sixty_registers);
    REQUIRE(sends(t, t0, asked_sixty));
    time_point now = t0 + 50ms;
    const auto parts = pieces_of_sixty();
    for (std::size_t i = 0; i < parts.size(); ++i, now += 50ms) {
        t.feed(now, with_cr(parts[i]));
        if (i + 1 < parts.size()) {
            CHECK(waits(t, now) == now + gap);
            REQUIRE(sends(t, now + gap, go_on));
            t.feed(now + gap, with_cr(go_on));  // its echo
            CHECK(waits(t, now + gap) == now + gap + on_wire(go_on) + 500ms);
        }
    }
    REQUIRE(is_done(t, now));
    const auto& read = std::get<words_read>(t.outcome().value());
    CHECK(read.values.size() == 60);
    CHECK(read.values[59] == 59);
    CHECK(t.response_time() == 50ms - on_wire(asked_sixty));
    CHECK(t.attempts() == 1);
}

TEST_CASE("mewtocol client: when a later frame is lost, the rest is aborted and the question repeated")
{
    client t = ask(sixty_registers);
    REQUIRE(sends(t, t0, asked_sixty));
    const auto parts = pieces_of_sixty();
    t.feed(t0 + 50ms, with_cr(parts[0]));
    REQUIRE(sends(t, t0 + 60ms, go_on));
    const time_point lost = t0 + 60ms + on_wire(go_on) + 500ms;
    REQUIRE(sends(t, lost, abort_command));
    const time_point again = lost + on_wire(abort_command) + 100ms;
    CHECK(waits(t, lost) == again);
    t.feed(lost + 30ms, with_cr(checked("%01$AB")));  // a station that answers it
    CHECK(t.stray_bytes() == 9);
    REQUIRE(sends(t, again, asked_sixty));

    // Once more: the last attempt. The station is told to forget before anybody else asks.
    t.feed(again + 50ms, with_cr(parts[0]));
    REQUIRE(sends(t, again + 60ms, go_on));
    const time_point damaged = again + 100ms;
    t.feed(damaged, with_cr("%01123400&"));
    REQUIRE(sends(t, damaged + gap, abort_command));
    REQUIRE(is_done(t, damaged + gap));
    CHECK(t.outcome().error() == errc::bad_checksum);
    CHECK(t.attempts() == 2);
    CHECK(t.line_free_from() == damaged + gap + on_wire(abort_command) + 100ms);
}

TEST_CASE("mewtocol client: frames that make no answer together are not believed")
{
    const auto parts = pieces_of_sixty();
    const std::vector<std::string> wrong[] = {
        {parts[0], parts[2]},            // one is missing
        {parts[0], parts[0]},            // the first again
        {parts[0], "%01**&"},            // an empty one
        {parts[0], parts[1], parts[1]},  // more than asked for
        {parts[0], checked("%01!61")},   // an error instead: this is an answer
    };
    for (const auto& frames : wrong) {
        line_options options = timing;
        options.retries = 0;
        client t = ask(sixty_registers, one, options);
        REQUIRE(sends(t, t0, asked_sixty));
        time_point now = t0;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            t.feed(now += 50ms, with_cr(frames[i]));
            if (i + 1 < frames.size())
                REQUIRE(sends(t, now += 10ms, go_on));
        }
        if (&frames != &wrong[0])  // there the station has sent all it had
            REQUIRE(sends(t, now += 10ms, abort_command));
        REQUIRE(is_done(t, now));
        if (&frames == &wrong[4])
            CHECK(t.outcome().value() == response{error_code::data});
        else
            CHECK(t.outcome().error() == errc::unexpected_answer);
    }
}

TEST_CASE("mewtocol client: an answer that waits at the station is cleared once, at no cost of attempts")
{
    line_options options = timing;
    options.retries = 0;
    client t = ask(sixty_registers, one, options);
    REQUIRE(sends(t, t0, asked_sixty));
    t.feed(t0 + 50ms, with_cr("%01!4302"));
    REQUIRE(sends(t, t0 + 60ms, abort_command));
    REQUIRE(sends(t, t0 + 300ms, asked_sixty));
    t.feed(t0 + 350ms, with_cr("%01!4302"));  // it is meant: the station does not split
    REQUIRE(sends(t, t0 + 360ms, abort_command));
    REQUIRE(is_done(t, t0 + 360ms));
    CHECK(t.outcome().value() == response{error_code::procedure});
    CHECK(t.attempts() == 2);
}

TEST_CASE("mewtocol client: a damaged request or a busy station is asked again, even to register")
{
    for (const std::string& refusal : {checked("%01!40"), checked("%01!53")}) {
        CAPTURE(refusal);
        client t = ask(register_data{{{word_area::dt, 0}}});
        const std::string registers = checked("%01#MDD00000");
        REQUIRE(sends(t, t0, registers));
        t.feed(t0 + 50ms, with_cr(refusal));
        CHECK(waits(t, t0 + 50ms) == t0 + 150ms);
        REQUIRE(sends(t, t0 + 150ms, registers));
        t.feed(t0 + 190ms, with_cr(refusal));
        REQUIRE(is_done(t, t0 + 190ms));  // one retry
        CHECK(std::holds_alternative<error_code>(t.outcome().value()));
        CHECK(t.attempts() == 2);
    }
}

TEST_SUITE_END();
