#include "tests/unit/adprw_fixture.hpp"

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using namespace std::chrono_literals;
using plcgw::plc::modbus_error;
using plcgw::test::adprw_fixture;

namespace {

// Each ADPRW of these programs asks its own station.
constexpr unsigned nobody = 999;

unsigned station(adprw_fixture& f)
{
    const buffer asked = f.next();
    return asked.empty() ? nobody : asked[0];
}

void succeed(adprw_fixture& f) { f.finish(modbus::response{modbus::no_response{}}); }

// Stations asked until nobody is left, at most ten.
std::vector<unsigned> run(adprw_fixture& f)
{
    std::vector<unsigned> stations;
    for (unsigned asked = station(f); asked != nobody && stations.size() < 10; asked = station(f)) {
        stations.push_back(asked);
        succeed(f);
    }
    return stations;
}

void pulse(adprw_fixture& f, const char* device)
{
    f.set(device, 1);
    f.runner.scan();
    f.set(device, 0);
    f.runner.scan();
}

using stations = std::vector<unsigned>;

}  // namespace

TEST_CASE("adprw runner: several instructions, one at a time, in the order of the program, again and again")
{
    adprw_fixture f("LD M8000\nADPRW K1 H3 H0 K1 D0\nADPRW K2 H3 H0 K1 D0\nLD M0\nADPRW K3 H3 H0 K1 D0\n"
                    "LDI M0\nADPRW K4 H3 H0 K1 D0\n");
    f.set("M0", 1);
    for (const unsigned expected : {1U, 2U, 3U, 1U, 2U, 3U, 1U}) {
        CHECK(station(f) == expected);
        const auto out = f.question;
        f.check({{"M8401", 1}, {"M8029", 0}});
        CHECK(f.runner.wake_at(f.now) == time_point::max());
        CHECK(station(f) == nobody);  // no other one is triggered meanwhile
        f.question = out;
        succeed(f);
        f.check({{"M8401", 0}, {"M8029", 1}});
    }
    f.set("M0", 0);
    for (const unsigned expected : {2U, 4U, 1U, 2U, 4U}) {
        CHECK(station(f) == expected);
        succeed(f);
    }
}

TEST_CASE("adprw runner: nothing is due while no contact is on")
{
    adprw_fixture f("LD M0\nADPRW K1 H3 H0 K1 D0\nLD X7\nADPRW K2 H3 H0 K1 D0\n");
    CHECK(station(f) == nobody);
    CHECK(f.runner.wake_at(f.now) == time_point::max());
    f.set("X7", 1);
    f.runner.scan();
    CHECK(f.runner.wake_at(f.now) == f.now);
    CHECK(station(f) == 2);
    f.set("X7", 0);  // what has begun is completed
    f.answer({0x03, 0x02, 0x00, 0x07});
    f.check({{"D0", 7}, {"M8029", 1}});
    CHECK(station(f) == nobody);
}

TEST_CASE("adprw runner: contacts")
{
    struct {
        const char* contact;
        std::vector<test::preset> devices;
        stations asked;  // again and again: ten times
    } const rows[] = {
        {"LD M8000", {}, stations(10, 1)},
        {"LDI M8000", {}, {}},
        {"LD M8001", {}, {}},
        {"LDI M8001", {}, stations(10, 1)},
        {"LD M8002", {}, {1}},
        {"LD M8003", {}, {}},  // nothing is due in the first scan, then it is: below
        {"LDP M8002", {}, {1}},
        {"LD M5", {{"M5", 1}}, stations(10, 1)},
        {"LDI M5", {{"M5", 1}}, {}},
        {"LDI M5", {}, stations(10, 1)},
        {"LD Y17", {{"Y17", 1}}, stations(10, 1)},
        {"LD S9", {{"S9", 1}}, stations(10, 1)},
        {"LD TS3", {{"TS3", 1}}, stations(10, 1)},
        {"LD CS3", {{"CS3", 1}}, stations(10, 1)},
        {"LD M7999", {}, {}},
        {"LDI M7999", {}, stations(10, 1)},  // a relay that does not exist is off
        {"LDP M5", {{"M5", 1}}, {1}},
        {"LDF M5", {{"M5", 1}}, {}},
    };
    for (const auto& row : rows) {
        CAPTURE(row.contact);
        adprw_fixture f(std::string(row.contact) + "\nADPRW K1 H3 H0 K1 D0\n");
        f.set(row.devices);
        CHECK(run(f) == row.asked);
    }
    adprw_fixture after_first_scan("LD M8003\nADPRW K1 H3 H0 K1 D0\n");
    CHECK(station(after_first_scan) == nobody);
    CHECK(station(after_first_scan) == 1);
}

