// A client and a station on one line, in virtual time. Whichever frame is lost or damaged, the values are right in the
// end, and the station is ready for the next question.
#include "protocols/mewtocol/mewtocol7_conversation.hpp"
#include "tests/unit/mewtocol_client.hpp"

#include <numeric>

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol;
using namespace plcgw::test;

namespace {

enum class fate : std::uint8_t { arrives, lost, wrong_bit, without_cr, twice, behind_noise };

constexpr fate fates[] = {fate::lost, fate::wrong_bit, fate::without_cr, fate::twice, fate::behind_noise};

buffer after(fate f, buffer frame)
{
    switch (f) {
    case fate::arrives: break;
    case fate::lost: frame.clear(); break;
    case fate::wrong_bit: frame[frame.size() / 2] ^= 0x01; break;
    case fate::without_cr: frame.pop_back(); break;
    case fate::twice: {
        const buffer once = frame;
        frame.insert(frame.end(), once.begin(), once.end());
        break;
    }
    case fate::behind_noise: frame.insert(frame.begin(), {0x00, 0xFF, '#', '1'}); break;
    }
    return frame;
}

// Plays the transaction until it is done. The frame number `at` of all, both ways, suffers `f`. How many there were.
template <class Transaction>
std::size_t play(Transaction& t, mewtocol_bench& station, std::size_t at, fate f)
{
    std::size_t frames = 0;
    time_point now = t0;
    const auto next_fate = [&] { return frames++ == at ? f : fate::arrives; };
    for (;;) {
        REQUIRE(now < t0 + 60s);
        const auto action = t.next(now);
        if (std::holds_alternative<typename Transaction::done>(action))
            return frames;
        if (const auto* wait = std::get_if<typename Transaction::wait>(&action)) {
            now = wait->until;
            continue;
        }
        const bytes adu = std::get<typename Transaction::send>(action).adu;
        const buffer request(adu.begin(), adu.end());
        t.sent(now);
        station.now = now += 10ms;
        const buffer reply = station.hear(after(next_fate(), request));
        if (!reply.empty())
            t.feed(now += 10ms, after(next_fate(), reply));
    }
}

mewtocol_bench counting_station()
{
    mewtocol_bench b;
    auto& dt = b.device.memory.at(word_area::dt);
    std::iota(dt.begin(), dt.end(), std::uint16_t{0});
    return b;
}

std::vector<std::uint16_t> counting(std::size_t count)
{
    std::vector<std::uint16_t> words(count);
    std::iota(words.begin(), words.end(), std::uint16_t{0});
    return words;
}

constexpr line_options patient{.response_timeout = 500ms, .retries = 2, .silence = 100ms};

}  // namespace

TEST_CASE("mewtocol line: 60 words in three frames, each frame lost or damaged in every way")
{
    for (const fate f : fates)
        for (std::size_t at = 0; at < 6; ++at) {
            CAPTURE(static_cast<int>(f));
            CAPTURE(at);
            mewtocol_bench station = counting_station();
            client t = ask(read_words{word_area::dt, 0, 60}, one, patient);
            const std::size_t frames = play(t, station, at, f);
            REQUIRE(frames >= 6);
            REQUIRE(t.outcome().has_value());
            CHECK(*t.outcome() == response{words_read{counting(60)}});
            CHECK(station.say("%01#RT01") == "%01$RT000000000000000006");
        }
}

TEST_CASE("mewtocol line: a client that gives up leaves the station ready")
{
    for (const fate f : {fate::lost, fate::wrong_bit, fate::without_cr})
        for (std::size_t at = 2; at < 6; ++at) {
            CAPTURE(static_cast<int>(f));
            CAPTURE(at);
            mewtocol_bench station = counting_station();
            line_options hasty = patient;
            hasty.retries = 0;
            client t = ask(read_words{word_area::dt, 0, 60}, one, hasty);
            play(t, station, at, f);
            // A station that says that our request came damaged is cleared and asked anew.
            const bool told = f == fate::wrong_bit && at % 2 == 0;
            CHECK(t.outcome().has_value() == told);
            station.now += 2s;
            CHECK(station.say("%01#RT01") == "%01$RT000000000000000006");
        }
}

TEST_CASE("mewtocol7 line: 2500 words in three frames, each frame lost or damaged in every way")
{
    using client7 = transaction<mewtocol7::conversation>;
    for (const fate f : fates)
        for (std::size_t at = 0; at < 6; ++at) {
            CAPTURE(static_cast<int>(f));
            CAPTURE(at);
            mewtocol_bench station = counting_station();
            const mewtocol7::command question = read_words{word_area::dt, 0, 2500};
            client7 t(mewtocol7::conversation(mewtocol7::station_id{1}, question, 0xFE), patient, t0, t0);
            play(t, station, at, f);
            REQUIRE(t.outcome().has_value());
            CHECK(*t.outcome() == mewtocol7::response{words_read{counting(2500)}});
        }
}

TEST_SUITE_END();
