// The communication counters of a client, FX3 manual 6.4: what its ADPRW instructions got from the line.
#include "tests/unit/adprw_fixture.hpp"

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using plcgw::plc::modbus_error;
using plcgw::test::adprw_fixture;

namespace {

constexpr const char* in_d100 = "LD M8411\nMOV H1097 D8400\nMOV H1 D8401\nMOV K2 D8412\nMOV H1 D8415\nMOV K100 D8416\n"
                                "LD M8000\nADPRW H5 H3 H0 K1 D0\n";

// D100 to D109: messages, communication errors, exceptions, and at 7 overruns.
std::vector<unsigned> shown(const adprw_fixture& f)
{
    std::vector<unsigned> all;
    for (unsigned i = 100; i < 110; ++i)
        all.push_back(f.read(("D" + std::to_string(i)).c_str()));
    return all;
}

using counts = std::vector<unsigned>;

}  // namespace

TEST_CASE("adprw counters: what each of them counts in a client")
{
    adprw_fixture f(in_d100);
    CHECK(shown(f) == counts(10));
    f.next();
    f.answer({0x03, 0x02, 0x00, 0x07});
    CHECK(shown(f) == counts{1, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    f.next();
    f.answer({0x83, 0x02});  // an exception is a message, too
    CHECK(shown(f) == counts{2, 0, 1, 0, 0, 0, 0, 0, 0, 0});

    struct {
        errc why;
        counts after;
    } const rows[] = {
        {errc::timed_out, {2, 0, 1, 0, 0, 0, 0, 0, 0, 0}},  // nothing came
        {errc::bad_checksum, {2, 1, 1, 0, 0, 0, 0, 0, 0, 0}},
        {errc::too_short, {2, 2, 1, 0, 0, 0, 0, 0, 0, 0}},
        {errc::incomplete, {2, 3, 1, 0, 0, 0, 0, 0, 0, 0}},
        {errc::bad_header, {2, 4, 1, 0, 0, 0, 0, 0, 0, 0}},
        {errc::bad_character, {2, 5, 1, 0, 0, 0, 0, 0, 0, 0}},
        {errc::collision, {2, 6, 1, 0, 0, 0, 0, 0, 0, 0}},
        {errc::overlong, {2, 6, 1, 0, 0, 0, 0, 1, 0, 0}},
        {errc::line_not_quiet, {2, 6, 1, 0, 0, 0, 0, 2, 0, 0}},
        {errc::unexpected_answer, {3, 6, 1, 0, 0, 0, 0, 2, 0, 0}},  // whole, but of somebody else
        {errc::port_absent, {3, 6, 1, 0, 0, 0, 0, 2, 0, 0}},
    };
    for (const auto& row : rows) {
        CAPTURE(make_error_code(row.why).message());
        f.next();
        f.no_answer(row.why);
        CHECK(shown(f) == row.after);  // as it happens, not at the end
        f.fail(modbus_error::timeout);
        CHECK(shown(f) == row.after);
    }
}

TEST_CASE("adprw counters: a broadcast is no received message, a malformed answer is one")
{
    adprw_fixture f(std::string(in_d100) + "ADPRW H0 H6 H0 K0 D5\n");
    f.next();
    f.answer({0x03, 0x02, 0x00, 0x07});
    REQUIRE(f.next()[0] == 0);
    f.finish(modbus::response{modbus::no_response{}});
    CHECK(shown(f)[0] == 1);
    f.next();
    f.finish(modbus::response{modbus::bits_read{}});
    f.check({{"D100", 2}, {"D8402", 207}});
}

TEST_CASE("adprw counters: STOP -> RUN and power-on clear them, in latched devices too (6.4)")
{
    for (const bool power : {false, true}) {
        adprw_fixture f(in_d100);
        f.next();
        f.no_answer(errc::bad_checksum);
        f.answer({0x03, 0x02, 0x00, 0x07});
        f.plc.stop();
        f.runner.scan();
        CHECK(shown(f) == counts{1, 1, 0, 0, 0, 0, 0, 0, 0, 0});
        if (power)
            f.plc.power_cycle();
        f.plc.run();
        CHECK(shown(f) == counts(10));  // at once
        f.next();
        f.answer({0x03, 0x02, 0x00, 0x07});
        CHECK(shown(f) == counts{1, 0, 0, 0, 0, 0, 0, 0, 0, 0});  // and they begin at 0
    }
}

TEST_CASE("adprw counters: in R, on channel 2, and nowhere when not asked for")
{
    adprw_fixture second("LD M8411\nMOV H1097 D8420\nMOV H1 D8421\nMOV H101 D8435\nMOV K200 D8436\n"
                         "LD M8000\nADPRW H5 H3 H0 K1 D0\n",
                         "FX3U", 2);
    second.next();
    second.answer({0x83, 0x02});
    second.check({{"R200", 1}, {"R201", 0}, {"R202", 1}, {"R209", 0}, {"D200", 0}});

    adprw_fixture none("LD M8411\nMOV H1097 D8400\nMOV H1 D8401\nMOV K100 D8416\nLD M8000\nADPRW H5 H3 H0 K1 D0\n");
    none.next();
    none.plc.memory().take_changes();
    none.no_answer(errc::bad_checksum);
    CHECK_FALSE(none.plc.memory().has_changes());
}

TEST_CASE("adprw counters: an answer after STOP counts nowhere")
{
    adprw_fixture f(in_d100);
    f.next();
    f.plc.stop();
    f.no_answer(errc::bad_checksum);
    f.answer({0x03, 0x02, 0x00, 0x07});
    CHECK(shown(f) == counts(10));
}

TEST_SUITE_END();
