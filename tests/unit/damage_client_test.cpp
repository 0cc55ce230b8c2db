// Responses and exceptions that are cut, doubled, one byte short or changed by one bit on their way to a client, RTU
// and ASCII: the transaction ends with the right answer or with a fault for each attempt, and never hangs.
#include "tests/support/damage.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/support/frames.hpp"
#include "tests/support/rtu_script.hpp"
#include "tests/support/virtual_time.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

constexpr unit_id station{0x11};
constexpr unsigned attempts = 2;
constexpr unsigned patience = 30;  // calls of next()

serial_options timing_of(framing mode)
{
    return {.format = {}, .response_timeout = 500ms, .retries = attempts - 1, .echo = local_echo::off, .mode = mode};
}

buffer adu_of(framing mode, const buffer& pdu)
{
    return mode == framing::rtu ? rtu_frame(station, pdu) : ascii_frame(station, pdu);
}

struct ending {
    std::optional<response> accepted;
    std::vector<answer_fault> faults;
    bool hangs = false;
};

// What arrives 20 ms after each time that the question is sent.
ending play(serial_transaction& t, time_point now, const std::vector<pieces>& arriving)
{
    std::size_t sent = 0;
    for (unsigned calls = 0; calls < patience; ++calls) {
        const auto action = t.next(now);
        if (std::holds_alternative<serial_transaction::done>(action)) {
            const auto& outcome = t.outcome();
            return {outcome ? std::optional(*outcome) : std::nullopt, t.faults(), false};
        }
        if (const auto* const wait = std::get_if<serial_transaction::wait>(&action)) {
            now = wait->until;
            continue;
        }
        t.sent(now);
        const pieces none;
        for (const bytes piece : sent < arriving.size() ? arriving[sent] : none)
            t.feed(now += 20ms, piece);
        ++sent;
    }
    return {std::nullopt, {}, true};
}

ending play(framing mode, const reply& row, const std::vector<pieces>& arriving)
{
    serial_transaction t(station, row.question, timing_of(mode), t0, t0);
    return play(t, t0, arriving);
}

// Thousands of endings, one check: the first that was wrong is shown.
class endings {
public:
    void expect_answer(const ending& e, const reply& row, const char* harm, std::size_t at)
    {
        count(!e.hangs && e.accepted == row.meaning && e.faults.empty(), row, harm, at);
    }

    // Each attempt has its fault. None was a whole frame that did not fit: damage is seen as such.
    void expect_fault(const ending& e, const reply& row, const char* harm, std::size_t at)
    {
        bool good = !e.hangs && !e.accepted && e.faults.size() == attempts;
        for (const answer_fault& each : e.faults)
            good = good && each.why != errc::unexpected_answer && !each.received;
        count(good, row, harm, at);
    }

    void check(std::size_t at_least) const
    {
        CHECK(wrong_ == "");
        CHECK(made_ >= at_least);
    }

private:
    void count(bool good, const reply& row, const char* harm, std::size_t at)
    {
        ++made_;
        if (!good && wrong_.empty())
            wrong_ = row.name + ", " + harm + " " + std::to_string(at);
    }

    std::size_t made_ = 0;
    std::string wrong_;
};

// In ASCII a small letter is the same digit.
bool is_same_digit(framing mode, std::uint8_t was, std::uint8_t is)
{
    return mode == framing::ascii && was >= 'A' && was <= 'F' && is == was + 0x20;
}

}  // namespace

TEST_CASE("damage, client: an answer with any bit flipped is a fault")
{
    for (const framing mode : {framing::rtu, framing::ascii}) {
        CAPTURE(static_cast<int>(mode));
        endings all;
        for (const reply& row : replies()) {
            const buffer adu = adu_of(mode, row.pdu);
            for (std::size_t bit = 0; bit < 8 * adu.size(); ++bit) {
                const buffer flipped = with_bit_flipped(adu, bit);
                const ending e = play(mode, row, {pieces{flipped}});
                if (is_same_digit(mode, adu[bit / 8], flipped[bit / 8]))
                    all.expect_answer(e, row, "bit flipped", bit);
                else
                    all.expect_fault(e, row, "bit flipped", bit);
            }
        }
        all.check(15'000);
    }
}

TEST_CASE("damage, client: an answer one byte short is a fault")
{
    for (const framing mode : {framing::rtu, framing::ascii}) {
        CAPTURE(static_cast<int>(mode));
        endings all;
        for (const reply& row : replies()) {
            const buffer adu = adu_of(mode, row.pdu);
            for (std::size_t missing = 0; missing < adu.size(); ++missing) {
                const buffer shorter = without_byte(adu, missing);
                all.expect_fault(play(mode, row, {pieces{shorter}}), row, "byte missing", missing);
            }
        }
        all.check(1'500);
    }
}

TEST_CASE("damage, client: an answer may come in parts, but one that breaks off is a fault, and so is its rest")
{
    for (const framing mode : {framing::rtu, framing::ascii}) {
        CAPTURE(static_cast<int>(mode));
        endings all;
        for (const reply& row : replies()) {
            const buffer adu = adu_of(mode, row.pdu);
            for (std::size_t cut = 1; cut < adu.size(); ++cut) {
                const bytes first = bytes(adu).first(cut);
                const bytes second = bytes(adu).subspan(cut);
                all.expect_answer(play(mode, row, {pieces{first, second}}), row, "cut", cut);
                all.expect_fault(play(mode, row, {pieces{first}}), row, "cut off", cut);
                all.expect_fault(play(mode, row, {pieces{first}, pieces{second}}), row, "the rest after a retry", cut);
            }
        }
        all.check(5'000);
    }
}

TEST_CASE("damage, client: of an answer that comes twice the second is not the answer to the next question")
{
    for (const framing mode : {framing::rtu, framing::ascii}) {
        CAPTURE(static_cast<int>(mode));
        endings all;
        for (const reply& row : replies()) {
            const buffer adu = adu_of(mode, row.pdu);
            all.expect_answer(play(mode, row, {pieces{twice(adu)}}), row, "glued", 0);

            serial_transaction t(station, row.question, timing_of(mode), t0, t0);
            all.expect_answer(play(t, t0, {pieces{adu}}), row, "before another", 0);
            // The same question, so that unit, function and length would fit.
            const reply next{row.name,
                             row.question,
                             {static_cast<std::uint8_t>(row.pdu[0] | 0x80), 0x06},
                             exception_code::server_device_busy};
            const buffer busy = adu_of(mode, next.pdu);
            const time_point now = t.line_free_from() - 1us;
            serial_transaction asked_next(station, next.question, timing_of(mode), t.line_free_from(), now);
            asked_next.feed(now, adu);
            all.expect_answer(play(asked_next, now, {pieces{busy}}), next, "the next question", 0);
            CHECK(asked_next.stray_bytes() == adu.size());
        }
        all.check(1'000);
    }
}

TEST_SUITE_END();
