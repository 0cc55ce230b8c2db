// The communication unit of an FP7 in virtual time: contacts of 4.1, words of PMGET (10.3.2), channel reset (9.4.3).
#include "bridge/plc/models/fp7.hpp"
#include "bridge/services/fp7_unit.hpp"
#include "tests/support/print.hpp"

#include <array>
#include <stdexcept>
#include <string>

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using namespace plcgw::plc;
using namespace std::chrono_literals;

namespace {

constexpr time_point t0{1h};
constexpr duration scan = 10ms;

using coms = std::vector<unsigned>;

class bench {
public:
    explicit bench(com_mode mode = com_mode::general_purpose)
    {
        for (const unsigned com : {0U, 1U, 2U})
            unit.open(t0, com, {.mode = mode}, com_card::rs485);
        plc.memory().take_changes();
    }

    place at(const std::string& device) const { return plc.memory().find(*parse_device(device, fp7.names)).value(); }
    bool is(const std::string& contact) const { return plc.memory().bit(at(contact)); }
    void set(const std::string& contact, bool on) { plc.memory().set_bit(at(contact), on); }
    unsigned word(const std::string& device) const { return plc.memory().word(at(device)); }

    // The contacts of one row that are on: "X8 XA".
    std::string on() const
    {
        std::string text;
        for (const device_kind kind : {device_kind::x, device_kind::y})
            for (std::uint32_t i = 0; i < 32; ++i)
                if (plc.memory().bit(*plc.memory().find({kind, i})))
                    text.append(text.empty() ? "" : " ").append(to_string(device{kind, i}, fp7.names));
        return text;
    }

    simulated_plc plc{"panel", fp7, {}};
    fp7_unit unit{plc, scan};
};

struct port_row {
    unsigned com;
    const char* message_waits;
    const char* copied;
    const char* general;
    const char* master;
    const char* done;
    const char* failed;
    const char* general_sending;
    const char* master_sending;
    const char* request;
};

// Tables of 4.1.1.
constexpr port_row ports[] = {
    {1, "X0", "X4", "X8", "XC", "X10", "Y0", "Y8", "YC", "Y10"},
    {2, "X1", "X5", "X9", "XD", "X11", "Y1", "Y9", "YD", "Y11"},
    {0, "X2", "X6", "XA", "XE", "X12", "Y2", "YA", "YE", "Y12"},
};

}  // namespace

TEST_CASE("fp7 unit: the mode of each port shows who may send")
{
    CHECK(bench(com_mode::general_purpose).on() == "X8 X9 XA");
    CHECK(bench(com_mode::mewtocol_com).on() == "XC XD XE");
    CHECK(bench(com_mode::mewtocol7_com).on() == "XC XD XE");
    CHECK(bench(com_mode::modbus_rtu).on() == "XC XD XE");
    CHECK(bench(com_mode::plc_link).on() == "");
}

TEST_CASE("fp7 unit: a master can send in RUN only")
{
    bench b(com_mode::modbus_rtu);
    b.plc.stop();
    CHECK(b.unit.run(t0).empty());
    CHECK(b.on() == "");
    b.plc.run();
    b.unit.run(t0);
    CHECK(b.on() == "XC XD XE");
}

TEST_CASE("fp7 unit: each port has its own contacts")
{
    for (const port_row& row : ports) {
        CAPTURE(row.com);
        bench b;
        b.unit.show(t0, row.com, {.message_waits = true, .sending = true, .send_failed = true});
        CHECK(b.on() == std::string(row.message_waits) + " X8 X9 XA " + row.failed + " " + row.general_sending);
        bench master(com_mode::mewtocol_com);
        master.unit.show(t0, row.com, {.message_waits = true, .sending = true});
        CHECK(master.on() == std::string("XC XD XE ") + row.master_sending);
    }
}

TEST_CASE("fp7 unit: a copied message shows for one scan, and its waiting flag goes with it")
{
    bench b;
    b.unit.show(t0, 1, {.message_waits = true});
    CHECK(b.is("X0"));
    CHECK_FALSE(b.unit.deadline().has_value());
    b.unit.copied(t0 + 1ms, 1);
    b.unit.show(t0 + 1ms, 1, {});
    CHECK(b.is("X4"));
    CHECK(b.is("X0"));
    CHECK(b.unit.deadline() == t0 + 1ms + scan);
    b.unit.run(t0 + scan);
    CHECK(b.is("X4"));
    b.unit.run(t0 + 1ms + scan);
    CHECK_FALSE(b.is("X4"));
    CHECK_FALSE(b.is("X0"));
    CHECK_FALSE(b.unit.deadline().has_value());
}

TEST_CASE("fp7 unit: with another message in the buffers the waiting flag stays")
{
    bench b;
    b.unit.show(t0, 1, {.message_waits = true});
    b.unit.copied(t0, 1);
    b.unit.run(t0 + scan);
    CHECK_FALSE(b.is("X4"));
    CHECK(b.is("X0"));
}

