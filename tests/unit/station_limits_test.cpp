// Where a model ends: items in one request, the ends and holes of its default map, devices that only fill up a
// register. FX3 manual 7.1 and 9.3, LS manual 7-1 and 7-2.
#include "protocols/modbus/wire.hpp"
#include "tests/unit/station_bench.hpp"

#include <algorithm>

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using modbus::address;
using modbus::table;
using test::station_bench;

namespace {

buffer pdu_of(std::uint8_t code, std::uint32_t first, std::size_t second)
{
    buffer pdu{code};
    modbus::append_words(pdu, {static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(second)});
    return pdu;
}

// A write of `count` items, all of them 0.
buffer write_of(std::uint8_t code, std::uint32_t first, std::size_t count)
{
    const std::size_t data = code == 0x0F ? modbus::packed_size(count) : 2 * count;
    buffer pdu = pdu_of(code, first, count);
    pdu.push_back(static_cast<std::uint8_t>(data));
    pdu.resize(pdu.size() + data);
    return pdu;
}

// 17 reads and writes the same registers from 0 on.
buffer read_write_of(std::size_t read, std::size_t write)
{
    buffer pdu = pdu_of(0x17, 0, read);
    const buffer rest = write_of(0x10, 0, write);
    pdu.insert(pdu.end(), rest.begin() + 1, rest.end());
    return pdu;
}

buffer exception(std::uint8_t code, std::uint8_t which) { return {static_cast<std::uint8_t>(code | 0x80), which}; }

std::uint8_t read_code(table t)
{
    switch (t) {
    case table::coils: return 0x01;
    case table::discrete_inputs: return 0x02;
    case table::holding_registers: return 0x03;
    case table::input_registers: break;
    }
    return 0x04;
}

}  // namespace

TEST_CASE("station: the most items of one request are the same on every model (7.1, LS manual 7-1)")
{
    struct {
        std::uint8_t code;
        table in;
        std::size_t items;
        buffer pdu;
        bool valid;
    } const rows[] = {
        {0x01, table::coils, 2000, pdu_of(0x01, 0, 2000), true},
        {0x01, table::coils, 0, pdu_of(0x01, 0, 2001), false},
        {0x01, table::coils, 0, pdu_of(0x01, 0, 0), false},
        {0x02, table::discrete_inputs, 2000, pdu_of(0x02, 0, 2000), true},
        {0x02, table::discrete_inputs, 0, pdu_of(0x02, 0, 2001), false},
        {0x03, table::holding_registers, 125, pdu_of(0x03, 0, 125), true},
        {0x03, table::holding_registers, 0, pdu_of(0x03, 0, 126), false},
        {0x04, table::input_registers, 125, pdu_of(0x04, 0, 125), true},
        {0x04, table::input_registers, 0, pdu_of(0x04, 0, 126), false},
        {0x0F, table::coils, 1968, write_of(0x0F, 0, 1968), true},
        {0x0F, table::coils, 0, write_of(0x0F, 0, 1969), false},
        {0x10, table::holding_registers, 123, write_of(0x10, 0, 123), true},
        {0x10, table::holding_registers, 0, write_of(0x10, 0, 124), false},
        {0x17, table::holding_registers, 125, read_write_of(125, 121), true},
        {0x17, table::holding_registers, 0, read_write_of(126, 121), false},
        {0x17, table::holding_registers, 0, read_write_of(125, 122), false},
    };
    for (const plc::model* m : plc::all_models())
        for (const auto& row : rows) {
            CAPTURE(std::string(m->name));
            CAPTURE(row.code);
            CAPTURE(row.valid);
            station_bench b("", *m);
            const auto reply = b.ask(row.pdu);
            REQUIRE(reply.has_value());
            if (!plc::answers(*m, modbus::function{row.code}, plc::transport::serial))
                CHECK(reply == exception(row.code, 1));
            else if (!row.valid)
                CHECK(reply == exception(row.code, 3));
            else if (!b.plc.map().find(b.plc.memory(), row.in, address{0}, row.items))
                CHECK(reply == exception(row.code, 2));  // an FX3S has fewer relays, an LS no such table
            else
                CHECK(reply->at(0) == row.code);
        }
}

