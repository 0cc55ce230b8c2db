// Power-on, RUN and STOP: what the PLC shows of its setup, and what each clears. FX3 manual chapter 6 and 12.6.
#include "bridge/services/modbus_service.hpp"
#include "tests/unit/station_bench.hpp"

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using namespace plcgw::plc;
using test::program_of;
using test::server_1;
using test::server_2;

namespace {

struct shown_plc : simulated_plc {
    explicit shown_plc(const std::string& moves, const plc::model& m = fx3u)
        : simulated_plc("main", m, program_of(moves))
    {
    }

    place at(const char* name) const { return memory().find(*parse_device(name)).value(); }
    std::uint16_t word(const char* name) const { return memory().word(at(name)); }
    bool bit(const char* name) const { return memory().bit(at(name)); }
    void set(const char* name, std::uint16_t value) { memory().set_word(at(name), value); }
    void set_bit(const char* name, bool value) { memory().set_bit(at(name), value); }
};

}  // namespace

TEST_CASE("plc: RUN monitor M8000 and its inverse M8001")
{
    shown_plc p("");
    CHECK(p.state() == run_state::run);
    CHECK(p.bit("M8000"));
    CHECK_FALSE(p.bit("M8001"));
    p.stop();
    CHECK(p.state() == run_state::stop);
    CHECK_FALSE(p.bit("M8000"));
    CHECK(p.bit("M8001"));
    p.power_cycle();  // the switch stays where it is
    CHECK(p.state() == run_state::stop);
    CHECK_FALSE(p.bit("M8000"));
    CHECK(p.bit("M8001"));
    p.run();
    CHECK(p.bit("M8000"));
    CHECK_FALSE(p.bit("M8001"));
}

TEST_CASE("plc: a power cycle clears all devices, remembers the program, and its changes are seen")
{
    shown_plc p(std::string(server_1) + "H5002 D8470, K0 D8471, K7 D8412");
    const char* const words[] = {"D0", "D7999", "R32767", "TN511", "CN199", "CN255", "X360", "S4080", "D8012"};
    for (const char* each : words)
        p.set(each, 0x5A5A);
    for (const char* each : {"M7679", "CS255", "TS511", "Y377", "M8511"})
        p.set_bit(each, true);
    p.set("D8412", 3);
    p.memory().take_changes();
    p.power_cycle();
    for (const char* each : words)
        CHECK(p.word(each) == 0);
    for (const char* each : {"M7679", "CS255", "TS511", "Y377", "M8511"})
        CHECK_FALSE(p.bit(each));
    CHECK(p.word("D8400") == 0x1097);
    CHECK(p.word("D8412") == 7);
    CHECK(p.word("D8470") == 0x5002);
    CHECK(p.map().find(p.memory(), modbus::table::coils, modbus::address{0}, 1)->front().at == p.at("X0"));
    const auto changes = p.memory().take_changes();
    const auto saw = [&](const char* name, std::size_t bits) {
        return std::any_of(changes.begin(), changes.end(),
                           [&](const change& c) { return overlaps(c, p.at(name), bits); });
    };
    for (const char* each : words)
        CHECK(saw(each, 16));
    for (const char* each : {"M7679", "CS255", "Y377", "D8412"})
        CHECK(saw(each, 1));
}

TEST_CASE("plc: a power cycle finds the same faults again")
{
    shown_plc p("K248 D8414, H0001 D8470, K4 D8471");
    for (int i = 0; i < 3; ++i) {
        REQUIRE(p.fault().has_value());
        CHECK(p.fault()->detail == 8414);
        CHECK(p.faults().size() == 2);
        CHECK(p.word("D8402") == 202);
        CHECK(p.word("D8403") == 8414);
        CHECK(p.word("D8470") == 0);
        p.power_cycle();
    }
}

