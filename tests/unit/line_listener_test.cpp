// What is heard on a line of either protocol, in the words of its routes.
#include "bridge/standby/line_listener.hpp"
#include "protocols/modbus/rtu.hpp"
#include "tests/support/virtual_time.hpp"
#include "tests/unit/mewtocol_fake.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::test;

namespace {

std::vector<overheard_exchange> take(line_listener& in, time_point now)
{
    std::vector<overheard_exchange> all;
    while (auto each = in.next(now))
        all.push_back(std::move(*each));
    return all;
}

line_listener on_mewtocol() { return line_listener(mewtocol::bus_listener(500ms, 100ms)); }

}  // namespace

TEST_CASE("line listener: MODBUS exchanges and silence")
{
    const modbus::request asked = modbus::read_table{modbus::table::holding_registers, modbus::address{1}, 1};
    line_listener in{modbus::bus_listener(modbus::serial_options{})};
    take(in, t0 - 1s);
    take(in, t0);
    in.feed(t0, modbus::encode_rtu({modbus::unit_id{5}, {3, 0, 1, 0, 1}}));
    in.feed(t0, modbus::encode_rtu({modbus::unit_id{5}, {3, 2, 0, 9}}));
    in.feed(t0 + 1ms, modbus::encode_rtu({modbus::unit_id{6}, {3, 0, 1, 0, 1}}));
    take(in, t0 + 1ms);
    auto heard = take(in, in.deadline());
    CHECK(in.foreign_question() == t0 + 1ms);
    while (in.deadline() != time_point::max())
        for (auto& each : take(in, in.deadline()))
            heard.push_back(std::move(each));
    REQUIRE(!heard.empty());
    CHECK(heard.back().unit == station_number(6));
    CHECK(heard.back().asked == station_question(asked));
    CHECK_FALSE(heard.back().answer.has_value());
}

TEST_CASE("line listener: MEWTOCOL words that hold contacts come as both")
{
    line_listener in = on_mewtocol();
    in.feed(t0, with_cr("%01#RCCR00020002**"));
    in.feed(t0, with_cr("%01$RC0580**"));
    const auto heard = take(in, t0);
    REQUIRE(heard.size() == 2);
    using namespace mewtocol;
    CHECK(heard[0].asked == station_question(block{read_words{word_area::wr, 2, 1}}));
    const contact first{contact_area::internal_relay, 32};
    CHECK(heard[1].asked == station_question(block{read_run{first, 16}}));
    const auto& bits = std::get<contacts_read>(std::get<response>(*heard[1].answer)).values;
    REQUIRE(bits.size() == 16);
    CHECK(bits[0]);
    CHECK_FALSE(bits[1]);
    CHECK(bits[2]);
    CHECK(bits[15]);
}

TEST_CASE("line listener: what MEWTOCOL asks that no route means is left out, but heard")
{
    line_listener in = on_mewtocol();
    in.feed(t0, with_cr("%01#RT**"));
    CHECK(take(in, t0).empty());
    CHECK(in.foreign_question() == t0);
}

TEST_SUITE_END();
