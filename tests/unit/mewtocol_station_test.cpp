// A MEWTOCOL station in front of an FP7's memory: the vectors of the public sources, and what is the FP7's own.
#include "bridge/plc/models/fp7.hpp"
#include "bridge/services/mewtocol_station.hpp"
#include "tests/unit/mewtocol_vectors.hpp"

#include <memory>

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using namespace plcgw::test;

namespace {

struct fp7_bench {
    explicit fp7_bench(mewtocol_station_options options = {.offered = mewtocol::all_commands})
        : station(plc, std::move(options))
    {
    }

    plc::place at(const char* device) const
    {
        return plc.memory().find(*plc::parse_device(device, plc::fp7.names)).value();
    }
    std::uint16_t word(const char* device) const { return plc.memory().word(at(device)); }
    void set(const char* device, std::uint16_t value) { plc.memory().set_word(at(device), value); }

    buffer hear(bytes received)
    {
        buffer sent;
        framer.feed(now, received);
        while (const auto r = framer.next(now))
            if (const auto reply = station.hear(now, *r))
                sent.insert(sent.end(), reply->begin(), reply->end());
        return sent;
    }
    std::string say(std::string request)  // without the CR of both
    {
        const buffer reply = hear(with_cr(std::move(request)));
        return reply.empty() ? std::string() : std::string(reply.begin(), reply.end() - 1);
    }

    plc::simulated_plc plc{"fp7", plc::fp7, {}};
    mewtocol_station station;
    mewtocol::line_framer framer{1s};
    time_point now = t0;
};

struct area_pair {
    mewtocol::word_area area;
    plc::device_kind kind;
};

constexpr area_pair shared_areas[] = {
    {mewtocol::word_area::wx, plc::device_kind::wx}, {mewtocol::word_area::wy, plc::device_kind::wy},
    {mewtocol::word_area::wr, plc::device_kind::wr}, {mewtocol::word_area::wl, plc::device_kind::wl},
    {mewtocol::word_area::dt, plc::device_kind::d},  {mewtocol::word_area::ld, plc::device_kind::ld},
};

void copy_values(plc::memory& to, const std::vector<std::uint16_t>& from, plc::device_kind kind)
{
    for (std::uint32_t i = 0; i < from.size(); ++i)
        to.set_word(to.find({kind, i}).value(), from[i]);
}

// The memory of the fake device that the vectors were written for.
void copy_memory(fp7_bench& to, const fake_device& from)
{
    plc::memory& memory = to.plc.memory();
    for (const area_pair& each : shared_areas)
        for (std::uint32_t i = 0; i < from.memory.at(each.area).size() && memory.find({each.kind, i}); ++i)
            memory.set_word(*memory.find({each.kind, i}), from.memory.at(each.area)[i]);
    copy_values(memory, from.memory.at(mewtocol::word_area::sv), plc::device_kind::timer_set);
    copy_values(memory, from.memory.at(mewtocol::word_area::ev), plc::device_kind::tn);
    for (const std::uint16_t timer : from.timers)
        memory.set_bit(memory.find({plc::device_kind::ts, timer}).value(), true);
}

// What an FP7 answers otherwise: it has no file, index and system registers, says nothing of itself in RT, and its DT
// go on behind 32764.
const std::map<std::string, std::string> different{
    {"V23", "%01!6003"},
    {"V24", "%01!6003"},
    {"V33", "%01!6003"},
    {"V34", "%01!6003"},
    {"V37", "%01$RT000000010000000007"},
    {"V38", "%EE$RT000000010000000006"},
    {"V40", "%EE!4202"},
    {"V62", "%01$RD0000000016"},
    {"V65", "%01!6003"},
};

}  // namespace

TEST_CASE("mewtocol station: the vectors on the memory of an FP7")
{
    mewtocol_bench fake;
    auto bench = std::make_unique<fp7_bench>();
    for (const vector_row& row : com_vectors()) {
        if (row.from == vector_row::start::alone)
            bench = std::make_unique<fp7_bench>();
        prepare(fake, row);
        if (row.setup != nullptr) {
            copy_memory(*bench, fake.device);
            const auto& o = fake.options;
            if (o.own != mewtocol::station_id{1} || !o.offered.contains(mewtocol::command_code::RS))
                bench->station = mewtocol_station(bench->plc, {.number = mewtocol::number(o.own),
                                                               .offered = o.offered,
                                                               .expansion = o.expansion,
                                                               .several_frames = o.several_frames});
            bench->now += fake.device.scan * 10ms - (bench->now - t0);
        }
        if (std::string(row.id) == "V49")  // its setup registers DT0 without a command
            bench->say("%01#MDD00000**");
        INFO(std::string(row.id));
        const auto other = different.find(row.id);
        CHECK(bench->say(row.request) == (other == different.end() ? row.response : other->second));
        fake.say(row.request);
    }
}

TEST_CASE("mewtocol station: MEWTOCOL7-COM on the same port")
{
    fp7_bench b;
    b.set("DT0", 5);
    b.set("DT1", 10);
    CHECK(b.say("%01#RDD000000000154") == "%01$RD05000A0062");
    CHECK(b.say(">@00100#00MMRDD001G0DT00000000000029377") == ">@00100$00MMRD05000A0075BF");
    CHECK(b.say(">@00101#00MMWTD001G0DT00000000000023412FF003632") == ">@00101$00MMWTCDC4");
    CHECK(b.word("DT0") == 0x1234);
    CHECK(b.word("DT1") == 0x00FF);
    CHECK(b.say(">@EEE00#30STRD0043F1") == ">@EEE00$30STRD00070300000453045304530100000000660100A7A5");
    CHECK(b.say(">@01200#00MMRDD001G0DT000000000000191C3").empty());
    CHECK(b.say(">@00100#00MMWTD001G0WX0000000000001FF00****").substr(0, 10) == ">@00100!60");
}