TEST_CASE("station: on every model, the ends of each run of the default map are answered and exception 02 behind them")
{
    for (const plc::model* m : plc::all_models())
        for (const plc::map_row& row : m->standard_map) {
            CAPTURE(std::string(m->name));
            CAPTURE(std::string(modbus::to_string(row.table)));
            CAPTURE(row.first);
            station_bench b("", *m);
            const std::uint8_t read = read_code(row.table);
            const std::uint32_t last = row.first + row.count - 1;
            const auto maps = [&](std::uint32_t number) {
                return std::any_of(m->standard_map.begin(), m->standard_map.end(), [&](const plc::map_row& r) {
                    return r.table == row.table && number >= r.first && number < r.first + r.count;
                });
            };
            CHECK(b.ask(pdu_of(read, row.first, 1))->at(0) == read);
            CHECK(b.ask(pdu_of(read, last, 1))->at(0) == read);
            if (last == 0xFFFF)
                continue;  // nothing is behind it
            const bool goes_on = maps(last + 1);
            const bool is_last_number = last == 65'535;  // nothing can be asked behind it
            if (!is_last_number)
                CHECK(b.ask(pdu_of(read, last + 1, 1))->at(0) == (goes_on ? read : read | 0x80));
            CHECK((b.ask(pdu_of(read, last, 2)) == exception(read, 2)) == !goes_on);
            if (row.first > 0)
                CHECK((b.ask(pdu_of(read, row.first - 1, 2)) == exception(read, 2)) == !maps(row.first - 1));
            if (goes_on)
                continue;
            if (row.table != table::coils && row.table != table::holding_registers)
                continue;
            const bool bits = row.table == table::coils;
            buffer across = write_of(bits ? 0x0F : 0x10, last, 2);
            std::fill(across.begin() + 6, across.end(), bits ? 0x03 : 0xFF);
            CHECK(b.ask(across) == exception(across[0], 2));
            if (!is_last_number)
                CHECK(b.ask(pdu_of(bits ? 0x05 : 0x06, last + 1, 0)) == exception(bits ? 0x05 : 0x06, 2));
            const auto end = b.plc.map().find(b.plc.memory(), row.table, address{static_cast<std::uint16_t>(last)}, 1);
            CHECK_FALSE(b.plc.memory().bit(end->front().at));  // not even the one that exists
        }
}

TEST_CASE("station: an unused number inside a run of numbers refuses the whole run (9.3, FX3S)")
{
    station_bench b("", plc::fx3s);
    CHECK(b.ask(pdu_of(0x01, 0x3200, 0x20))->at(0) == 0x01);  // CS0-CS31
    CHECK(b.ask(pdu_of(0x01, 0x32C8, 0x38))->at(0) == 0x01);  // CS200-CS255
    CHECK(b.ask(pdu_of(0x01, 0x3200, 0x100)) == buffer{0x81, 0x02});
    CHECK(b.ask(pdu_of(0x03, 0xA340, 0x20))->at(0) == 0x03);  // CN0-CN31
    CHECK(b.ask(pdu_of(0x03, 0xA408, 0x70))->at(0) == 0x03);  // CN200-CN255, two registers each
    CHECK(b.ask(pdu_of(0x03, 0xA35F, 2)) == buffer{0x83, 0x02});
    CHECK(b.ask(pdu_of(0x03, 0xA407, 2)) == buffer{0x83, 0x02});
    CHECK(b.ask(pdu_of(0x04, 0xA799, 0x0C)) == buffer{0x84, 0x02});
}

TEST_CASE("station: in a register of bit devices, those that the model does not have read 0 and stay 0 (9.3, FX3S)")
{
    struct {
        const char* name;
        std::uint16_t number;
        std::uint16_t there;
    } const rows[] = {
        {"Y0-Y15", 0xA7A8, 0x3FFF},      {"TS128-TS137", 0xA780, 0x03FF}, {"CS200-CS207", 0xA7A4, 0xFF00},
        {"CS208-CS223", 0xA7A5, 0xFFFF}, {"M0-M15", 0xA478, 0xFFFF},      {"CS16-CS31", 0xA799, 0xFFFF},
        {"TS112-TS127", 0xA77F, 0xFFFF},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        station_bench b("", plc::fx3s);
        CHECK(b.ask(pdu_of(0x06, row.number, 0xFFFF)) == pdu_of(0x06, row.number, 0xFFFF));
        buffer expected{0x03, 0x02};
        modbus::append_word(expected, row.there);
        CHECK(b.ask(pdu_of(0x03, row.number, 1)) == expected);
        CHECK(b.ask(pdu_of(0x06, row.number, 0)) == pdu_of(0x06, row.number, 0));
        CHECK(b.ask(pdu_of(0x03, row.number, 1)) == buffer{0x03, 0x02, 0x00, 0x00});
    }
    station_bench b("", plc::fx3s);
    CHECK(b.ask({0x06, 0xA7, 0xA4, 0xA1, 0xFF}).has_value());
    CHECK(b.ask(pdu_of(0x01, 0x32C8, 8)) == buffer{0x01, 0x01, 0xA1});  // CS200 is bit 8
}

TEST_CASE("station: FX3S, FX3G and FX3GC answer exception 01 to every diagnostic (7.1)")
{
    for (const plc::model* m : {&plc::fx3s, &plc::fx3g, &plc::fx3gc})
        for (std::uint8_t sub = 0; sub <= 0x12; ++sub) {
            CAPTURE(std::string(m->name));
            CAPTURE(sub);
            station_bench b("", *m);
            CHECK(b.ask({0x08, 0x00, sub, 0x00, 0x00}) == buffer{0x88, 0x01});
            CHECK(b.word("D8402") == 209);
            CHECK_FALSE(b.station.listen_only());
        }
}

TEST_CASE("station: an FX3UC reports F3 as an FX3U does (7.16)")
{
    station_bench b("", plc::fx3uc);
    CHECK(b.ask({0x11}) == buffer{0x11, 0x02, 0xF3, 0xFF});
}

TEST_SUITE_END();
