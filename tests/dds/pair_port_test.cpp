// What two members of a pair tell each other, between ports on the loopback interface.
#include "bridge/dds/pair_port.hpp"
#include "tests/dds/dds_fixture.hpp"

#include <doctest/doctest.h>

#include <optional>

using namespace plcgw;
using namespace plcgw::test;

namespace {

constexpr duration lease = 500ms;

struct member {
    explicit member(std::string name, std::string gateway = "plant", std::int64_t started = 1)
        : port(made({std::move(gateway), std::move(name), wall_time{started}}))
    {
    }

    static pair_port made(pair_identity who)
    {
        auto port = pair_port::create(own_domain(), std::move(who), lease);
        REQUIRE_MESSAGE(port.has_value(), port.error().text);
        return std::move(*port);
    }

    void take()
    {
        ::pollfd ready{port.descriptor(), POLLIN, 0};
        ::poll(&ready, 1, 20);
        for (pair_news& each : port.take())
            heard.push_back(std::move(each));
    }

    // The next news of that kind, if it comes before the deadline.
    template <class News>
    std::optional<News> next()
    {
        const auto end = steady::now() + deadline;
        for (std::size_t i = 0;; take()) {
            for (; i < heard.size(); ++i)
                if (const auto* const news = std::get_if<News>(&heard[i])) {
                    News found = *news;
                    heard.erase(heard.begin(), heard.begin() + static_cast<std::ptrdiff_t>(i) + 1);
                    return found;
                }
            if (steady::now() > end)
                return std::nullopt;
        }
    }

    pair_port port;
    std::vector<pair_news> heard{};
};

pair_beat beat(const char* who)
{
    pair_beat out;
    out.member = who;
    out.role = pair_role::active;
    out.term = 0x1'0000'0007;
    out.priority = 100;
    out.claims = out.keeps = true;
    out.lines = {{"line1", line_report::mute, false, 1500ms}, {"line2", line_report::good, true, std::nullopt}};
    return out;
}

}  // namespace

TEST_CASE("pair port: beats, memory and routes reach the other member, late ones too, and no other gateway")
{
    member a("a");
    member b("b");
    member stranger("c", "another");
    const memory_chunk memory{"main", 3, 256, 7, std::vector<std::uint16_t>(memory_chunk::size, 0xABCD)};
    route_record route{"pump.speed", true, 7, quality::comm_error, wall_time{1'700'000'000'000'000'002},
                       0x101,        5,    6, "no answer",         {1, 2, 3}};
    a.port.publish(beat("a"));
    a.port.publish(memory);
    a.port.publish(route);
    route.writes = false;
    route.words.assign(1024, 9);
    a.port.publish(route);
    CHECK(a.port.drops() == 0);
    member late("d");
    for (member* const reader : {&b, &late}) {
        CHECK(reader->next<pair_beat>() == beat("a"));
        CHECK(reader->next<memory_chunk>() == memory);
        auto first = reader->next<route_record>();
        auto second = reader->next<route_record>();
        REQUIRE(first);
        REQUIRE(second);
        if (second->writes)
            std::swap(first, second);
        CHECK(second == route);
        CHECK(first->writes);
        CHECK(first->words == std::vector<std::uint16_t>{1, 2, 3});
    }
    a.take();
    CHECK(a.heard.empty());  // itself
    stranger.take();
    CHECK(stranger.heard.empty());
}

TEST_CASE("pair port: two processes of one name hear each other, and the first one comes first")
{
    member first("a", "plant", 1);
    member second("a", "plant", 2);
    // They write the same instance: of two beats at the same time a reader keeps one.
    const auto heard = [](member& speaker, member& listener) {
        const auto end = steady::now() + deadline;
        for (;;) {
            speaker.port.publish(beat("a"));
            listener.take();
            if (!listener.heard.empty() || steady::now() > end)
                return listener.next<pair_beat>();
        }
    };
    const auto of_second = heard(second, first);
    const auto of_first = heard(first, second);
    REQUIRE(of_second);
    REQUIRE(of_first);
    CHECK(of_second->member < "a");
    CHECK(of_first->member > "a");
}

TEST_CASE("pair port: too long a chunk is dropped")
{
    member a("a");
    a.port.publish(memory_chunk{"main", 0, 0, 1, std::vector<std::uint16_t>(memory_chunk::size + 1)});
    CHECK(a.port.drops() == 1);
}

TEST_CASE("pair port: a member that says nothing for its lease is lost, and heard again")
{
    member a("a");
    member b("b");
    a.port.publish(beat("a"));
    REQUIRE(b.next<pair_beat>());
    const auto said = steady::now();
    const auto lost = b.next<pair_lost>();
    REQUIRE(lost);
    CHECK(lost->member == "a");
    CHECK(steady::now() - said >= lease - 100ms);
    a.port.publish(beat("a"));
    CHECK(b.next<pair_beat>());
}

TEST_CASE("pair port: a member whose process ends is lost")
{
    member b("b");
    {
        member a("a");
        a.port.publish(beat("a"));
        REQUIRE(b.next<pair_beat>());
    }
    CHECK(b.next<pair_lost>());
}
