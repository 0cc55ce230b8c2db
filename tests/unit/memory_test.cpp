#include "bridge/plc/memory.hpp"
#include "bridge/plc/models/fx3u.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("plc");

using namespace plcgw::plc;

namespace {

place at(const memory& m, const char* device) { return m.find(*parse_device(device)).value(); }

using changes = std::vector<change>;

}  // namespace

TEST_CASE("memory: every area of the FX3U, its first and last device, and nothing behind it")
{
    struct {
        const char* first;
        const char* last;
        const char* behind;
        std::size_t bits;  // of the whole area
    } const areas[] = {
        {"X0", "X377", "X400", 256},           {"Y0", "Y377", "Y400", 256},
        {"M0", "M7679", "M7680", 7680},        {"M8000", "M8511", "M8512", 512},
        {"S0", "S4095", "S4096", 4096},        {"TS0", "TS511", "TS512", 512},
        {"CS0", "CS255", "CS256", 256},        {"D0", "D7999", "D8512", 16 * 8000},
        {"D8000", "D8511", "D8512", 16 * 512}, {"R0", "R32767", "R32768", 16 * 32768},
        {"TN0", "TN511", "TN512", 16 * 512},   {"CN0", "CN199", "CN256", 16 * 200},
        {"CN200", "CN255", "CN256", 32 * 56},
    };
    memory m(fx3u);
    CHECK(std::size(areas) == fx3u.areas.size());
    for (const auto& row : areas) {
        CAPTURE(row.first);
        const place first = at(m, row.first);
        const place last = at(m, row.last);
        CHECK(first.bit == 0);
        CHECK(last.area == first.area);
        CHECK(m.bits_from(first) == row.bits);
        CHECK(m.bits_from(last) == row.bits / (parse_device(row.last)->number - parse_device(row.first)->number + 1));
        CHECK_FALSE(m.find(*parse_device(row.behind)).has_value());

        CHECK(m.word(first) == 0);  // everything is 0 at first
        m.set_bit(first, true);
        m.set_bit(last, true);
        CHECK(m.bit(first));
        CHECK(m.bit(last));
    }
    CHECK_FALSE(m.find(*parse_device("M7999")).has_value());  // between normal and special
}

TEST_CASE("memory: X and Y are octal, X377 is the 256th point")
{
    const memory m(fx3u);
    CHECK(at(m, "X377").bit == 255);
    CHECK(at(m, "X10").bit == 8);
    CHECK(at(m, "Y100").bit == 64);
}

TEST_CASE("memory: a 32-bit counter takes two registers, low word first")
{
    memory m(fx3u);
    const place counter = at(m, "CN200");
    m.set_word(counter, 0x5678);
    m.set_word({counter.area, counter.bit + 16}, 0x1234);
    std::uint16_t words[3]{};
    m.read(counter, words);
    CHECK(words[0] == 0x5678);
    CHECK(words[1] == 0x1234);
    CHECK(words[2] == 0);
    CHECK(at(m, "CN201").bit == counter.bit + 32);
    CHECK(m.bits_from(at(m, "CN255")) == 32);
}

TEST_CASE("memory: words of bit devices, from any device on")
{
    memory m(fx3u);
    m.set_word(at(m, "M16"), 0xA5C3);
    CHECK(m.bit(at(m, "M16")));
    CHECK(m.bit(at(m, "M17")));
    CHECK_FALSE(m.bit(at(m, "M18")));
    CHECK(m.bit(at(m, "M31")));
    CHECK(m.word(at(m, "M20")) == 0x0A5C);
    CHECK(m.word(at(m, "M12")) == 0x5C30);
    CHECK(m.word(at(m, "M31")) == 0x0001);

    m.set_word(at(m, "M100"), 0xFFFF);
    CHECK_FALSE(m.bit(at(m, "M99")));
    CHECK(m.bit(at(m, "M100")));
    CHECK(m.bit(at(m, "M115")));
    CHECK_FALSE(m.bit(at(m, "M116")));
    m.set_word(at(m, "M104"), 0x0000);  // leaves its neighbours alone
    CHECK(m.word(at(m, "M100")) == 0x000F);

    std::uint16_t words[2]{};
    m.read(at(m, "M97"), words);
    CHECK(words[0] == 0x0078);
    CHECK(words[1] == 0x0000);
    m.set_word(at(m, "M7664"), 0x8000);
    CHECK(m.bit(at(m, "M7679")));
}

TEST_CASE("memory: changed runs are merged and drained once")
{
    memory m(fx3u);
    CHECK_FALSE(m.has_changes());
    CHECK(m.take_changes().empty());

    const place d10 = at(m, "D10");
    for (const std::size_t i : {2U, 0U, 1U, 5U})
        m.set_word({d10.area, d10.bit + 16 * i}, 7);
    m.set_bit(at(m, "M33"), true);
    m.set_bit(at(m, "M34"), true);
    CHECK(m.has_changes());
    CHECK(m.take_changes() == changes{{at(m, "M0").area, 33, 2}, {d10.area, 160, 48}, {d10.area, 240, 16}});
    CHECK_FALSE(m.has_changes());
    CHECK(m.take_changes().empty());

    m.set_word(d10, 8);
    CHECK(m.take_changes() == changes{{d10.area, 160, 16}});
}