// What clears each special device: P power-on, R STOP -> RUN, r STOP -> RUN in a client only, - neither.
TEST_CASE("plc: the matrix of special clear conditions, 6.1 and 6.3")
{
    struct {
        const char* one;
        const char* two;
        char cleared;
    } const rows[] = {
        {"D8402", "D8422", 'r'}, {"D8403", "D8423", 'r'}, {"D8404", "D8424", 'R'}, {"D8407", "D8427", 'R'},
        {"D8408", "D8428", 'R'}, {"D8063", "D8438", 'P'}, {"D8406", "D8426", 'P'}, {"M8401", "M8421", 'R'},
        {"M8402", "M8422", 'R'}, {"M8403", "M8423", 'R'}, {"M8063", "M8438", 'R'}, {"M8408", "M8428", 'R'},
        {"M8409", "M8429", 'R'}, {"M8029", "M8029", 'R'}, {"M8404", "M8424", 'P'}, {"D100", "R100", 'P'},
    };
    struct {
        const char* name;
        std::string moves;
        bool second;
        bool client;
    } const setups[] = {
        {"server on 1", server_1, false, false},
        {"server on 2", server_2, true, false},
        {"client on 1", "H1097 D8400, H1 D8401", false, true},
        {"client on 2", "H1097 D8420, H1 D8421", true, true},
    };
    for (const auto& setup : setups)
        for (const auto& row : rows) {
            const std::string name = setup.second ? row.two : row.one;
            CAPTURE(setup.name);
            CAPTURE(name);
            shown_plc p(setup.moves);
            const bool is_flag = name[0] == 'M';
            const std::uint16_t initially = is_flag ? p.bit(name.c_str()) : p.word(name.c_str());
            const auto value = [&] { return is_flag ? std::uint16_t{p.bit(name.c_str())} : p.word(name.c_str()); };
            const std::uint32_t number = parse_device(name)->number;
            if (is_flag)
                p.show_flag(number, true);
            else if (number >= 8000)
                p.show_register(number, 77);
            else
                p.set(name.c_str(), 77);
            const std::uint16_t marked = value();
            CHECK(marked != initially);
            p.run();  // in RUN already
            p.stop();
            CHECK(value() == marked);
            p.run();
            const bool expected = row.cleared == 'R' || (row.cleared == 'r' && setup.client);
            CHECK(value() == (expected ? 0 : marked));
            p.power_cycle();
            CHECK(value() == initially);
        }
}

TEST_CASE("plc: a client's counters are cleared by STOP -> RUN too (6.4); there is no log of a client")
{
    shown_plc p("H1097 D8400, H1 D8401, H11 D8415, K100 D8416");
    for (const char* each : {"D99", "D100", "D109", "D110", "D142"})
        p.set(each, 5);
    p.stop();
    p.run();
    CHECK(p.word("D99") == 5);
    CHECK(p.word("D100") == 0);
    CHECK(p.word("D109") == 0);
    CHECK(p.word("D110") == 5);
    CHECK(p.channel_at(1).status.counters.has_value());
    CHECK_FALSE(p.channel_at(1).status.log.has_value());
}

TEST_CASE("plc: what D8405, D8406 and D8419 show")
{
    struct {
        const char* name;
        std::string moves;
        std::uint16_t format, delimiter, mode;  // of channel 1, then of channel 2
        std::uint16_t format_2, delimiter_2, mode_2;
    } const rows[] = {
        {"no MODBUS", "", 0, 10, 0, 0, 10, 0},
        {"server on 1", server_1, 0x1097, 10, 9, 0, 10, 0},
        {"server on 2", server_2, 0, 10, 0, 0x1097, 10, 9},
        {"client on 1", "H1081 D8400, H1 D8401", 0x1081, 10, 9, 0, 10, 0},
        {"client with a delimiter", "H1081 D8400, H101 D8401, H23 D8406", 0x1081, 0x23, 9, 0, 10, 0},
        {"a server's delimiter is not the program's", std::string(server_1) + "H23 D8406", 0x1097, 10, 9, 0, 10, 0},
        {"format without protocol", "H1097 D8400", 0, 10, 0, 0, 10, 0},
        {"both: channel 1 has priority", std::string(server_1) + server_2, 0x1097, 10, 9, 0, 10, 0},
        {"wrong station", "H1097 D8400, H11 D8401, K0 D8414", 0, 10, 0, 0, 10, 0},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        const shown_plc p(row.moves);
        CHECK(p.word("D8405") == row.format);
        CHECK(p.word("D8406") == row.delimiter);
        CHECK(p.word("D8419") == row.mode);
        CHECK(p.word("D8425") == row.format_2);
        CHECK(p.word("D8426") == row.delimiter_2);
        CHECK(p.word("D8439") == row.mode_2);
    }
    const shown_plc small(server_1, fx3g);
    CHECK(small.word("D8406") == 0);  // FX3U and FX3UC only
    CHECK(small.word("D8419") == 9);
}

