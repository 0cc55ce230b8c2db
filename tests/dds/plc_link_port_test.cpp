// Areas of a PLC link between two ports on the loopback interface.
#include "bridge/dds/plc_link_port.hpp"
#include "tests/dds/dds_fixture.hpp"

#include <doctest/doctest.h>

#include <optional>

using namespace plcgw;
using namespace plcgw::test;

namespace {

plc_link_port port()
{
    auto made = plc_link_port::create(own_domain(), 1s);
    REQUIRE_MESSAGE(made.has_value(), made.error().text);
    return std::move(*made);
}

plc_link_area area(const char* gateway, std::size_t relays, std::size_t registers)
{
    plc_link_area out;
    out.link = "cell";
    out.sender = {gateway, "host", wall_time{1'700'000'000'000'000'001}};
    out.station = {16,
                   {.block = 1,
                    .max_station = 16,
                    .relay_words = 64,
                    .register_words = 128,
                    .relay_first = 63,
                    .relay_count = static_cast<unsigned>(relays),
                    .register_first = 127,
                    .register_count = static_cast<unsigned>(registers)}};
    out.sequence = 7;
    out.source = wall_time{1'700'000'000'000'000'002};
    for (std::size_t i = 0; i < relays; ++i)
        out.relays.push_back(static_cast<std::uint16_t>(0xFFFF - i));
    for (std::size_t i = 0; i < registers; ++i)
        out.registers.push_back(static_cast<std::uint16_t>(i));
    return out;
}

struct ear {
    plc_link_port in = port();
    std::vector<plc_link_news> heard{};

    // The next news of that kind, of that gateway, if it comes before the deadline.
    template <class News>
    std::optional<News> next(const std::string& gateway)
    {
        const auto end = steady::now() + deadline;
        for (std::size_t i = 0;;) {
            for (; i < heard.size(); ++i)
                if (const auto* const news = std::get_if<News>(&heard[i]); news != nullptr && from(*news) == gateway) {
                    News found = *news;
                    heard.erase(heard.begin(), heard.begin() + static_cast<std::ptrdiff_t>(i) + 1);
                    return found;
                }
            if (steady::now() > end)
                return std::nullopt;
            ::pollfd ready{in.descriptor(), POLLIN, 0};
            ::poll(&ready, 1, 100);
            for (plc_link_news& each : in.take())
                heard.push_back(std::move(each));
        }
    }

    static const std::string& from(const plc_link_area& news) { return news.sender.gateway; }
    static const std::string& from(const plc_link_gone& news) { return news.gateway; }
};

}  // namespace

TEST_CASE("plc link port: what one writes, another reads, and itself; a late one gets it at once")
{
    ear out;
    ear in;
    const plc_link_area sent = area("one", 64, 127);
    out.in.publish(sent);
    CHECK(out.in.drops() == 0);
    ear late;
    for (ear* const reader : {&out, &in, &late}) {
        const auto heard = reader->next<plc_link_area>("one");
        REQUIRE(heard);
        CHECK(heard->link == sent.link);
        CHECK(heard->sender == sent.sender);
        CHECK(heard->station.station == 16);
        CHECK(heard->station.settings == sent.station.settings);
        CHECK(heard->sequence == 7);
        CHECK(heard->source == sent.source);
        CHECK(heard->relays == sent.relays);
        CHECK(heard->registers == sent.registers);
    }
}

TEST_CASE("plc link port: a station without words is heard too, and more words than a block has are dropped")
{
    auto out = port();
    ear in;
    out.publish(area("one", 65, 0));
    CHECK(out.drops() == 1);
    out.publish(area("one", 0, 129));
    CHECK(out.drops() == 2);
    out.publish(area("one", 0, 0));
    CHECK(out.drops() == 2);
    const auto heard = in.next<plc_link_area>("one");
    REQUIRE(heard);
    CHECK(heard->relays.empty());
    CHECK(heard->registers.empty());
}

TEST_CASE("plc link port: a writer that ends, and one that is silent for its lease, are gone")
{
    ear in;
    auto silent = port();
    silent.publish(area("silent", 1, 1));
    REQUIRE(in.next<plc_link_area>("silent"));
    const auto gone = in.next<plc_link_gone>("silent");
    REQUIRE(gone);
    CHECK(gone->link == "cell");
    CHECK(gone->member == "host");
    CHECK(gone->station == 16);

    silent.publish(area("silent", 1, 1));  // it was alive all the time
    CHECK(in.next<plc_link_area>("silent"));
    {
        auto ending = port();
        ending.publish(area("ending", 1, 1));
        REQUIRE(in.next<plc_link_area>("ending"));
    }
    CHECK(in.next<plc_link_gone>("ending"));
}
