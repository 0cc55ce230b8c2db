// Every vector in both directions, and through a station with a memory.
#include "protocols/mewtocol/conversation.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/unit/mewtocol_vectors.hpp"

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol;
using namespace plcgw::test;

TEST_CASE("mewtocol vectors: request -> command -> request")
{
    for (const vector_row& row : com_vectors()) {
        CAPTURE(row.id);
        const auto f = parse_frame(row.request);
        REQUIRE(f.has_value());
        CHECK_FALSE(f->more);
        if (f->checked != check::wrong)
            CHECK(encode_frame(*f) == with_cr(row.request));
        if (!row.asked)
            continue;
        REQUIRE(f->text.starts_with('#'));
        const auto asked = parse_command(std::string_view(f->text).substr(1), all_commands);
        REQUIRE(asked.has_value());
        CHECK(*asked == *row.asked);
        CHECK(is_expressible(*row.asked));
        CHECK(f->text == "#" + encode_command(*row.asked));
        CHECK(f->text.substr(1, 2) == to_string(code_of(*row.asked)));
    }
}

TEST_CASE("mewtocol vectors: response -> answer -> response")
{
    for (const vector_row& row : com_vectors()) {
        CAPTURE(row.id);
        if (row.response.empty())
            continue;
        const auto f = parse_frame(row.response);
        REQUIRE(f.has_value());
        CHECK(f->checked == check::good);
        CHECK(encode_frame(*f) == with_cr(row.response));
        const command asked = row.asked.value_or(monitor{});
        const auto answer = parse_response(asked, f->text);
        REQUIRE(answer.has_value());
        CHECK(encode_response(asked, *answer) == f->text);
        if (row.answer)
            CHECK(*answer == *row.answer);
        else
            CHECK(std::holds_alternative<error_code>(*answer));
    }
}

TEST_CASE("mewtocol vectors: a station with that memory answers so, however the request is cut")
{
    mewtocol_bench b;
    for (const vector_row& row : com_vectors()) {
        CAPTURE(row.id);
        prepare(b, row);
        every_cut(with_cr(row.request), [&](const pieces& received) {
            mewtocol_bench other = b;
            buffer sent;
            for (const bytes piece : received) {
                const buffer reply = other.hear(piece);
                sent.insert(sent.end(), reply.begin(), reply.end());
            }
            CHECK(sent == (row.response.empty() ? buffer{} : with_cr(row.response)));
        });
        b.say(row.request);
    }
}

TEST_CASE("mewtocol vectors: a client that asks so understands the answer, however it is cut")
{
    for (const vector_row& row : com_vectors()) {
        CAPTURE(row.id);
        const auto f = parse_frame(row.request);
        if (!row.asked || row.response.empty() || f->checked == check::skipped)
            continue;
        every_cut(with_cr(row.response), [&](const pieces& received) {
            conversation talk(f->head, f->station, *row.asked);
            CHECK(talk.begin() == with_cr(row.request));
            line_framer framer(1s);
            std::optional<response> answer;
            for (const bytes piece : received) {
                framer.feed(t0, piece);
                while (const auto heard = framer.next(t0)) {
                    const auto said = talk.hear(*heard);
                    REQUIRE(std::holds_alternative<response>(said));
                    answer = std::get<response>(said);
                }
            }
            CHECK(answer == row.answer);
        });
    }
}

TEST_CASE("mewtocol vectors: what a global write did")
{
    mewtocol_bench b;
    CHECK(b.say("%FF#WDD0000000000341255").empty());
    CHECK(b.device.memory.at(word_area::dt)[0] == 0x1234);
    CHECK(b.say("%FF#RDD000000000055").empty());  // nobody answers a read of all
    CHECK(b.device.writes == 1);
}

TEST_SUITE_END();