TEST_CASE("fp7 unit: sending shows for one scan at least")
{
    bench b;
    b.unit.show(t0, 2, {.sending = true});
    b.unit.show(t0 + 1ms, 2, {});
    CHECK(b.is("Y9"));
    CHECK(b.unit.deadline() == t0 + scan);
    b.unit.run(t0 + scan - 1us);
    CHECK(b.is("Y9"));
    b.unit.run(t0 + scan);
    CHECK_FALSE(b.is("Y9"));

    b.unit.show(t0 + 1s, 2, {.sending = true});
    b.unit.run(t0 + 2s);
    CHECK(b.is("Y9"));  // a long one
    b.unit.show(t0 + 3s, 2, {.send_failed = true});
    CHECK_FALSE(b.is("Y9"));
    CHECK(b.is("Y1"));
}

TEST_CASE("fp7 unit: sending shows as long as the message is on the line")
{
    bench b;
    b.unit.show(t0, 1, {.sending = true});
    b.unit.sends(t0 + 1ms, 1, t0 + 500ms);
    b.unit.show(t0 + 1ms, 1, {});
    CHECK(b.is("Y8"));
    CHECK(b.unit.deadline() == t0 + 500ms);
    b.unit.run(t0 + 499ms);
    CHECK(b.is("Y8"));
    b.unit.run(t0 + 500ms);
    CHECK_FALSE(b.is("Y8"));

    b.unit.sends(t0 + 1s, 1, t0 + 1s + 1us);  // 9.3.1, note 2: for a scan at least
    CHECK(b.unit.deadline() == t0 + 1s + scan);
    b.set("Y10", true);
    b.unit.run(t0 + 1s);
    b.unit.reset_done(t0 + 1s, 1);
    CHECK(b.on() == "X8 X9 XA X10 Y10");  // 4.1: a reset ends it
}

TEST_CASE("fp7 unit: a reset is requested by the rising edge alone, and stands done until the request falls")
{
    for (const port_row& row : ports) {
        CAPTURE(row.com);
        bench b;
        b.unit.show(t0, row.com, {.message_waits = true, .sending = true, .send_failed = true});
        b.unit.note(row.com, receive_error::buffers_full);
        CHECK(b.unit.run(t0).empty());
        b.set(row.request, true);
        CHECK(b.unit.run(t0 + 1ms) == coms{row.com});
        CHECK(b.unit.run(t0 + 2ms).empty());  // still on: one action for one edge
        CHECK_FALSE(b.is(row.done));
        b.unit.reset_done(t0 + 3ms, row.com);
        CHECK(b.on() == std::string("X8 X9 XA ") + row.done + " " + row.request);
        CHECK(b.unit.monitor(row.com).receive_errors == 0);
        CHECK(b.unit.run(t0 + 4ms).empty());
        CHECK(b.is(row.done));
        b.set(row.request, false);
        CHECK(b.unit.run(t0 + 5ms).empty());
        CHECK(b.on() == "X8 X9 XA");
        b.set(row.request, true);
        CHECK(b.unit.run(t0 + 6ms) == coms{row.com});
    }
}

TEST_CASE("fp7 unit: a request that falls before the reset is done leaves no sign behind")
{
    bench b(com_mode::modbus_rtu);  // 10.4.1 names no mode: errors can be cleared in all
    b.set("Y10", true);
    CHECK(b.unit.run(t0) == coms{1});
    b.set("Y10", false);
    CHECK(b.unit.run(t0).empty());
    b.unit.reset_done(t0, 1);
    CHECK_FALSE(b.is("X10"));
    b.set("Y10", true);
    b.set("Y12", true);
    CHECK(b.unit.run(t0) == coms{0, 1});
}

TEST_CASE("fp7 unit: what somebody else writes into the contacts is put right, the program's own stay")
{
    bench b;
    for (const char* contact : {"X0", "X4", "X10", "Y0", "Y8", "YC", "Y14"})
        b.set(contact, true);
    CHECK(b.unit.run(t0).empty());
    CHECK(b.on() == "X8 X9 XA Y14");
    CHECK(b.unit.rts_off(1));
    CHECK_FALSE(b.unit.rts_off(2));
}

TEST_CASE("fp7 unit: CTS shows on COM.1 with RS/CS")
{
    bench b;
    b.unit.show(t0, 1, {.cts_off = true});
    CHECK_FALSE(b.is("X14"));
    b.unit.open(t0, 1, {.mode = com_mode::general_purpose, .rs_cs = true}, com_card::rs232c);
    b.unit.show(t0, 1, {.cts_off = true});
    CHECK(b.is("X14"));
    b.unit.reset_done(t0, 1);
    CHECK(b.is("X14"));  // the other side did not change
    b.unit.show(t0, 1, {});
    CHECK_FALSE(b.is("X14"));
}

