#include "protocols/general_purpose/encode.hpp"
#include "protocols/general_purpose/message_framer.hpp"
#include "protocols/general_purpose/receive_buffers.hpp"
#include "tests/support/messages.hpp"

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::general_purpose;
using namespace plcgw::test;

namespace {

void fill(receive_buffers& in, int first, int last)
{
    for (int i = first; i <= last; ++i)
        in.add(raw(std::to_string(i)));
}

texts take_all(receive_buffers& in)
{
    texts all;
    while (const auto each = in.take())
        all.push_back(text_of(*each));
    return all;
}

constexpr message_form cr{start_code::none, end_code::cr, {}, {}};
constexpr message_form cr_lf{start_code::none, end_code::cr_lf, {}, {}};
constexpr message_form stx_etx{start_code::stx, end_code::etx, {}, {}};
constexpr message_form stx_cr_lf{start_code::stx, end_code::cr_lf, {}, {}};
constexpr message_form quiet{start_code::none, end_code::silence, {}, {}};

}  // namespace

TEST_CASE("receive buffers: eight messages wait in their order, and taking one makes room")
{
    receive_buffers in;
    CHECK_FALSE(in.take().has_value());
    fill(in, 1, 8);
    CHECK(in.waiting() == 8);
    CHECK(in.error_code() == 0);
    CHECK(text_of(*in.take()) == "1");
    fill(in, 9, 9);
    CHECK(take_all(in) == texts{"2", "3", "4", "5", "6", "7", "8", "9"});
    CHECK(in.error_code() == 0);
    CHECK(in.counters().received == 9);
    CHECK(in.counters().lost == 0);
}

TEST_CASE("receive buffers: the ninth stops reception until the channel is reset (10.2.3)")
{
    receive_buffers in;
    fill(in, 1, 9);
    CHECK(in.stopped());
    CHECK(in.error_code() == 0x0200);
    CHECK(in.error_count() == 0);  // counts the low byte
    CHECK(take_all(in) == texts{"1", "2", "3", "4", "5", "6", "7", "8"});
    fill(in, 10, 11);
    CHECK(in.waiting() == 0);
    CHECK(in.counters().lost == 3);

    in.reset();
    CHECK_FALSE(in.stopped());
    CHECK(in.error_code() == 0);
    fill(in, 12, 12);
    CHECK(take_all(in) == texts{"12"});
    CHECK(in.counters().received == 9);
}

TEST_CASE("receive buffers: or only the ninth is lost, where the line says so")
{
    receive_buffers in(when_full::drop);
    fill(in, 1, 10);
    CHECK_FALSE(in.stopped());
    CHECK(in.error_code() == 0x0200);
    CHECK(in.counters().lost == 2);
    CHECK(text_of(*in.take()) == "1");
    fill(in, 11, 11);
    CHECK(take_all(in) == texts{"2", "3", "4", "5", "6", "7", "8", "11"});
    CHECK(in.error_code() == 0x0200);  // somebody should know, until a reset
}

TEST_CASE("receive buffers: a reader that is too slow loses messages, and every one of them is counted")
{
    for (const int taken_every : {1, 2, 3, 10}) {
        receive_buffers in(when_full::drop);
        message_framer line(cr);
        int last = 0;
        std::uint64_t taken = 0;
        for (int i = 1; i <= 1000; ++i) {
            line.feed(t0, raw(std::to_string(i) + '\r'));
            while (auto each = line.next(t0))
                in.add(std::move(*each));
            if (i % taken_every != 0)
                continue;
            const auto message = in.take();
            REQUIRE(message.has_value());
            const int number = std::stoi(text_of(*message));
            CHECK(number > last);
            last = number;
            ++taken;
        }
        CHECK(in.counters().received + in.counters().lost == 1000);
        CHECK(in.counters().received == taken + in.waiting());
        CHECK((in.counters().lost == 0) == (taken_every == 1));
        CHECK((in.error_code() == 0) == (taken_every == 1));
    }
}

TEST_CASE("general purpose: the codes of PMGET (10.3.2, D+8 and D+9)")
{
    CHECK(static_cast<int>(start_code::stx) == 1);
    CHECK(static_cast<int>(end_code::cr) == 0);
    CHECK(static_cast<int>(end_code::cr_lf) == 1);
    CHECK(static_cast<int>(end_code::silence) == 2);
    CHECK(static_cast<int>(end_code::etx) == 3);
}

TEST_CASE("receive buffers: a reset empties them")
{
    receive_buffers in;
    fill(in, 1, 3);
    in.reset();
    CHECK(in.waiting() == 0);
}

TEST_CASE("receive buffers: the bits of the receive error code (10.3.2, D+2 and D+3)")
{
    const struct {
        errc why;
        std::uint16_t bit;
        std::uint16_t count;
    } errors[] = {{errc::overrun, 0x0001, 1},  {errc::bad_stop_bit, 0x0002, 1}, {errc::bad_parity, 0x0004, 1},
                  {errc::overlong, 0x0100, 0}, {errc::restarted, 0, 0},         {errc::incomplete, 0, 0}};
    receive_buffers together;
    std::uint16_t all = 0;
    for (const auto& each : errors) {
        receive_buffers in;
        in.add(make_error_code(each.why));
        CHECK(in.error_code() == each.bit);
        CHECK(in.error_count() == each.count);
        CHECK(in.waiting() == 0);
        CHECK(in.counters().damaged == (each.bit != 0 ? 1 : 0));
        CHECK(in.counters().restarted == (each.bit != 0 ? 0 : 1));
        together.add(make_error_code(each.why));
        all |= each.bit;
        CHECK(together.error_code() == all);
    }
    for (int i = 0; i < 65'536; ++i)
        together.add(make_error_code(errc::bad_parity));
    CHECK(together.error_count() == 3);  // wraps
    together.reset();
    CHECK(together.error_count() == 3);
}

TEST_CASE("general purpose: sending adds the codes of the line")
{
    const struct {
        message_form form;
        const char* whole;
        const char* without;
    } forms[] = {{cr, "12\r", "12"},
                 {cr_lf, "12\r\n", "12"},
                 {stx_etx, "\00212\003", "\00212"},
                 {stx_cr_lf, "\00212\r\n", "\00212"},
                 {quiet, "12", "12"}};
    for (const auto& each : forms) {
        CHECK(text_of(encode(raw("12"), each.form)) == each.whole);
        CHECK(text_of(encode(raw("12"), each.form, ending::without_end_code)) == each.without);
    }
    CHECK(text_of(encode({}, cr)) == "\r");
    CHECK(encode({}, quiet).error() == errc::bad_count);
    CHECK(encode({}, cr, ending::without_end_code).error() == errc::bad_count);
}

TEST_CASE("general purpose: at most 4096 bytes are sent, with the codes (9.3.2)")
{
    const struct {
        message_form form;
        std::size_t codes;
    } forms[] = {{cr, 1}, {cr_lf, 2}, {stx_etx, 2}, {stx_cr_lf, 3}, {quiet, 0}};
    for (const auto& each : forms) {
        const buffer longest(4096 - each.codes, 'x');
        CHECK(encode(longest, each.form)->size() == 4096);
        CHECK(encode(buffer(longest.size() + 1, 'x'), each.form).error() == errc::bad_count);
    }
    CHECK(encode(buffer(4096, 'x'), cr, ending::without_end_code)->size() == 4096);
    CHECK(encode(buffer(4097, 'x'), cr, ending::without_end_code).error() == errc::bad_count);
}

TEST_SUITE_END();
