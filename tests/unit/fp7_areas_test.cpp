// The areas that MEWTOCOL commands name, in the memory of an FP7.
#include "bridge/plc/mewtocol_areas.hpp"
#include "bridge/plc/models/fp7.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("plc");

using namespace plcgw::plc;

namespace {

const memory m(fp7);

place at(const char* text) { return m.find(parse_device(text, fp7.names).value()).value(); }

constexpr auto unknown = area_fault::no_such_area;
constexpr auto outside = area_fault::out_of_range;

}  // namespace

TEST_CASE("mewtocol areas: a contact by word and bit")
{
    CHECK(*contact_at(m, 'X', 1, 15) == at("X1F"));
    CHECK(*contact_at(m, 'Y', 0, 10) == at("YA"));
    CHECK(*contact_at(m, 'R', 2047, 15) == at("R2047F"));
    CHECK(*contact_at(m, 'L', 1023, 0) == at("L10230"));
    CHECK(contact_at(m, 'X', 512, 0).error() == outside);
    CHECK(contact_at(m, 'R', 2048, 0).error() == outside);
    CHECK(contact_at(m, 'R', 0, 16).error() == outside);
    CHECK(contact_at(m, 'R', 0x10000001, 0).error() == outside);
    for (const char letter : {'T', 'C', 'D', 'F', 'Q', 'x', 'S'})
        CHECK(contact_at(m, letter, 0, 0).error() == unknown);
}

TEST_CASE("mewtocol areas: a contact of a timer or counter by its number")
{
    CHECK(*timer_contact_at(m, 'T', 99) == at("T99"));
    CHECK(*timer_contact_at(m, 'C', 1023) == at("C1023"));
    CHECK(timer_contact_at(m, 'T', 4096).error() == outside);
    CHECK(timer_contact_at(m, 'C', 1024).error() == outside);
    CHECK(timer_contact_at(m, 'X', 0).error() == unknown);
}

TEST_CASE("mewtocol areas: words of contacts and data, to the last and not beyond")
{
    CHECK(*contact_words_at(m, 'X', 1, 3) == at("WX1"));
    CHECK(*contact_words_at(m, 'L', 0, 1024) == at("WL0"));
    CHECK(contact_words_at(m, 'L', 0, 1025).error() == outside);
    CHECK(contact_words_at(m, 'L', 1023, 2).error() == outside);
    CHECK(contact_words_at(m, 'D', 0, 1).error() == unknown);
    CHECK(contact_words_at(m, 'T', 0, 1).error() == unknown);
    CHECK(*data_at(m, 'D', 65535, 1) == at("DT65535"));
    CHECK(*data_at(m, 'L', 16383, 1) == at("LD16383"));
    CHECK(data_at(m, 'D', 65535, 2).error() == outside);
    CHECK(data_at(m, 'D', 99999, 1).error() == outside);
    CHECK(data_at(m, 'L', 16384, 1).error() == outside);
    CHECK(data_at(m, 'F', 0, 1).error() == unknown);  // an FP7 has no file registers
    CHECK(data_at(m, 'S', 0, 1).error() == unknown);
}

TEST_CASE("mewtocol areas: words by the names of MEWTOCOL7")
{
    CHECK(*named_words_at(m, "DT", 100, 10) == at("DT100"));
    CHECK(*named_words_at(m, "LD", 5, 1) == at("LD5"));
    CHECK(*named_words_at(m, "WR", 2047, 1) == at("WR2047"));
    CHECK(named_words_at(m, "WX", 511, 2).error() == outside);
    for (const char* name : {"FL", "TS", "UM", "R", "D", "dt", ""})
        CHECK(named_words_at(m, name, 0, 1).error() == unknown);
}

TEST_CASE("mewtocol areas: set and elapsed values, counters behind the timers")
{
    CHECK(*value_at(m, 'S', 0) == at("TS0"));
    CHECK(*value_at(m, 'S', 4095) == at("TS4095"));
    CHECK(*value_at(m, 'S', 4096) == at("CS0"));
    CHECK(*value_at(m, 'K', 1) == at("TE1"));
    CHECK(*value_at(m, 'K', 5119) == at("CE1023"));
    CHECK(value_at(m, 'S', 5120).error() == outside);
    CHECK(value_at(m, 'K', 9999).error() == outside);
    CHECK(value_at(m, 'D', 0).error() == unknown);
}

TEST_CASE("mewtocol areas: a value of one word clears the high word")
{
    memory changed(fp7);
    const place low = *value_at(changed, 'S', 3);
    changed.set_word({low.area, low.bit + 16}, 7);
    set_value(changed, low, 100);
    CHECK(changed.word(low) == 100);
    CHECK(changed.word({low.area, low.bit + 16}) == 0);
    CHECK(changed.word(*value_at(changed, 'S', 2)) == 0);
    CHECK(changed.word(*value_at(changed, 'S', 4)) == 0);
}

TEST_CASE("mewtocol areas: another family has other areas")
{
    const memory fx(*find_model("FX3U"));
    CHECK(contact_at(fx, 'R', 0, 0).error() == unknown);
    CHECK(contact_words_at(fx, 'X', 0, 1).error() == unknown);
    CHECK(data_at(fx, 'L', 0, 1).error() == unknown);
    CHECK(value_at(fx, 'S', 0).error() == unknown);
    CHECK(named_words_at(fx, "DT", 0, 1).error() == unknown);
}

TEST_SUITE_END();
