#include "protocols/echo_filter.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("serial");

using namespace plcgw;
using namespace plcgw::test;

namespace {

const buffer reply{5, 3, 2, 0, 7, 0x11, 0x22};
const buffer written{5, 6, 0, 1, 0, 7, 0x33, 0x44};  // request and reply alike
const buffer request{5, 3, 0, 1, 0, 1, 0x55, 0x66};

constexpr time_point in_time{};
constexpr time_point later = in_time + duration(1);

buffer joined(buffer a, const buffer& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

buffer heard(echo_filter& f, const pieces& received)
{
    buffer all;
    for (const bytes each : received)
        all = joined(all, f.feed(in_time, each));
    return all;
}

}  // namespace

TEST_CASE("echo filter: where echo is on or found out, our reply is left out at every cut")
{
    for (const local_echo mode : {local_echo::on, local_echo::automatic})
        every_cut(joined(reply, request), [&](const pieces& cut) {
            echo_filter f(mode);
            f.sent(reply, false, in_time);
            CHECK(heard(f, cut) == request);
            CHECK(f.echoes() == true);
        });
}

TEST_CASE("echo filter: where there is no echo, no byte is lost at any cut")
{
    for (const local_echo mode : {local_echo::off, local_echo::automatic})
        every_cut(request, [&](const pieces& cut) {
            echo_filter f(mode);
            f.sent(reply, false, in_time);
            CHECK(heard(f, cut) == request);
            CHECK(f.echoes() == false);
        });
}

TEST_CASE("echo filter: once it is known that there is none, the same write again is a request")
{
    echo_filter f(local_echo::automatic);
    f.sent(reply, false, in_time);
    f.feed(in_time, request);
    for (int i = 0; i < 10; ++i) {
        f.sent(written, true, in_time);
        CHECK(f.feed(in_time, written) == written);
    }
}

TEST_CASE("echo filter: once it is known, the reply to a write is left out, and the client's next is not")
{
    echo_filter f(local_echo::automatic);
    f.sent(reply, false, in_time);
    f.feed(in_time, reply);
    f.sent(written, true, in_time);
    CHECK(f.feed(in_time, joined(written, written)) == written);
}

TEST_CASE("echo filter: an echo that is taken for a request does not go round for ever")
{
    echo_filter f(local_echo::automatic);
    for (int i = 0; i < 3; ++i) {
        f.sent(written, true, in_time);
        CHECK(f.feed(in_time, written) == written);
        CHECK_FALSE(f.echoes().has_value());
    }
    f.sent(written, true, in_time);
    CHECK(f.feed(in_time, written).empty());
    CHECK(f.echoes() == true);
}

TEST_CASE("echo filter: a client that writes the same again and again, but not at once, is never taken for an echo")
{
    echo_filter f(local_echo::automatic);
    for (int i = 0; i < 10; ++i) {
        f.sent(written, true, in_time);
        CHECK(f.feed(later, written) == written);
        CHECK_FALSE(f.echoes().has_value());
    }
}

TEST_CASE("echo filter: copies at once that were taken for an echo are believed no longer when one comes late")
{
    echo_filter f(local_echo::automatic);
    for (int i = 0; i < 4; ++i) {
        f.sent(written, true, in_time);
        f.feed(in_time, written);
    }
    CHECK(f.echoes() == true);
    f.sent(written, true, in_time);
    CHECK(f.feed(later, written) == written);
    CHECK_FALSE(f.echoes().has_value());
}

TEST_CASE("echo filter: what is no request is an echo however late it comes")
{
    echo_filter f(local_echo::automatic);
    f.sent(reply, false, in_time);
    CHECK(f.feed(later, reply).empty());
    CHECK(f.echoes() == true);
}

TEST_CASE("echo filter: a line that stops to echo is found out again")
{
    echo_filter f(local_echo::automatic);
    f.sent(reply, false, in_time);
    f.feed(in_time, reply);
    f.sent(reply, false, in_time);
    CHECK(f.feed(in_time, request) == request);
    CHECK(f.echoes() == false);
}

TEST_CASE("echo filter: what looked like the echo at first is given back")
{
    echo_filter f(local_echo::on);
    f.sent(reply, false, in_time);
    CHECK(f.feed(in_time, bytes(reply).first(3)).empty());
    CHECK(f.feed(in_time, request) == joined(buffer(reply.begin(), reply.begin() + 3), request));
}

TEST_SUITE_END();
