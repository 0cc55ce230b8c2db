#include "bridge/dds/bounded_string.hpp"
#include "bridge/dds/log_limiter.hpp"
#include "bridge/dds/quality_code.hpp"
#include "bridge/dds/settings.hpp"

#include <doctest/doctest.h>

using namespace plcgw;
using namespace std::chrono_literals;

namespace {

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("dds settings: loopback is unicast to this host, with key hashes and room for many processes")
{
    const std::string xml = cyclone_xml({});
    CHECK(has(xml, R"(<NetworkInterface name="lo" presence_required="true"/>)"));
    CHECK(has(xml, "<AllowMulticast>false</AllowMulticast>"));
    CHECK(has(xml, R"(<Peers><Peer address="127.0.0.1"/></Peers>)"));
    CHECK(has(xml, "<GenerateKeyhash>true</GenerateKeyhash>"));
    CHECK(has(xml, "<ParticipantIndex>auto</ParticipantIndex>"));
    CHECK(has(xml, "<MaxAutoParticipantIndex>31</MaxAutoParticipantIndex>"));
    CHECK(has(xml, "<LeaseDuration>5000ms</LeaseDuration>"));
    CHECK(has(xml, "<MultipleReceiveThreads>false</MultipleReceiveThreads>"));
    CHECK(has(xml, "<WriterLingerDuration>0s</WriterLingerDuration>"));
}

TEST_CASE("dds settings: a network interface keeps multicast, peers are added, names are escaped")
{
    dds_settings settings;
    settings.interface = R"(e<"&'>)";
    settings.peers = {"10.0.0.1", "plc&host"};
    const std::string xml = cyclone_xml(settings);
    CHECK(has(xml, R"(name="e&lt;&quot;&amp;&apos;&gt;")"));
    CHECK(has(xml, "<AllowMulticast>default</AllowMulticast>"));
    CHECK(has(xml, R"(<Peers><Peer address="10.0.0.1"/><Peer address="plc&amp;host"/></Peers>)"));

    settings.interface.clear();
    settings.peers.clear();
    const std::string any = cyclone_xml(settings);
    CHECK_FALSE(has(any, "<Interfaces>"));
    CHECK_FALSE(has(any, "<Peers>"));
}

TEST_CASE("bounded string: always ends, and is cut before a UTF-8 character that does not fit")
{
    struct row {
        const char* name;
        std::string text;
        std::string kept;  // in char[5]
    };
    const row rows[] = {
        {"empty", "", ""},
        {"fits", "abcd", "abcd"},
        {"too long", "abcde", "abcd"},
        {"two bytes fit", "ab\u00b5", "ab\u00b5"},
        {"two bytes cut", "abc\u00b5", "abc"},
        {"three bytes cut", "ab\u20acx", "ab"},
        {"four bytes fit", "\U0001F600", "\U0001F600"},
        {"four bytes cut", "a\U0001F600", "a"},
        {"not UTF-8", "\x80\x80\x80\x80\x80\x80", "\x80\x80\x80\x80"},
        {"inner NUL", std::string("ab\0cd", 5), "ab"},
    };
    for (const auto& r : rows) {
        CAPTURE(r.name);
        char out[5];
        std::fill(std::begin(out), std::end(out), 'x');
        fill_string(out, r.text);
        CHECK(read_string(out) == r.kept);
        CHECK(out[r.kept.size()] == '\0');
    }
    const char unterminated[] = {'a', 'b'};
    CHECK(read_string(unterminated) == "ab");
}

TEST_CASE("quality codes: both ways, and unknown codes by their range")
{
    for (const quality q :
         {quality::never_read, quality::good, quality::stale, quality::comm_error, quality::device_error})
        CHECK(quality_from_code(quality_code(q)) == q);
    CHECK(quality_code(quality::never_read) == 0);
    CHECK(quality_code(quality::device_error) == 12);
    CHECK(quality_code(quality::comm_error) == 24);
    CHECK(quality_code(quality::stale) == 68);
    CHECK(quality_code(quality::good) == 192);
    CHECK(quality_from_code(28) == quality::comm_error);
    CHECK(quality_from_code(64) == quality::stale);
    CHECK(quality_from_code(191) == quality::stale);
    CHECK(quality_from_code(216) == quality::good);
}

TEST_CASE("log limiter: a flood becomes a few lines and their number")
{
    const time_point t0{};
    log_limiter limiter{2, 60s};
    CHECK(limiter.admit(t0) == 0);
    CHECK(limiter.admit(t0 + 1s) == 0);
    CHECK_FALSE(limiter.admit(t0 + 2s));
    CHECK_FALSE(limiter.admit(t0 + 59s));
    CHECK(limiter.admit(t0 + 60s) == 2);
    CHECK(limiter.admit(t0 + 61s) == 0);
    CHECK_FALSE(limiter.admit(t0 + 62s));
}