TEST_CASE("plc: a line of the configuration shows as MODBUS, over power cycles too")
{
    shown_plc p("");
    p.attach(2, role::server);
    CHECK(p.word("D8439") == 9);
    p.power_cycle();
    CHECK(p.word("D8439") == 9);
    CHECK(p.word("D8419") == 0);
    CHECK(p.channel_at(2).as == role::server);
    CHECK_THROWS_AS(p.attach(3, role::server), std::out_of_range);
}

// Without a setup program the line of the configuration stands in the registers where an engineer looks (12.5).
TEST_CASE("plc: a line of the configuration shows in D8400, D8401, D8405 and D8414 of its channel")
{
    const character_format c9600{9600, 8, parity::none, 1};
    const character_format c19200{19200, 8, parity::even, 1};
    struct {
        const char* name;
        std::string moves;
        unsigned channel;
        channel_line line;
        std::uint16_t format, protocol, display, station;
    } const rows[] = {
        {"server", "", 1, {role::server, 17, framing::rtu, true, c19200}, 0x1097, 0x11, 0x1097, 17},
        {"on channel 2", "", 2, {role::server, 247, framing::rtu, false, c9600}, 0x0081, 0x11, 0x0081, 247},
        {"ASCII", "", 2, {role::server, 1, framing::ascii, false, c9600}, 0x0081, 0x111, 0x0081, 1},
        {"client", "", 1, {role::client, 0, framing::rtu, false, c9600}, 0x0081, 0x1, 0x0081, 0},
        {"over TCP", "", 1, {.as = role::client}, 0, 0x1, 0, 0},
        {"the program goes before it",
         server_1,
         1,
         {role::server, 17, framing::rtu, false, c9600},
         0x1097,
         0x11,
         0x0081,
         1},
        {"a refused station", "K248 D8414", 1, {role::server, 17, framing::rtu, false, c9600}, 0, 0, 0, 0},
        {"a rate without code",
         "",
         1,
         {role::server, 5, framing::rtu, false, character_format{14400, 8, parity::none, 1}},
         0,
         0x11,
         0,
         5},
    };
    for (const auto& row : rows)
        for (const bool power : {false, true}) {
            CAPTURE(row.name);
            CAPTURE(power);
            shown_plc p(row.moves);
            p.attach(row.channel, row.line);
            if (power)
                p.power_cycle();
            const bool first = row.channel == 1;
            CHECK(p.word(first ? "D8400" : "D8420") == row.format);
            CHECK(p.word(first ? "D8401" : "D8421") == row.protocol);
            CHECK(p.word(first ? "D8405" : "D8425") == row.display);
            CHECK(p.word(first ? "D8414" : "D8434") == row.station);
            CHECK(p.word(first ? "D8420" : "D8400") == 0);
            CHECK(p.word(first ? "D8434" : "D8414") == 0);
        }
    shown_plc ls("", ls22);
    ls.attach(1, {role::client, 0, framing::rtu, false, c9600});
    ls.attach(3, {role::server, 9, framing::ascii, false, c19200});
    CHECK(ls.word("D8400") == 0xC081);
    CHECK(ls.word("D8413") == 0x5097);
    CHECK(ls.word("D8437") == 9);
    CHECK(ls.word("D8420") == 0);
}

