#include "protocols/modbus/mbap.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;
using plcgw::test::every_cut;
using plcgw::test::pieces;

namespace {

struct mbap_row {
    const char* name;
    tcp_frame frame;
    buffer adu;
};

// clang-format off
const mbap_row rows[] = {
    //                                    transaction protocol    length      unit  PDU
    {"the guide's example, 4.4.2.2",
        {transaction_id{0x1501}, {unit_id{0xFF}, {0x03, 0x00, 0x04, 0x00, 0x01}}},
                                         {0x15, 0x01, 0x00, 0x00, 0x00, 0x06, 0xFF, 0x03, 0x00, 0x04, 0x00, 0x01}},
    {"a PDU of one byte",
        {transaction_id{0}, {unit_id{1}, {0x07}}},
                                         {0x00, 0x00, 0x00, 0x00, 0x00, 0x02, 0x01, 0x07}},
    {"a broadcast",
        {transaction_id{0xFFFF}, {unit_id::broadcast, {0x05, 0x00, 0x00, 0xFF, 0x00}}},
                                         {0xFF, 0xFF, 0x00, 0x00, 0x00, 0x06, 0x00, 0x05, 0x00, 0x00, 0xFF, 0x00}},
};
// clang-format on

tcp_frame largest() { return {transaction_id{7}, {unit_id{1}, buffer(max_pdu_size, 0x10)}}; }

// All frames that come out of these pieces.
std::vector<tcp_frame> frames_in(const pieces& received)
{
    mbap_framer framer;
    std::vector<tcp_frame> frames;
    for (const bytes piece : received) {
        framer.feed(piece);
        while (const auto next = framer.next()) {
            REQUIRE(next->has_value());
            frames.push_back(**next);
        }
    }
    return frames;
}

// How many bytes it takes until the stream is given up; 0 = never.
std::size_t given_up_after(bytes stream)
{
    mbap_framer framer;
    for (std::size_t i = 0; i < stream.size(); ++i) {
        framer.feed(stream.subspan(i, 1));
        if (const auto next = framer.next()) {
            CHECK(next->error() == errc::bad_header);
            CHECK(framer.next()->error() == errc::bad_header);  // and it stays so
            return i + 1;
        }
    }
    return 0;
}

}  // namespace

TEST_CASE("mbap: encodes and decodes, cut at every place")
{
    for (const mbap_row& row : rows) {
        CAPTURE(row.name);
        buffer encoded;
        append_mbap(encoded, row.frame);
        CHECK(encoded == row.adu);
        every_cut(row.adu, [&](const pieces& received) { CHECK(frames_in(received) == std::vector{row.frame}); });
    }
}

TEST_CASE("mbap: the largest ADU is 260 bytes")
{
    buffer adu;
    append_mbap(adu, largest());
    CHECK(adu.size() == 260);
    every_cut(adu, [&](const pieces& received) { CHECK(frames_in(received) == std::vector{largest()}); });
}

TEST_CASE("mbap: pipelined frames come out in their order, cut at every place")
{
    buffer stream;
    std::vector<tcp_frame> sent{rows[0].frame, rows[1].frame, largest(), rows[2].frame, rows[0].frame};
    for (const tcp_frame& each : sent)
        append_mbap(stream, each);
    every_cut(stream, [&](const pieces& received) { CHECK(frames_in(received) == sent); });
}

TEST_CASE("mbap: nothing comes out of an incomplete frame")
{
    mbap_framer framer;
    CHECK_FALSE(framer.next());
    framer.feed(bytes(rows[0].adu).first(11));
    CHECK_FALSE(framer.next());
    CHECK_FALSE(framer.next());
}

TEST_CASE("mbap: a header that cannot be one is noticed at once")
{
    struct {
        const char* name;
        buffer stream;
        std::size_t noticed_after;
    } const strangers[] = {
        {"protocol id 1", {0x00, 0x01, 0x00, 0x01, 0x00, 0x06, 0x01}, 4},
        {"protocol id 256", {0x00, 0x01, 0x01, 0x00, 0x00, 0x06, 0x01}, 4},
        {"length 0", {0x00, 0x01, 0x00, 0x00, 0x00, 0x00, 0x01}, 6},
        {"length 1: a unit id without a PDU", {0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x01}, 6},
        {"length 255", {0x00, 0x01, 0x00, 0x00, 0x00, 0xFF, 0x01}, 6},
        {"length 65535", {0x00, 0x01, 0x00, 0x00, 0xFF, 0xFF, 0x01}, 6},
        {"a browser", {'G', 'E', 'T', ' ', '/', ' ', 'H', 'T', 'T', 'P'}, 4},
        {"TLS", {0x16, 0x03, 0x01, 0x02, 0x00, 0x01}, 4},
    };
    for (const auto& row : strangers) {
        CAPTURE(row.name);
        CHECK(given_up_after(row.stream) == row.noticed_after);
    }
}

TEST_CASE("mbap: a good frame before a bad header is still delivered")
{
    mbap_framer framer;
    buffer stream = rows[0].adu;
    stream.insert(stream.end(), {'G', 'E', 'T', ' '});
    framer.feed(stream);
    CHECK(**framer.next() == rows[0].frame);
    CHECK(framer.next()->error() == errc::bad_header);
}

TEST_SUITE_END();