TEST_CASE("adprw runner: once for each edge")
{
    for (const char* text :
         {"LDP M0\nADPRW K1 H3 H0 K1 D0", "LD M0\nADPRWP K1 H3 H0 K1 D0", "LDP M0\nADPRWP K1 H3 H0 K1 D0",
          "LDF M1\nADPRW K1 H3 H0 K1 D0", "LDI M1\nADPRWP K1 H3 H0 K1 D0"}) {
        CAPTURE(text);
        const bool inverted = std::string(text).find("M1") != std::string::npos;
        adprw_fixture f(text);
        f.set("M1", 1);
        CHECK(run(f).empty());
        const auto step = [&](std::uint16_t on) {
            f.set(inverted ? "M1" : "M0", inverted ? 1 - on : on);
            return run(f);
        };
        CHECK(step(1) == stations{1});
        CHECK(step(1).empty());
        CHECK(step(0).empty());
        CHECK(step(1) == stations{1});
    }
}

TEST_CASE("adprw runner: an edge while the line is busy waits, two of them are one")
{
    adprw_fixture f("LD M10\nADPRW K1 H3 H0 K1 D0\nLDP M0\nADPRW K2 H3 H0 K1 D0\nLDF M1\nADPRW K3 H3 H0 K1 D0\n");
    f.set("M10", 1);
    CHECK(station(f) == 1);
    pulse(f, "M0");
    pulse(f, "M1");
    pulse(f, "M0");
    f.set("M10", 0);
    succeed(f);
    CHECK(run(f) == stations{2, 3});
}

TEST_CASE("adprw runner: a contact that is on at the start is an edge")
{
    adprw_fixture f("LDP M0\nADPRW K1 H3 H0 K1 D0\n");
    f.set("M0", 1);
    CHECK(run(f) == stations{1});
    f.plc.stop();
    CHECK(run(f).empty());
    f.plc.run();
    CHECK(run(f) == stations{1});
    CHECK(run(f).empty());
}

TEST_CASE("adprw runner: one contact drives several")
{
    adprw_fixture f(
        "LDP M0\nADPRW K1 H3 H0 K1 D0\nADPRW K2 H3 H0 K1 D0\nLD M8002\nADPRW K3 H3 H0 K1 D0\nADPRW K4 H3 H0 K1 D0\n");
    CHECK(run(f) == stations{3, 4});
    pulse(f, "M0");
    CHECK(run(f) == stations{1, 2});
}

TEST_CASE("adprw runner: MOVs run in the order of the program, so each ADPRW has its own")
{
    adprw_fixture f("LD M8000\nMOV K100 D8409\nMOV K1 D0\nADPRW D0 H3 H0 K1 D50\n"
                    "MOV K2000 D8409\nMOV K2 D0\nADPRW D0 H3 H0 K1 D51\n");
    for (int round = 0; round < 3; ++round) {
        CHECK(station(f) == 1);
        CHECK(f.question->timing.response_timeout == 100ms);
        f.answer({0x03, 0x02, 0x00, 0x07});
        CHECK(station(f) == 2);
        CHECK(f.question->timing.response_timeout == 2s);
        f.answer({0x03, 0x02, 0x00, 0x08});
    }
    f.check({{"D50", 7}, {"D51", 8}});
}

TEST_CASE("adprw runner: the program of section 10.2, with its parameters set by MOVs")
{
    adprw_fixture f("LD M8002\nMOV K90 D10\nMOV K150 D11\nMOV K27 D12\nMOV K31 D13\n"
                    "LDP M0\nADPRW HA H8 H1 HFF00 R0\n"
                    "LDP M1\nADPRW H5 H17 D10 D12 D100\n");
    f.set("D100", 0x0102);
    pulse(f, "M1");
    const buffer asked = f.next();
    REQUIRE(asked.size() == 11 + 2 * 27);
    CHECK(buffer(asked.begin(), asked.begin() + 13) ==
          buffer{0x05, 0x17, 0x00, 150, 0x00, 31, 0x00, 90, 0x00, 27, 54, 0x01, 0x02});
    modbus::registers_read read{std::vector<std::uint16_t>(31, 5)};
    read.values.back() = 6;
    f.finish(modbus::response{read});
    f.check({{"D126", 0}, {"D127", 5}, {"D157", 6}, {"D158", 0}});
    pulse(f, "M0");
    CHECK(f.next() == buffer{0x0A, 0x08, 0x00, 0x01, 0xFF, 0x00});
}

