#include "tests/unit/adprw_fixture.hpp"

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using plcgw::plc::modbus_error;
using plcgw::test::adprw_fixture;
using plcgw::test::preset;

namespace {

constexpr const char* question = "ADPRW H5 H3 H0 K1 D100";

struct row {
    const char* name;
    plc::adprw_outcome outcome;
    std::uint16_t code;     // D8402
    std::uint16_t details;  // D8403
    std::uint16_t ls_code;  // D8402 of an LS
};

plc::adprw_outcome failure(modbus_error why, std::uint8_t received = 0) { return plc::adprw_failure{why, received}; }
plc::adprw_outcome exception(std::uint8_t code) { return modbus::response{modbus::exception_code{code}}; }

// The question is function 03 to unit 5.
const row rows[] = {
    {"no port", failure(modbus_error::invalid_hardware), 201, 1, 211},
    {"bit error", failure(modbus_error::bit_level), 204, 0, 204},
    {"CRC or LRC", failure(modbus_error::checksum), 205, 0, 205},
    {"too long", failure(modbus_error::character_overrun), 206, 0, 206},
    {"length", failure(modbus_error::length_mismatch), 207, 0, 207},
    {"no hexadecimal digit", failure(modbus_error::unconvertible_character), 208, 0, 207},
    {"timeout", failure(modbus_error::timeout), 211, 0, 211},
    {"exception 01", exception(1), 212, 0x8301, 20301},
    {"exception 02", exception(2), 212, 0x8302, 20302},
    {"exception 0B", exception(0x0B), 212, 0x830B, 20311},
    {"unit", failure(modbus_error::station_mismatch, 17), 213, 0x0511, 30517},
    {"unit above 99", failure(modbus_error::station_mismatch, 247), 213, 0x05F7, 30547},
    {"function", failure(modbus_error::function_mismatch, 0x10), 214, 0x0310, 40316},
    {"exception of another function", failure(modbus_error::function_mismatch, 0x90), 214, 0x0390, 40316},
};

}  // namespace

TEST_CASE("adprw errors: flags and codes of a failed exchange on channel 1")
{
    for (const row& r : rows) {
        CAPTURE(r.name);
        auto f = adprw_fixture::always(question);
        f.set("D100", 77);
        REQUIRE_FALSE(f.next().empty());
        f.finish(r.outcome);
        f.check({{"D100", 77},
                 {"M8401", 0},
                 {"M8029", 1},
                 {"M8402", 1},
                 {"M8403", 1},
                 {"M8408", 0},
                 {"M8409", r.code == 211},
                 {"M8063", 1},
                 {"M8067", 0},
                 {"D8402", r.code},
                 {"D8403", r.details},
                 {"D8404", 1},
                 {"D8407", 1},
                 {"D8408", 0},
                 {"D8063", 6321},
                 {"D8067", 0},
                 {"D8422", 0},
                 {"M8422", 0}});
    }
}

TEST_CASE("adprw errors: the same on channel 2")
{
    for (const row& r : rows) {
        CAPTURE(r.name);
        adprw_fixture f(std::string("LD M8000\n") + question, "FX3U", 2);
        REQUIRE_FALSE(f.next().empty());
        f.check({{"M8421", 1}, {"M8401", 0}, {"D8427", 1}});
        f.finish(r.outcome);
        f.check({{"M8421", 0},
                 {"M8029", 1},
                 {"M8422", 1},
                 {"M8423", 1},
                 {"M8428", 0},
                 {"M8429", r.code == 211},
                 {"M8438", 1},
                 {"D8422", r.code},
                 {"D8423", r.code == 201 ? std::uint16_t{2} : r.details},
                 {"D8424", 1},
                 {"D8438", 3821},
                 {"D8402", 0},
                 {"M8402", 0},
                 {"D8063", 0},
                 {"M8063", 0}});
    }
}

TEST_CASE("adprw errors: an LS puts the details into D8402")
{
    for (const row& r : rows) {
        CAPTURE(r.name);
        auto f = adprw_fixture::always(question, "LS32");
        REQUIRE_FALSE(f.next().empty());
        f.finish(r.outcome);
        f.check({{"M8401", 0},
                 {"M8029", 1},
                 {"M8402", 1},
                 {"M8403", 1},
                 {"M8409", r.ls_code == 211},
                 {"D8402", r.ls_code},
                 {"D8403", 0},
                 {"D8404", 1},
                 {"D8407", 1},
                 {"D8063", 0},
                 {"M8063", 0}});
    }
}

