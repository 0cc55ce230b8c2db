// A MEWTOCOL station in front of an FP7's memory: the vectors of the public sources, and what is the FP7's own.
#include "bridge/plc/models/fp7.hpp"
#include "bridge/services/mewtocol_station.hpp"
#include "tests/support/print.hpp"
#include "tests/unit/mewtocol_vectors.hpp"

#include <doctest/doctest.h>

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

void copy_values(plc::memory& to, const std::vector<std::uint16_t>& from, char letter, plc::device_kind kind)
{
    static_cast<void>(letter);
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
    copy_values(memory, from.memory.at(mewtocol::word_area::sv), 'S', plc::device_kind::timer_set);
    copy_values(memory, from.memory.at(mewtocol::word_area::ev), 'K', plc::device_kind::tn);
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
        INFO(std::string(row.id));
        const auto other = different.find(row.id);
        CHECK(bench->say(row.request) == (other == different.end() ? row.response : other->second));
        fake.say(row.request);
    }
}