TEST_CASE("fp7 unit: parameters of PMGET in 26 words")
{
    bench b;
    b.unit.open(t0, 2,
                {.mode = com_mode::general_purpose,
                 .station = 999,
                 .format = {230400, 7, parity::even, 2},
                 .rs_cs = true,
                 .send_wait = 100ms,
                 .start = start_code::stx,
                 .end = end_code::silence,
                 .end_silence = 10us},
                com_card::rs232c);
    constexpr unsigned expected[26] = {8, 999, 10, 0, 2, 1, 1, 10000, 1, 2, 1};  // D+11 and what follows: 0
    for (unsigned i = 0; i < 26; ++i) {
        CAPTURE(i);
        CHECK(b.word("UM" + std::to_string(200 + i)) == expected[i]);
    }
    // 5.1.2, initial values: 9600 bit/s, 8 bits, odd, 1 stop bit, CR.
    const auto initial = parameter_words({});
    CHECK(std::vector<std::uint16_t>(initial.begin(), initial.begin() + 11) ==
          std::vector<std::uint16_t>{0, 1, 5, 1, 1, 0, 0, 0, 0, 0, 0});
    CHECK(parameter_words({.format = {.baud_rate = 250000}})[2] == 0xFFFF);
    CHECK(parameter_words({.send_wait = 2s})[7] == 10000);
}

TEST_CASE("fp7 unit: the settings of a PLC link show on a port in that mode only")
{
    const plc_link_settings link{1, 0, 50, 100, 20, 10, 40, 30};
    const auto words = parameter_words({.mode = com_mode::plc_link, .station = 2, .link = link});
    const unsigned expected[8] = {1, 16, 50, 100, 20, 10, 40, 30};  // a highest station of 0 counts as 16
    for (std::size_t i = 0; i < 8; ++i)
        CHECK(words[14 + i] == expected[i]);
    const auto other = parameter_words({.mode = com_mode::mewtocol_com, .link = link});
    for (std::size_t i = 11; i < 26; ++i)
        CHECK(other[i] == 0);
}

TEST_CASE("fp7 unit: monitor information of PMGET in 7 words")
{
    bench b;
    const auto words = [&] {
        std::array<unsigned, 7> all{};
        for (unsigned i = 0; i < 7; ++i)
            all[i] = b.word("UM" + std::to_string(150 + i));
        return all;
    };
    CHECK(words() == std::array<unsigned, 7>{8, 485, 0, 0, 0, 0, 0});
    b.unit.note(1, receive_error::parity);
    b.unit.note(1, receive_error::framing);
    b.unit.note(1, receive_error::overrun);
    CHECK(words() == std::array<unsigned, 7>{8, 485, 0b111, 3, 0, 0, 0});
    b.unit.note(1, receive_error::buffer_overrun);  // errors of the high byte are not counted
    b.unit.note(1, receive_error::buffers_full);
    CHECK(words() == std::array<unsigned, 7>{8, 485, 0x307, 3, 0, 0, 0});
    b.unit.note(1, setting_error::parameters, 3);
    b.unit.note(1, setting_error::send_count);
    CHECK(words() == std::array<unsigned, 7>{8, 485, 0x307, 3, 0x300, 3, 0});
    b.unit.reset_done(t0, 1);
    CHECK(words() == std::array<unsigned, 7>{8, 485, 0, 0, 0x100, 3, 0});  // a wrong setting is not cleared
}

TEST_CASE("fp7 unit: errors are counted round and round")
{
    com_monitor m;
    m.receive_error_count = 0xFFFF;
    note(m, receive_error::parity);
    CHECK(m.receive_error_count == 0);
    CHECK(m.receive_errors == 0b100);
}

TEST_CASE("fp7 unit: after power-on everything is shown again, errors are gone and the request is a new one")
{
    bench b;
    b.set("Y11", true);
    CHECK(b.unit.run(t0) == coms{2});
    b.unit.reset_done(t0, 2);
    b.unit.note(2, receive_error::parity);
    b.plc.power_cycle();
    CHECK(b.on() == "");
    CHECK(b.unit.run(t0).empty());
    CHECK(b.on() == "X8 X9 XA");
    CHECK(b.word("UM200") == 8);
    CHECK(b.word("UM252") == 0);
    b.set("Y11", true);
    CHECK(b.unit.run(t0) == coms{2});
}

TEST_CASE("fp7 unit: nothing is written that is not new")
{
    bench b;
    b.unit.run(t0);
    b.unit.show(t0, 1, {});
    CHECK_FALSE(b.plc.memory().has_changes());
}

TEST_CASE("fp7 unit: only an FP7 has one, with COM.0 to COM.2, and a port must be open")
{
    simulated_plc fx("main", *find_model("FX3U"), {});
    CHECK_THROWS_AS(fp7_unit{fx}, std::invalid_argument);
    simulated_plc plc("panel", fp7, {});
    fp7_unit unit(plc);
    CHECK_THROWS_AS(unit.open(t0, 3, {}, com_card::none), std::out_of_range);
    CHECK_THROWS_AS(unit.show(t0, 1, {}), std::out_of_range);
}

TEST_SUITE_END();