TEST_CASE("adprw errors: composed codes have two decimal digits for each detail")
{
    using plc::adprw_error;
    const auto code = [](const adprw_error& e) { return static_cast<unsigned>(plc::ls_error(e)); };
    CHECK(code({modbus_error::exception_response, 0x83, 0x02}) == 20302);
    CHECK(code({modbus_error::exception_response, 0x90, 0x0A}) == 21610);
    CHECK(code({modbus_error::exception_response, 0x97, 0x04}) == 22304);
    CHECK(code({modbus_error::station_mismatch, 1, 99}) == 30199);
    CHECK(code({modbus_error::station_mismatch, 247, 100}) == 34700);
    CHECK(code({modbus_error::function_mismatch, 0x0F, 0x06}) == 41506);
    for (std::uint8_t operand = 1; operand <= 5; ++operand)
        CHECK(code({modbus_error::bad_operand, 0, operand}) == 2180U + operand);
}

TEST_CASE("adprw errors: an LS refuses an operand with 218x and no operation error")
{
    const char* const lines[] = {"ADPRW K248 H3 H0 K1 D0", "ADPRW K1 H7 H0 K0 D0", "ADPRW K1 H3 M0 K1 D0",
                                 "ADPRW K1 H3 H0 K126 D0", "ADPRW K1 H3 H0 K1 M0"};
    for (std::uint16_t i = 0; i < 5; ++i) {
        CAPTURE(lines[i]);
        auto f = adprw_fixture::always(lines[i], "LS22");
        CHECK(f.next().empty());
        f.check({{"D8402", static_cast<std::uint16_t>(2181 + i)},
                 {"M8402", 1},
                 {"M8403", 1},
                 {"M8067", 0},
                 {"D8067", 0},
                 {"D8404", 1}});
    }
}

TEST_CASE("adprw errors: 218 with the operand's number, and the operation error")
{
    auto f = adprw_fixture::always("ADPRW K1 H3 H0 K126 D0");
    CHECK(f.next().empty());
    f.check({{"M8402", 1},
             {"M8403", 1},
             {"M8063", 1},
             {"M8067", 1},
             {"M8029", 0},
             {"M8401", 0},
             {"M8409", 0},
             {"D8402", 218},
             {"D8403", 4},
             {"D8404", 1},
             {"D8407", 0},
             {"D8063", 6321},
             {"D8067", 6706}});

    auto wrong = adprw_fixture::always("ADPRW K1 H3 H0 K1 M0");
    CHECK(wrong.next().empty());
    wrong.check({{"D8402", 218}, {"D8403", 5}, {"D8067", 6705}});
}

TEST_CASE("adprw errors: 217 in a server")
{
    adprw_fixture f("LD M8411\nMOV H1097 D8400\nMOV H11 D8401\nMOV K1 D8414\nLD M8000\nADPRW H5 H3 H0 K1 D0");
    CHECK(f.next().empty());
    f.check({{"M8402", 1},
             {"M8403", 1},
             {"M8063", 1},
             {"M8401", 0},
             {"M8029", 0},
             {"M8067", 0},
             {"D8402", 217},
             {"D8403", 0},
             {"D8404", 17},
             {"D8063", 6321}});

    adprw_fixture second("LD M8411\nMOV H1097 D8420\nMOV H11 D8421\nMOV K1 D8434\nLD M8000\nADPRW H5 H3 H0 K1 D0",
                         "FX3U", 2);
    CHECK(second.next().empty());
    second.check({{"D8422", 217}, {"D8402", 0}});

    adprw_fixture client("LD M8411\nMOV H1097 D8400\nMOV H1 D8401\nLD M8000\nADPRW H5 H3 H0 K1 D0");
    CHECK_FALSE(client.next().empty());
}