TEST_CASE("mewtocol station: an FP7 offers what its manual lists")
{
    fp7_bench b{mewtocol_station_options{}};
    for (const char* const command : {"RS00000001", "WS0000000064001E00", "RK00000001", "WK000000006400", "RR0000000",
                                      "WR00000000800", "RMR", "EX00RT00"})
        CHECK(b.say("%01#" + std::string(command) + "**") == "%01!4203");
    CHECK(b.say("%01#RT**") == "%01$RT000000010000000007");
    b.plc.stop();
    CHECK(b.say("%01#RT**") == "%01$RT000000000000000006");
}

TEST_CASE("mewtocol station: RM switches between RUN and PROG")
{
    fp7_bench b;
    CHECK(b.say("%01#RMP48") == "%01$RM1F");
    CHECK(b.plc.state() == plc::run_state::stop);
    CHECK(b.say("%01#RMR4A") == "%01$RM1F");
    CHECK(b.plc.state() == plc::run_state::run);
}

TEST_CASE("mewtocol station: values of timers, and of counters behind them")
{
    fp7_bench b;
    CHECK(b.say("%01#WS409540960100E803**") == "%01$WS04");
    CHECK(b.word("TS4095") == 1);
    CHECK(b.word("CS0") == 1000);
    CHECK(b.say("%01#RS40954096**") == "%01$RS0100E8037E");
    CHECK(b.say("%01#WK511951197800**") == "%01$WK1C");
    CHECK(b.word("CE1023") == 120);
    CHECK(b.say("%01#RK51195120**") == "%01!6102");
}

TEST_CASE("mewtocol station: the last device of each area, and none beyond")
{
    fp7_bench b;
    const struct {
        const char* request;
        bool exists;
    } rows[] = {
        {"RCCX05110511", true},   {"RCCX05120512", false}, {"RCCY05110511", true},       {"RCCR20472047", true},
        {"RCCR20472048", false},  {"RCCL10231023", true},  {"RCCL10241024", false},      {"RDD6553565535", true},
        {"RDD6553565536", false}, {"RDL1638316383", true}, {"RDL1638416384", false},     {"RCST4095", true},
        {"RCST4096", false},      {"RCSC1023", true},      {"RCSC1024", false},          {"RCSX511F", true},
        {"RCSX5120", false},      {"WCSY512F1", false},    {"SDL16383163840000", false},
    };
    for (const auto& row : rows) {
        INFO(std::string(row.request));
        const std::string reply = b.say("%01#" + std::string(row.request) + "**");
        CHECK(reply.substr(0, 4) == (row.exists ? "%01$" : "%01!"));
        CHECK((row.exists || reply == "%01!6102"));
    }
}

TEST_CASE("mewtocol station: of several on a line one answers those who name none")
{
    fp7_bench second({.number = 2, .answers_any = false});
    CHECK(second.say("%EE#RT00").empty());
    CHECK(second.say(">@EEE00#30STRD0043F1").empty());
    CHECK(second.say("%02#RT**") == "%02$RT000000010000000004");
    CHECK(second.say("%EE" + std::string(150, '0')).empty());
    CHECK(second.say("%FF#WDD0000000000341255").empty());
    CHECK(second.word("DT0") == 0x1234);
}

TEST_CASE("mewtocol station: numbers beyond 99 are those of MEWTOCOL7-COM")
{
    fp7_bench b({.number = 100});
    CHECK(b.say("%00#RT**").empty());
    CHECK(b.say("%10#RT**").empty());
    CHECK(b.say("%EE#RT00") == "%EE$RT000000010000000006");
    CHECK(b.say(">@10000#00MMRDD001G0DT0000000000001****").substr(0, 14) == ">@10000$00MMRD");
}

TEST_CASE("mewtocol station: a reset and a power cycle forget what MC registered")
{
    const auto registered = [](fp7_bench& b) { return b.say("%01#MG0D") != "%01!6201"; };
    fp7_bench b;
    b.say("%01#MCR0000**");
    CHECK(registered(b));
    b.station.reset();
    CHECK_FALSE(registered(b));
    b.say("%01#MCR0000**");
    CHECK(registered(b));
    b.plc.power_cycle();
    CHECK_FALSE(registered(b));
}

TEST_CASE("mewtocol station: the rest of a long answer is forgotten by a reset")
{
    fp7_bench b;
    CHECK(b.say("%01#RDD000000005959").ends_with("&"));
    b.station.reset();
    CHECK(b.say("%0124&") == "%01!4302");
}

TEST_CASE("mewtocol station: which replies a client could have said")
{
    CHECK_FALSE(is_like_request(to_bytes("%01$RD05000A0062\r")));
    CHECK_FALSE(is_like_request(to_bytes("%01!6102\r")));
    CHECK_FALSE(is_like_request(to_bytes(">@00101$00MMWTCDC4\r")));
    CHECK(is_like_request(to_bytes("%0124&\r")));
    CHECK(is_like_request(to_bytes("%0136003700380039003A003B0027\r")));
    CHECK(is_like_request(to_bytes(">@EEE0117C0&\r")));
}

TEST_SUITE_END();