TEST_CASE("adprw runner: MOVs between registers, once and again")
{
    adprw_fixture f("LD M0\nMOV D1 R2\nLDP M1\nMOV K5 D3\nLD M2\nMOV R40000 D1\nMOV K1 D9000\nADPRW K1 H3 H0 K1 D0\n");
    f.set("D1", 77);
    CHECK(run(f).empty());
    CHECK(f.runner.wake_at(f.now) == time_point::max());
    f.set("M0", 1);
    f.runner.scan();
    CHECK(f.runner.wake_at(f.now) == f.now);
    CHECK(run(f).empty());
    f.check({{"R2", 77}});
    CHECK(f.runner.wake_at(f.now) == f.now + 100ms);  // again, at a leisurely pace
    f.set("M0", 0);
    pulse(f, "M1");
    CHECK(f.runner.wake_at(f.now) == f.now);
    CHECK(run(f).empty());
    f.check({{"D3", 5}});
    CHECK(f.runner.wake_at(f.now) == time_point::max());
    f.set("M2", 1);  // devices that do not exist
    CHECK(station(f) == 1);
    f.check({{"D1", 77}});
}

TEST_CASE("adprw runner: timing from D8409 to D8412")
{
    struct {
        std::uint16_t d8409, d8410, d8411, d8412;
        plc::adprw_timing expected;
    } const rows[] = {
        {0, 0, 0, 0, {3s, 400ms, 0ms, 0}},
        {1, 1, 1, 1, {1ms, 1ms, 1ms, 1}},
        {2000, 400, 10, 3, {2s, 400ms, 10ms, 3}},
        {32767, 32767, 16382, 20, {32767ms, 32767ms, 16382ms, 20}},
        {32768, 0xFFFF, 16383, 21, {32767ms, 32767ms, 16382ms, 20}},  // invalid: the nearest valid ones
        {0, 0, 0, 0xFFFF, {3s, 400ms, 0ms, 20}},
    };
    for (const auto& row : rows) {
        auto f = adprw_fixture::always("ADPRW K1 H3 H0 K1 D0");
        f.set({{"D8409", row.d8409}, {"D8410", row.d8410}, {"D8411", row.d8411}, {"D8412", row.d8412}});
        REQUIRE(station(f) == 1);
        CHECK(f.question->timing == row.expected);

        adprw_fixture second("LD M8000\nADPRW K1 H3 H0 K1 D0", "FX3U", 2);
        second.set({{"D8429", row.d8409}, {"D8430", row.d8410}, {"D8431", row.d8411}, {"D8432", row.d8412}});
        REQUIRE(station(second) == 1);
        CHECK(second.question->timing == row.expected);
    }
    auto ls = adprw_fixture::always("ADPRW K1 H3 H0 K1 D0", "LS22");
    ls.set({{"D8409", 500}, {"D8410", 7}, {"D8411", 7}, {"D8412", 2}});  // it has no D8410 and no D8411
    REQUIRE(station(ls) == 1);
    CHECK(ls.question->timing == plc::adprw_timing{500ms, 400ms, 0ms, 2});
}

TEST_CASE("adprw runner: the second end character of ASCII is D8406, as the program has changed it")
{
    auto f = adprw_fixture::always("ADPRW K1 H3 H0 K1 D0");
    REQUIRE(station(f) == 1);
    CHECK(f.question->timing.delimiter == '\n');
    succeed(f);
    f.set("D8406", '$');
    REQUIRE(station(f) == 1);
    CHECK(f.question->timing.delimiter == '$');
    auto small = adprw_fixture::always("ADPRW K1 H3 H0 K1 D0", "FX3G");  // has no D8406
    REQUIRE(station(small) == 1);
    CHECK(small.question->timing.delimiter == '\n');
}