TEST_CASE("plc: what is marked R in 6.1 and 6.3 is the PLC's own, what is marked R, W takes a client's value")
{
    struct {
        const char* one;
        const char* two;
        bool writable;
    } const rows[] = {
        {"D8402", "D8422", true},  {"D8403", "D8423", true},  {"D8404", "D8424", true},  {"D8405", "D8425", false},
        {"D8407", "D8427", false}, {"D8408", "D8428", false}, {"D8409", "D8429", true},  {"D8410", "D8430", true},
        {"D8411", "D8431", true},  {"D8419", "D8439", false}, {"D8063", "D8438", true},  {"M8401", "M8421", false},
        {"M8402", "M8422", true},  {"M8403", "M8423", true},  {"M8063", "M8438", true},  {"M8404", "M8424", false},
        {"M8408", "M8428", false}, {"M8409", "M8429", false}, {"M8029", "M8029", false},
    };
    for (const auto& row : rows)
        for (const char* name : {row.one, row.two}) {
            CAPTURE(name);
            shown_plc p(server_1);
            const bool is_flag = name[0] == 'M';
            const auto value = [&] { return is_flag ? std::uint16_t{p.bit(name)} : p.word(name); };
            const std::uint16_t before = value();
            const auto at = is_flag ? 0x1E00 + parse_device(name)->number - 8000 : parse_device(name)->number;
            const buffer address{static_cast<std::uint8_t>(at >> 8), static_cast<std::uint8_t>(at)};
            const buffer pdu = is_flag ? buffer{0x05, address[0], address[1], 0xFF, 0x00}
                                       : buffer{0x06, address[0], address[1], 0x00, 0x4D};
            CHECK(serve_pdu(p, pdu) == pdu);  // the address exists in the map of 9.3, so it is no error
            CHECK(value() == (row.writable ? (is_flag ? 1 : 77) : before));
        }
    shown_plc ls("", ls22);  // LS manual 4-1: R, W
    ls.set("D8407", 5);
    CHECK(ls.word("D8407") == 5);
    shown_plc server(server_1);
    server.set("D8406", 0x23);
    CHECK(server.word("D8406") == 10);  // "read only in a slave"
    shown_plc client("H1081 D8400, H101 D8401");
    client.set("D8406", 0x23);
    CHECK(client.word("D8406") == 0x23);
}

TEST_CASE("plc: every setting of the program stands in its register, on both channels (12.5)")
{
    struct {
        const char* name;
        const char* value;
        std::uint16_t number;
    } const rows[] = {
        {"D8400", "H1081", 0x1081}, {"D8401", "H1", 1},     {"D8409", "K2000", 2000}, {"D8410", "K300", 300},
        {"D8411", "K10", 10},       {"D8412", "K3", 3},     {"D8414", "K247", 247},   {"D8415", "H101", 0x101},
        {"D8416", "K500", 500},     {"D8420", "H91", 0x91}, {"D8429", "K7", 7},       {"D8430", "K8", 8},
        {"D8431", "K9", 9},         {"D8432", "K20", 20},   {"D8434", "K1", 1},       {"D8435", "H1", 1},
        {"D8436", "K900", 900},     {"D8421", "H0", 0},
    };
    std::string moves;
    for (const auto& row : rows)
        moves += std::string(moves.empty() ? "" : ", ") + row.value + " " + row.name;
    const shown_plc p(moves);
    CHECK(p.faults().empty());
    for (const auto& row : rows) {
        CAPTURE(row.name);
        CHECK(p.word(row.name) == row.number);
    }
}

TEST_CASE("plc: D8470 to D8485 allocate nothing on models without the user's allocation")
{
    for (const plc::model* m : all_models()) {
        if (!m->programs)
            continue;
        CAPTURE(std::string(m->name));
        const shown_plc p("H5002 D8470, K0 D8471", *m);
        const auto coil_0 = p.map().find(p.memory(), modbus::table::coils, modbus::address{0}, 1)->front().at;
        const bool fx3u_kind = m->name == "FX3U" || m->name == "FX3UC";
        CHECK(coil_0 == p.at(fx3u_kind ? "X0" : "M0"));
        CHECK(p.faults().empty());
    }
}

