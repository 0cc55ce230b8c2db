// Many clients that ask the stations of one line as fast as they can, beside polls that want more than all of it.
#include "tests/support/line_fixture.hpp"

#include <algorithm>

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

struct shares {
    std::vector<unsigned> answers;  // of each client
    duration polling{};             // line time
    duration all{};
};

// Every client has `outstanding` questions under way; client 0 has ten times as many, and reads ten times as much.
shares play(std::size_t clients, std::size_t outstanding, time_point until)
{
    line_fixture f;
    for (std::uint16_t i = 0; i < 20; ++i)
        f.line.add_route(f.route_to(("D" + std::to_string(100 + i)).c_str(), table::input_registers,
                                    static_cast<std::uint16_t>(500 * i), 1),
                         i % 2, 100ms);
    f.line.port_opened();
    f.line.start(t0);
    shares made{std::vector<unsigned>(clients), {}, {}};
    std::map<forward_ticket, std::size_t> who;
    std::vector<std::size_t> waits(clients);
    std::uint16_t at = 0;
    while (f.now < until) {
        for (std::size_t c = 0; c < clients; ++c)
            while (waits[c] < outstanding * (c == 0 ? 10 : 1)) {
                at = static_cast<std::uint16_t>((at + 211) % 60'000);  // no two that could be joined
                const auto ticket =
                    f.line.forward(unit_id{static_cast<std::uint8_t>(5 + c % 2)},
                                   read_table{table::holding_registers, address{at}, 1}, {}, forward_asker{c + 1});
                REQUIRE(ticket);
                who.emplace(*ticket, c);
                ++waits[c];
            }
        const auto q = f.line.next(f.now);
        REQUIRE(q);
        f.now += 10ms;
        made.all += 10ms;
        if (std::holds_alternative<schedule::turn>(q->origin))
            made.polling += 10ms;
        f.line.answered(*q, registers_read{{1}}, f.now, noon);
        for (const forward_answer& each : f.line.take_forwarded()) {
            const std::size_t c = who.at(each.ticket);
            ++made.answers[c];
            --waits[c];
        }
        f.line.take_samples(f.now);
    }
    return made;
}

}  // namespace

TEST_CASE("forwarding: 1 to 64 clients get equal parts of what is theirs, and the polls keep theirs")
{
    for (const std::size_t clients : {1U, 2U, 8U, 64U}) {
        CAPTURE(clients);
        const shares s = play(clients, clients == 64 ? 1 : 3, t0 + 30s);
        const auto [least, most] = std::minmax_element(s.answers.begin(), s.answers.end());
        CHECK(*least > 0);
        CHECK(*most - *least <= 1 + *most / 10);
        const double polling = static_cast<double>(s.polling.count()) / static_cast<double>(s.all.count());
        CHECK(polling > 0.65);  // requests of others have 0.3 of a full line
        CHECK(polling < 0.78);
    }
}

TEST_SUITE_END();