TEST_CASE("adprw runner: a refused instruction does not stop the others, and rests a while")
{
    adprw_fixture f("LD M8000\nADPRW K300 H3 H0 K1 D0\nADPRW K2 H3 H0 K1 D0\n");
    CHECK(station(f) == 2);
    f.check({{"M8402", 0}, {"M8403", 1}, {"D8402", 218}, {"D8403", 1}, {"D8404", 1}, {"D8407", 12}, {"M8067", 1}});
    f.set("D8402", 0);
    f.now += 99ms;
    succeed(f);
    CHECK(station(f) == 2);
    f.check({{"D8402", 0}});
    f.now += 1ms;
    succeed(f);
    CHECK(station(f) == 2);
    f.check({{"D8402", 218}});
}

TEST_CASE("adprw runner: a program of refused instructions changes the devices once and wakes nobody at once")
{
    auto f = adprw_fixture::always("ADPRW D0 H3 H0 K1 D1");
    f.set("D0", 300);
    CHECK(station(f) == nobody);
    f.plc.memory().take_changes();
    CHECK(f.runner.wake_at(f.now) == f.now + 100ms);
    for (int i = 0; i < 5; ++i) {
        f.now += 100ms;
        CHECK(station(f) == nobody);
        CHECK_FALSE(f.plc.memory().has_changes());
    }
    f.set("D0", 3);  // mended
    f.now += 100ms;
    CHECK(station(f) == 3);
}

TEST_CASE("adprw runner: without its port an instruction tries again after a second")
{
    auto f = adprw_fixture::always("ADPRW K1 H3 H0 K1 D1");
    CHECK(station(f) == 1);
    f.fail(modbus_error::invalid_hardware);
    f.check({{"D8402", 201}, {"D8403", 1}});
    CHECK(station(f) == nobody);
    CHECK(f.runner.wake_at(f.now) == f.now + 1s);
    f.now += 1s;
    CHECK(station(f) == 1);
}

TEST_CASE("adprw runner: STOP forgets the question that is out, RUN begins the program anew")
{
    adprw_fixture f("LD M8000\nADPRW K1 H3 H0 K1 D0\nADPRW K2 H3 H0 K1 D0\nLD M8002\nADPRW K3 H3 H0 K1 D0\n");
    CHECK(station(f) == 1);
    const auto out = f.question;
    f.plc.stop();
    CHECK(f.runner.wake_at(f.now) == time_point::max());
    f.runner.attempt_failed(*out, {errc::timed_out, {}});
    f.answer({0x03, 0x02, 0x00, 0x07});
    f.check({{"D0", 0}, {"M8401", 0}, {"M8029", 0}, {"M8408", 0}});
    CHECK(station(f) == nobody);
    f.plc.run();
    for (const unsigned expected : {1U, 2U, 3U, 1U, 2U, 1U}) {
        CHECK(station(f) == expected);
        succeed(f);
    }
}

TEST_CASE("adprw runner: an answer from before a restart does not end the question after it")
{
    for (const bool power : {false, true}) {
        auto f = adprw_fixture::always("ADPRW K1 H3 H0 K1 D0");
        CHECK(station(f) == 1);
        const plc::adprw_question before = f.question.value();
        if (power) {
            f.plc.power_cycle();
        }
        else {
            f.plc.stop();
            f.plc.run();
        }
        CHECK(station(f) == 1);
        f.runner.finished(before, modbus::response{modbus::registers_read{{7}}}, f.now);
        f.check({{"D0", 0}, {"M8401", 1}, {"M8029", 0}});
        CHECK(f.runner.is_out(*f.question));
        f.answer({0x03, 0x02, 0x00, 0x08});
        f.check({{"D0", 8}, {"M8401", 0}, {"M8029", 1}});
    }
}

TEST_CASE("adprw runner: a program without ADPRW asks nothing")
{
    adprw_fixture f("LD M8411\nMOV H1 D8401\nEND\n");
    CHECK_FALSE(f.runner.program().asks());
    CHECK(station(f) == nobody);
    CHECK(f.runner.wake_at(f.now) == time_point::max());
    CHECK_THROWS_AS(plc::adprw_runner({}, f.plc, 3), std::out_of_range);
}

TEST_SUITE_END();
