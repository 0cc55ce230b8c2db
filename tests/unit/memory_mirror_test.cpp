// The memory of one member as the other one gets it.
#include "bridge/standby/memory_mirror.hpp"

#include <doctest/doctest.h>

TEST_SUITE_BEGIN("standby");

using namespace plcgw;

namespace {

struct side {
    plc::simulated_plc plc{"main", *plc::find_model("FX3U"), {}};
    memory_mirror mirror;

    side() { mirror.add(plc); }
    plc::place at(const char* device) { return *plc.memory().find(*plc::parse_device(device, plc.model().names)); }
    void set(const char* device, std::uint16_t value) { plc.memory().set_word(at(device), value); }
    std::uint16_t word(const char* device) { return plc.memory().word(at(device)); }
    void drain()
    {
        for (const plc::change& each : plc.memory().take_changes())
            mirror.memory_changed(plc, each);
    }
    std::vector<memory_chunk> said()
    {
        drain();
        std::vector<memory_chunk> all;
        while (auto each = mirror.next())
            all.push_back(std::move(*each));
        return all;
    }
};

}  // namespace

TEST_CASE("memory mirror: what changed is said once, and is the same on the other side")
{
    side a;
    side b;
    a.said();
    a.set("D100", 1);
    a.set("D127", 2);
    a.set("D128", 3);
    a.set("D7999", 4);
    a.set("D8490", 5);  // special: each has its own
    a.plc.memory().set_bit(a.at("M17"), true);
    const auto said = a.said();
    CHECK(said.size() == 4);
    CHECK(a.said().empty());
    for (const memory_chunk& each : said)
        CHECK(b.mirror.apply(each, {}));
    CHECK(b.word("D100") == 1);
    CHECK(b.word("D127") == 2);
    CHECK(b.word("D128") == 3);
    CHECK(b.word("D7999") == 4);
    CHECK(b.word("D8490") == 0);
    CHECK(b.plc.memory().bit(b.at("M17")));
    CHECK_FALSE(b.plc.memory().bit(b.at("M16")));
    b.drain();
    b.mirror.say_everything();
    CHECK(b.said().size() >= 4);  // to whoever comes next
}

TEST_CASE("memory mirror: what changed back to zero is said, also to one who comes late")
{
    side a;
    side b;
    a.set("D0", 5);
    for (const memory_chunk& each : a.said())
        b.mirror.apply(each, {});
    a.set("D0", 0);
    a.drain();
    a.mirror.say_everything();
    for (const memory_chunk& each : a.said())
        b.mirror.apply(each, {});
    CHECK(b.word("D0") == 0);
}

TEST_CASE("memory mirror: own bits stay")
{
    side a;
    side b;
    a.set("D0", 0xAAAA);
    a.set("D1", 0xAAAA);
    b.set("D0", 0x5555);
    b.set("D1", 0x5555);
    for (const memory_chunk& each : a.said())
        b.mirror.apply(each, {0x00FF});
    CHECK(b.word("D0") == 0xAA55);
    CHECK(b.word("D1") == 0xAAAA);
}

TEST_CASE("memory mirror: places that are not here are refused")
{
    side b;
    CHECK_FALSE(b.mirror.apply({"other", 0, 0, 1, {1}}, {}));
    CHECK_FALSE(b.mirror.apply({"main", 1000, 0, 1, {1}}, {}));
    CHECK_FALSE(b.mirror.apply({"main", 0, 4'000'000'000, 1, {1}}, {}));
}

TEST_SUITE_END();
