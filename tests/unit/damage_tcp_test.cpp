// Responses that are cut, doubled, one byte short or changed in their header on their way to a MODBUS TCP client: no
// question gets a wrong answer. MODBUS TCP has no checksum of its own: a changed bit in the PDU is left to that of TCP.
#include "protocols/modbus/tcp_questions.hpp"
#include "tests/support/damage.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/support/frames.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

constexpr unit_id station{0x11};
constexpr auto key = tcp_questions::key{42};

// One question on a connection, under the first transaction id, 1, and what comes back.
struct asked {
    tcp_questions questions;
    mbap_framer in;
    std::vector<result<response>> answers;
    bool closed = false;  // the stream cannot be followed any more

    explicit asked(const request& question)
    {
        const buffer adu = questions.ask(key, station, question, t0 + 1s);
        CHECK(adu == tcp_frame_of(1, station, encode_request(question)));
    }

    asked& hear(const pieces& received)
    {
        for (const bytes piece : received) {
            in.feed(piece);
            take();
        }
        return *this;
    }

    asked& hear(bytes received) { return hear(pieces{received}); }

    // It still gets its own answer, or none in time.
    bool waits() { return answers.empty() && questions.size() == 1; }

    bool is_answered(const response& with) const { return answers.size() == 1 && answers[0] && *answers[0] == with; }

private:
    void take()
    {
        while (!closed) {
            const auto each = in.next();
            if (!each)
                return;
            closed = each->has_error();
            if (closed)
                return;
            if (auto taken = questions.take(**each)) {
                CHECK(taken->who == key);
                answers.push_back(std::move(taken->answer));
            }
        }
    }
};

}  // namespace

TEST_CASE("damage, TCP client: an answer comes in any parts, and not before it is whole")
{
    for (const reply& row : replies()) {
        CAPTURE(row.name);
        const buffer adu = tcp_frame_of(1, station, row.pdu);
        every_cut(adu, [&](const pieces& cut) { CHECK(asked(row.question).hear(cut).is_answered(row.meaning)); });
        for (std::size_t size = 0; size < adu.size(); ++size) {
            asked a(row.question);
            CHECK(a.hear(bytes(adu).first(size)).waits());
            const auto late = a.questions.take_expired(t0 + 1s);
            REQUIRE(late.has_value());
            CHECK(late->answer.error() == errc::timed_out);
        }
    }
}

TEST_CASE("damage, TCP client: of an answer that comes twice the second is a stranger's")
{
    for (const reply& row : replies()) {
        CAPTURE(row.name);
        asked a(row.question);
        CHECK(a.hear(twice(tcp_frame_of(1, station, row.pdu))).is_answered(row.meaning));
        CHECK(a.questions.strangers() == 1);
        CHECK_FALSE(a.closed);
        // Nor is it the answer to the same question asked again.
        a.questions.ask(key, station, row.question, t0 + 2s);
        a.hear(tcp_frame_of(1, station, row.pdu));
        CHECK(a.answers.size() == 1);
        CHECK(a.questions.strangers() == 2);
    }
}

TEST_CASE("damage, TCP client: a bit flipped in the header gives no answer, or ends the connection")
{
    for (const reply& row : replies()) {
        CAPTURE(row.name);
        const buffer adu = tcp_frame_of(1, station, row.pdu);
        for (std::size_t bit = 0; bit < 8 * mbap_size; ++bit) {
            CAPTURE(bit);
            asked a(row.question);
            a.hear(with_bit_flipped(adu, bit));
            const bool is_stranger = bit < 16 || bit >= 48;  // transaction id, unit
            const bool is_length = bit >= 32 && bit < 48;
            if (is_stranger) {
                CHECK(a.waits());
                CHECK(a.questions.strangers() == 1);
                CHECK(a.hear(adu).is_answered(row.meaning));
            }
            else if (is_length) {
                // Shorter: not the length of the answer. Longer: still waiting for it, and then not its length.
                a.hear(adu);
                CHECK((a.waits() || (a.answers.size() == 1 && a.answers[0].has_error())));
            }
            else {
                CHECK(a.waits());
                CHECK(a.closed);
            }
        }
    }
}

TEST_CASE("damage, TCP client: one byte short, an answer is never taken for another")
{
    for (const reply& row : replies()) {
        CAPTURE(row.name);
        const buffer adu = tcp_frame_of(1, station, row.pdu);
        // The next answer on the connection gives the missing byte, or does not.
        for (std::size_t missing = 0; missing < mbap_size; ++missing) {
            CAPTURE(missing);
            asked a(row.question);
            a.hear(without_byte(adu, missing)).hear(adu);
            CHECK((a.waits() || (a.answers.size() == 1 && a.answers[0].has_error())));
        }
    }
}

TEST_SUITE_END();