TEST_CASE("plc: settings written without LD M8411 change nothing, and power-on brings the program's back")
{
    shown_plc p(std::string(server_1) + "H1 D8415, K100 D8416, H5002 D8470, K0 D8471");
    for (const char* each : {"D8400", "D8401", "D8412", "D8414", "D8415", "D8416", "D8470", "D8471"})
        p.set(each, 3);
    CHECK(p.word("D8405") == 0x1097);
    CHECK(p.channel_at(1).as == role::server);
    CHECK(p.channel_at(1).status.counters == p.at("D100"));
    const auto coil_0 = [&] {
        return p.map().find(p.memory(), modbus::table::coils, modbus::address{0}, 1)->front().at;
    };
    CHECK(coil_0() == p.at("X0"));
    p.power_cycle();
    CHECK(p.word("D8400") == 0x1097);
    CHECK(p.word("D8401") == 0x11);
    CHECK(p.word("D8412") == 0);
    CHECK(p.word("D8414") == 1);
    CHECK(p.word("D8415") == 1);
    CHECK(p.word("D8416") == 100);
    CHECK(p.word("D8470") == 0x5002);
    CHECK(coil_0() == p.at("X0"));
}

TEST_CASE("plc: error 203, two channels set to MODBUS")
{
    for (const char* second : {"H1097 D8420, H11 D8421, K1 D8434", "H1097 D8420, H1 D8421"}) {
        shown_plc p(std::string(server_1) + second);
        CHECK(p.channel_at(1).operates);
        CHECK_FALSE(p.channel_at(2).operates);
        CHECK(p.word("D8402") == 0);
        CHECK(p.word("D8422") == 203);
        CHECK(p.word("D8423") == 0);
        CHECK(p.word("D8438") == 3821);
        CHECK(p.bit("M8422"));
        CHECK(p.bit("M8423"));
        CHECK(p.bit("M8438"));
        CHECK_FALSE(p.bit("M8402"));
        CHECK_FALSE(p.fault().has_value());  // that is error 202
        REQUIRE(p.faults().size() == 1);
        CHECK(p.faults()[0].code == modbus_error::channel_double_use);
        CHECK(p.faults()[0].channel == 2);
        CHECK(p.faults()[0].what.line == 6);  // MOV H11 D8421
    }
    // A faulty channel 1 has priority all the same.
    shown_plc faulty(std::string("H1097 D8400, H11 D8401, K0 D8414, ") + server_2);
    CHECK(faulty.word("D8402") == 202);
    CHECK(faulty.word("D8422") == 203);
    CHECK_FALSE(faulty.channel_at(1).operates);
    CHECK_FALSE(faulty.channel_at(2).operates);
    const shown_plc refused(std::string("H1097 D8400, H111 D8401, K1 D8414, ") + server_2, fx3g);
    CHECK(refused.word("D8402") == 202);  // no ASCII: its D8401 reads 0
    CHECK(refused.word("D8422") == 203);
    // Other protocols on the other channel, and the LS with its three ports, are fine.
    CHECK(shown_plc(std::string(server_1) + "H1097 D8420, H10 D8421").faults().empty());
    shown_plc ls("H4081 D8400, K1 D8414, H4081 D8420, K2 D8434, H4081 D8413, K3 D8437", ls22);
    CHECK(ls.faults().empty());
    for (const unsigned channel : {1U, 2U, 3U})
        CHECK(ls.channel_at(channel).operates);
}