TEST_CASE("adprw errors: an LS that is a server by its format asks nothing")
{
    adprw_fixture server("LD M8411\nMOV H4081 D8400\nMOV K1 D8414\nLD M8000\nADPRW H5 H3 H0 K1 D0", "LS32");
    CHECK(server.next().empty());
    adprw_fixture client("LD M8411\nMOV HC081 D8400\nLD M8000\nADPRW H5 H3 H0 K1 D0", "LS32");
    CHECK_FALSE(client.next().empty());
}

TEST_CASE("adprw errors: the next command clears M8402, M8408, M8409, M8029 and D8408, and nothing else")
{
    auto f = adprw_fixture::always(question);
    f.set("D8412", 2);
    REQUIRE_FALSE(f.next().empty());
    f.check({{"M8408", 0}, {"D8408", 0}});
    f.no_answer();
    f.check({{"M8408", 1}, {"D8408", 1}, {"M8409", 0}, {"M8402", 0}, {"M8401", 1}, {"M8029", 0}});
    f.no_answer();
    f.check({{"M8408", 1}, {"D8408", 2}, {"M8409", 0}, {"M8402", 0}});
    f.no_answer();  // the last one
    f.check({{"M8408", 1}, {"D8408", 2}, {"M8409", 0}, {"M8402", 0}});
    f.fail(modbus_error::timeout);
    f.check({{"M8408", 1}, {"D8408", 2}, {"M8409", 1}, {"M8402", 1}, {"M8029", 1}});

    REQUIRE_FALSE(f.next().empty());
    f.check({{"M8401", 1},
             {"M8402", 0},
             {"M8408", 0},
             {"M8409", 0},
             {"M8029", 0},
             {"D8408", 0},
             {"M8403", 1},
             {"M8063", 1},
             {"D8402", 211},
             {"D8404", 1},
             {"D8407", 1},
             {"D8063", 6321}});
    f.answer({0x03, 0x02, 0x00, 0x07});
    f.check({{"M8402", 0}, {"M8403", 1}, {"D8402", 211}, {"M8029", 1}, {"D100", 7}});
}

TEST_CASE("adprw errors: a retry that is answered leaves M8408 and no error")
{
    auto f = adprw_fixture::always(question);
    f.set("D8412", 2);
    REQUIRE_FALSE(f.next().empty());
    f.no_answer();
    f.answer({0x03, 0x02, 0x00, 0x07});
    f.check({{"M8408", 1}, {"D8408", 1}, {"M8402", 0}, {"M8403", 0}, {"M8409", 0}, {"D8402", 0}, {"M8029", 1}});
}

TEST_CASE("adprw errors: an LS unlatches M8403 with the next command")
{
    auto f = adprw_fixture::always(question, "LS22");
    REQUIRE_FALSE(f.next().empty());
    f.fail(modbus_error::timeout);
    f.check({{"M8403", 1}, {"D8402", 211}});
    REQUIRE_FALSE(f.next().empty());
    f.check({{"M8403", 0}, {"M8402", 0}, {"D8402", 211}});
}

TEST_CASE("adprw errors: D8404 keeps the step of the first error, D8402 has the current one")
{
    adprw_fixture f("LD M8000\nADPRW H1 H3 H0 K1 D0\nADPRW H2 H3 H0 K1 D1\n");
    f.next();
    f.answer({0x03, 0x02, 0x00, 0x07});
    f.next();
    f.check({{"D8407", 12}});
    f.fail(modbus_error::checksum);
    f.check({{"D8402", 205}, {"D8404", 12}});
    f.next();
    f.check({{"D8407", 1}});
    f.fail(modbus_error::timeout);
    f.check({{"D8402", 211}, {"D8404", 12}, {"D8407", 1}});
    f.set("D8404", 0);  // R,W: a program begins anew
    f.next();
    f.answer({0x83, 0x02});
    f.check({{"D8402", 212}, {"D8403", 0x8302}, {"D8404", 12}});
}

TEST_CASE("adprw errors: a step above 32767 shows as it is in 16 bits")
{
    adprw_fixture f("LD M8000\n40000 ADPRW H1 H3 H0 K1 D0\n");
    f.next();
    f.fail(modbus_error::timeout);
    f.check({{"D8404", 40000}, {"D8407", 40000}});
}