TEST_CASE("memory: what is written without a change is no change")
{
    memory m(fx3u);
    m.set_word(at(m, "D0"), 0);
    m.set_bit(at(m, "M0"), false);
    CHECK_FALSE(m.has_changes());
    m.set_word(at(m, "D0"), 1);
    m.set_word(at(m, "M8"), 0x0001);  // only the first of two registers changes
    m.take_changes();
    m.set_word(at(m, "D0"), 1);
    m.set_bit(at(m, "M8"), true);
    CHECK(m.take_changes().empty());

    m.set_word(at(m, "M24"), 0x0180);
    CHECK(m.take_changes() == changes{{at(m, "M0").area, 31, 2}});
}

TEST_CASE("memory: of bit devices only those that changed, of a word device all of it")
{
    memory m(fx3u);
    m.set_word(at(m, "M0"), 0b0110'0001);
    m.set_word(at(m, "TN3"), 0x0100);
    m.set_bit(at(m, "Y17"), true);
    m.set_bit(at(m, "Y20"), true);
    m.set_bit(at(m, "CN201"), true);
    const auto run = [&](const char* first, std::size_t count) {
        return change{at(m, first).area, at(m, first).bit, count};
    };
    CHECK(m.take_changes() == changes{run("Y17", 2), run("M0", 1), run("M5", 2), run("TN3", 16), run("CN201", 16)});
}

TEST_CASE("memory: which runs overlap a change")
{
    const change changed{3, 100, 20};
    CHECK(overlaps(changed, {3, 119}, 1));
    CHECK(overlaps(changed, {3, 0}, 101));
    CHECK(overlaps(changed, {3, 90}, 100));
    CHECK(overlaps(changed, {3, 105}, 1));
    CHECK_FALSE(overlaps(changed, {3, 120}, 50));
    CHECK_FALSE(overlaps(changed, {3, 0}, 100));
    CHECK_FALSE(overlaps(changed, {2, 100}, 20));
}

TEST_CASE("memory: runs of neighbouring areas stay apart")
{
    memory m(fx3u);
    m.set_word(at(m, "D7999"), 1);
    m.set_word(at(m, "D8000"), 1);
    CHECK(m.take_changes() == changes{{at(m, "D0").area, 16 * 7999, 16}, {at(m, "D8000").area, 0, 16}});
}

TEST_CASE("memory: bits that fill up a register of bit devices stay 0")
{
    struct {
        const char* device;
        std::uint16_t left;  // of FFFF
    } const rows[] = {
        {"Y0", 0x3FFF},     // Y0-Y15 are 14 points
        {"TS128", 0x03FF},  // TS0-TS137
        {"CS200", 0xFFFF},  // CS200-CS255 begin inside a register
        {"CS240", 0xFFFF}, {"X0", 0xFFFF}, {"M1520", 0xFFFF},
    };
    memory m(*find_model("FX3S"));
    for (const auto& row : rows) {
        CAPTURE(row.device);
        m.set_word(at(m, row.device), 0xFFFF);
        CHECK(m.word(at(m, row.device)) == row.left);
    }
    const place fill{at(m, "CS200").area, 0};  // where CS192 to CS199 are in other models
    m.set_word(fill, 0xFFFF);
    CHECK(m.word(fill) == 0xFF00);
    m.set_bit({fill.area, 7}, true);
    CHECK(m.word(fill) == 0xFF00);
}

TEST_CASE("memory: protected devices keep what the PLC shows in them")
{
    memory m(fx3u);
    m.set_protected(at(m, "D8405"), 16, true);
    m.set_protected(at(m, "M8401"), 1, true);
    m.show_word(at(m, "D8405"), 0x1097);
    m.show_bit(at(m, "M8401"), true);
    m.take_changes();
    CHECK_FALSE(m.is_open(at(m, "D8404"), 32));
    CHECK(m.is_open(at(m, "D8404"), 16));
    CHECK_FALSE(m.is_open(at(m, "M8394"), 8));
    CHECK(m.is_open(at(m, "M8394"), 7));
    m.set_word(at(m, "D8405"), 1);
    m.set_word(at(m, "M8400"), 0);
    m.set_word(at(m, "M8393"), 0);  // a run that begins inside a register
    m.set_bit(at(m, "M8401"), false);
    CHECK(m.word(at(m, "D8405")) == 0x1097);
    CHECK(m.bit(at(m, "M8401")));
    CHECK_FALSE(m.has_changes());
    m.set_word(at(m, "M8400"), 0xFFFF);  // the neighbours are free
    CHECK(m.word(at(m, "M8400")) == 0xFFFF);
    m.show_bit(at(m, "M8401"), false);
    CHECK(m.word(at(m, "M8400")) == 0xFFFD);
    m.set_protected(at(m, "D8405"), 16, false);
    m.set_word(at(m, "D8405"), 1);
    CHECK(m.word(at(m, "D8405")) == 1);
}

TEST_CASE("memory: a watch that ended sees nothing, and leaves the others alone")
{
    memory m(fx3u);
    const auto first = m.watch_writes(at(m, "D100"), 32);
    const auto second = m.watch_writes(at(m, "D101"), 16);
    m.end_watch(first);
    m.set_word(at(m, "D101"), 0);
    CHECK(m.take_written(second));
    const auto third = m.watch_writes(at(m, "D200"), 16);
    CHECK(third == first);
    m.set_word(at(m, "D100"), 1);
    CHECK_FALSE(m.take_written(third));
    m.set_word(at(m, "D200"), 1);
    CHECK(m.take_written(third));
}

TEST_SUITE_END();