TEST_CASE("plc: the ranges of D8416, error 202 with its detail")
{
    struct {
        const char* name;
        const char* setup;
        unsigned last;  // the last valid head
    } const rows[] = {
        {"counters in D", "H1", 7990},    {"log in D", "H10", 7967},   {"both in D", "H11", 7957},
        {"counters in R", "H101", 32758}, {"log in R", "H110", 32735}, {"both in R", "H111", 32725},
    };
    for (const auto& row : rows)
        for (const unsigned channel : {1U, 2U})
            for (const unsigned head : {0U, row.last, row.last + 1, 8000U, 8400U, 40000U, 65535U}) {
                CAPTURE(row.name);
                CAPTURE(channel);
                CAPTURE(head);
                const std::string which = channel == 1 ? "1" : "3";
                const std::string moves = std::string(channel == 1 ? server_1 : server_2) + row.setup + " D84" + which +
                                          "5, K" + std::to_string(head) + " D84" + which + "6";
                const shown_plc p(moves);
                const bool valid = head <= row.last;
                const std::uint16_t detail = channel == 1 ? 8416 : 8436;
                CHECK(p.word(channel == 1 ? "D8402" : "D8422") == (valid ? 0 : 202));
                CHECK(p.word(channel == 1 ? "D8403" : "D8423") == (valid ? 0 : detail));
                CHECK(p.word(channel == 1 ? "D8416" : "D8436") == (valid ? head : 0));
                const status_area& area = p.channel_at(channel).status;
                CHECK((area.counters || area.log) == valid);
                CHECK(p.channel_at(channel).operates);
            }
    CHECK(shown_plc(std::string(server_1) + "K9000 D8416").faults().empty());  // nothing is asked for
    CHECK(
        shown_plc(std::string(server_1) + "H11 D8415, K9000 D8416", fx3g).faults().empty());  // not an FX3G's registers
}

TEST_CASE("plc: a fault shows on the channel that it belongs to, the first one of each")
{
    struct {
        const char* name;
        std::string moves;
        std::uint16_t one, two;  // D8403, D8423
    } const rows[] = {
        {"station of 2", "H1097 D8420, H11 D8421, K248 D8434", 0, 8434},
        {"timeout of 2", "K40000 D8429", 0, 8429},
        {"status of both", "H1 D8415, K9000 D8416, H1 D8435, K9000 D8436", 8416, 8436},
        {"an allocation, server on 1", std::string(server_1) + "H0001 D8470, K4 D8471", 8470, 0},
        {"an allocation, server on 2", std::string(server_2) + "H0001 D8470, K4 D8471", 0, 8470},
        {"parity of 1", "H1095 D8400, H11 D8401, K1 D8414", 8400, 0},
        {"format missing", "H11 D8401, K1 D8414", 8400, 0},
        {"two of one", "K0 D8414, H1 D8415, K9000 D8416", 8414, 0},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        const shown_plc p(row.moves);
        CHECK(p.word("D8403") == row.one);
        CHECK(p.word("D8402") == (row.one ? 202 : 0));
        CHECK(p.word("D8423") == row.two);
        CHECK(p.word("D8422") == (row.two ? 202 : 0));
        CHECK(p.bit("M8063") == (row.one != 0));
        CHECK(p.bit("M8438") == (row.two != 0));
    }
    const shown_plc ascii("H1097 D8400, H111 D8401, K1 D8414", fx3g);  // ASCII is not an FX3G's
    CHECK(ascii.word("D8402") == 202);
    CHECK(ascii.word("D8403") == 8401);
    CHECK(ascii.word("D8401") == 0);
    const shown_plc ls("H4081 D8413, K248 D8437", ls22);  // no register to show it, but a fault
    REQUIRE(ls.fault().has_value());
    CHECK(ls.fault()->detail == 8437);
    CHECK_FALSE(ls.channel_at(3).operates);
    CHECK(ls.word("D8402") == 0);
}

TEST_CASE("plc: a void block disables MODBUS, a wrong D8411 does not")
{
    auto voided = parse_setup_program("LD M8411\nMOV H1097 D8400\nAND M0\nMOV H11 D8401\n");
    const simulated_plc p("main", fx3u, std::move(voided));
    CHECK_FALSE(p.channel_at(1).operates);
    CHECK_FALSE(p.channel_at(2).operates);
    const shown_plc delay(std::string(server_1) + "K16383 D8411");
    CHECK(delay.word("D8403") == 8411);
    CHECK(delay.channel_at(1).operates);
}

TEST_SUITE_END();