TEST_CASE("adprw errors: STOP to RUN clears them all, but D8063")
{
    adprw_fixture f("LD M8000\nADPRW K300 H3 H0 K1 D0\nADPRW H5 H3 H0 K1 D100\n");
    f.set("D8412", 1);
    f.next();
    f.no_answer();
    f.no_answer();
    f.fail(modbus_error::timeout);
    f.check({{"M8067", 1}, {"D8067", 6706}, {"M8403", 1}, {"M8408", 1}});
    f.plc.stop();
    f.runner.scan();
    f.check({{"M8067", 1}, {"M8403", 1}, {"D8402", 211}});
    f.plc.run();
    f.runner.scan();
    f.check({{"M8029", 0},
             {"M8401", 0},
             {"M8402", 0},
             {"M8403", 0},
             {"M8063", 0},
             {"M8067", 0},
             {"M8408", 0},
             {"M8409", 0},
             {"D8402", 0},
             {"D8403", 0},
             {"D8404", 0},
             {"D8407", 0},
             {"D8408", 0},
             {"D8067", 0},
             {"D8063", 6321}});
}

TEST_CASE("adprw errors: power-on clears them, and leaves what the setup program is blamed for")
{
    adprw_fixture f("LD M8411\nMOV K248 D8414\nLD M8000\nADPRW H5 H3 H0 K1 D100\n");
    f.check({{"D8402", 202}, {"D8403", 8414}});
    f.next();
    f.fail(modbus_error::timeout);
    f.check({{"D8402", 211}, {"D8407", 7}});
    f.plc.power_cycle();
    f.runner.scan();
    f.check({{"D8402", 202}, {"D8403", 8414}, {"D8404", 0}, {"D8407", 0}, {"D8408", 0}, {"M8409", 0}, {"M8029", 0}});
}

TEST_CASE("adprw errors: what a client's failure stands for")
{
    using modbus::frame;
    using modbus::unit_id;
    const modbus::request read = modbus::read_table{modbus::table::holding_registers, {}, 1};
    const auto code = [&](boost::system::error_code why, std::optional<frame> received = {}) {
        return plc::failure_of(why, unit_id{5}, read, received);
    };
    CHECK(code(errc::timed_out) == plc::adprw_failure{modbus_error::timeout});
    CHECK(code(errc::bad_checksum) == plc::adprw_failure{modbus_error::checksum});
    CHECK(code(errc::bad_header) == plc::adprw_failure{modbus_error::checksum});
    CHECK(code(errc::incomplete) == plc::adprw_failure{modbus_error::checksum});  // what came has no CRC that fits
    CHECK(code(errc::too_short) == plc::adprw_failure{modbus_error::checksum});
    CHECK(code(errc::overlong) == plc::adprw_failure{modbus_error::character_overrun});
    CHECK(code(errc::bad_character) == plc::adprw_failure{modbus_error::unconvertible_character});
    CHECK(code(errc::collision) == plc::adprw_failure{modbus_error::bit_level});
    CHECK(code(errc::line_not_quiet) == plc::adprw_failure{modbus_error::character_overrun});
    CHECK(code(errc::port_absent) == plc::adprw_failure{modbus_error::invalid_hardware});
    CHECK(code(errc::unexpected_answer) == plc::adprw_failure{modbus_error::length_mismatch});
    CHECK(code(errc::unexpected_answer, frame{unit_id{6}, {0x03}}) ==
          plc::adprw_failure{modbus_error::station_mismatch, 6});
    CHECK(code(errc::unexpected_answer, frame{unit_id{5}, {0x04}}) ==
          plc::adprw_failure{modbus_error::function_mismatch, 4});
    CHECK(code(errc::unexpected_answer, frame{unit_id{5}, {0x84, 0x02}}) ==
          plc::adprw_failure{modbus_error::function_mismatch, 0x84});
    CHECK(code(errc::unexpected_answer, frame{unit_id{5}, {0x03, 0x04}}) ==
          plc::adprw_failure{modbus_error::length_mismatch});
    CHECK(code(errc::unexpected_answer, frame{unit_id{5}, {}}) == plc::adprw_failure{modbus_error::length_mismatch});
    CHECK(code(make_error_code(boost::system::errc::connection_reset)) ==
          plc::adprw_failure{modbus_error::invalid_hardware});
}

TEST_SUITE_END();
