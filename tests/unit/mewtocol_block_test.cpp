// Devices in a row, and the commands that they take.
#include "protocols/mewtocol/block.hpp"
#include "tests/support/print.hpp"

#include <numeric>

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol;

namespace {

using words = std::vector<std::uint16_t>;
using texts = std::vector<std::string>;

constexpr contact relay(std::uint16_t number) { return {contact_area::internal_relay, number}; }

// The commands as they stand behind `#`, without the words of writes.
texts commands_of(const std::optional<planned>& p)
{
    texts all;
    if (p)
        for (const command& each : p->commands)
            all.push_back(encode_command(each).substr(0, 22));
    return all;
}

words counted(std::size_t count)
{
    words values(count);
    std::iota(values.begin(), values.end(), std::uint16_t{1});
    return values;
}

}  // namespace

TEST_CASE("mewtocol block: a short block takes one frame that every station knows")
{
    const struct {
        block asked;
        const char* text;
    } rows[] = {
        {read_words{word_area::dt, 100, 27}, "RDD0010000126"},
        {read_words{word_area::wr, 3, 1}, "RCCR00030003"},
        {read_run{relay(0x1F), 1}, "RCSR001F"},
        {read_run{relay(0x1F), 2}, "RCCR00010002"},
        {read_run{{contact_area::timer, 5}, 2}, "RCP2T0005T0006"},
        {read_run{{contact_area::counter, 5}, 1}, "RCSC0005"},
        {write_run{relay(0x10), {true}}, "WCSR00101"},
        {write_run{relay(0x1E), {true, false}}, "WCP2R001E1R001F0"},
        {write_words{word_area::ld, 7, {0x1234}}, "WDL00007000073412"},
    };
    for (const auto& row : rows) {
        CAPTURE(row.text);
        const auto p = plan(row.asked, headers::automatic);
        REQUIRE(p.has_value());
        CHECK(p->head == header::normal);
        CHECK(commands_of(p) == texts{row.text});
        CHECK((plan(row.asked, headers::normal) == p));
    }
}

TEST_CASE("mewtocol block: a long one takes the header that saves frames, and is cut behind even words")
{
    const read_words long_read{word_area::dt, 0, 600};
    CHECK(plan(long_read, headers::automatic)->head == header::expansion);
    CHECK(commands_of(plan(long_read, headers::automatic)) == texts{"RDD0000000507", "RDD0050800599"});
    const auto normal = plan(long_read, headers::normal);
    CHECK(normal->head == header::normal);
    CHECK(normal->commands.size() == 24);  // 26 words each
    CHECK(plan(read_words{word_area::dt, 0, 509}, headers::automatic)->commands.size() == 1);
    CHECK(plan(write_words{word_area::dt, 0, counted(507)}, headers::automatic)->commands.size() == 1);
    CHECK(plan(write_words{word_area::dt, 0, counted(508)}, headers::automatic)->commands.size() == 2);
}

TEST_CASE("mewtocol block: contacts are written as words where whole words are, eight at a time elsewhere")
{
    std::vector<bool> values(46);  // R1D to R4A
    values[0] = values[3] = values[45] = true;
    const auto p = plan(write_run{relay(0x1D), values}, headers::automatic);
    REQUIRE(p.has_value());
    CHECK(commands_of(p) == texts{"WCP3R001D1R001E0R001F0",
                                  "WCCR000200030100"
                                  "0000",
                                  "WCP8R00400R00410R00420", "WCP3R00480R00490R004A1"});
}

TEST_CASE("mewtocol block: relays beyond word 999 have no contact number, but they have words")
{
    CHECK(commands_of(plan(read_run{relay(16 * 1000), 1}, headers::automatic)) == texts{"RCCR10001000"});
    CHECK(plan(write_run{relay(16 * 1000), std::vector<bool>(16)}, headers::automatic).has_value());
    CHECK_FALSE(plan(write_run{relay(16 * 1000), {true}}, headers::automatic).has_value());
}

TEST_CASE("mewtocol block: what no command does")
{
    const block rows[] = {
        read_words{word_area::dt, 99'999, 2},
        read_words{word_area::dt, 0, 0},
        write_words{word_area::dt, 99'999, {1, 2}},
        write_words{word_area::dt, 0, {}},
        write_words{word_area::wx, 0, {1}},
        write_run{{contact_area::external_input, 0}, {true}},
        write_run{{contact_area::timer, 0}, {true}},
        write_run{relay(0), {}},
        read_run{relay(0), 0},
        read_run{relay(65'535), 2},
        read_run{{contact_area::timer, 9999}, 2},
    };
    for (const block& each : rows)
        CHECK_FALSE(plan(each, headers::automatic).has_value());
}

TEST_CASE("mewtocol block: MEWTOCOL7-COM knows words only")
{
    using mewtocol7::command;
    const mewtocol7::dialect d;
    using commands = std::optional<std::vector<command>>;
    CHECK((plan(read_run{relay(0x1F), 2}, d) == commands{{read_words{word_area::wr, 1, 2}}}));
    CHECK((plan(read_words{word_area::dt, 70'000, 1024}, d) == commands{{read_words{word_area::dt, 70'000, 1024}}}));
    CHECK(plan(write_words{word_area::dt, 0, counted(1024)}, d)->size() == 2);
    std::vector<bool> sixteen(16);
    sixteen[1] = true;
    CHECK((plan(write_run{relay(0x20), sixteen}, d) == commands{{write_words{word_area::wr, 2, {2}}}}));
    CHECK_FALSE(plan(write_run{relay(0x21), sixteen}, d).has_value());
    CHECK_FALSE(plan(write_run{relay(0x20), {true}}, d).has_value());
    CHECK_FALSE(plan(read_run{{contact_area::timer, 1}, 1}, d).has_value());
    CHECK_FALSE(plan(read_words{word_area::sv, 1, 1}, d).has_value());
}

TEST_CASE("mewtocol block: the answers of its commands make one")
{
    const std::vector<response> halves{words_read{{1, 2}}, words_read{{3}}};
    CHECK((join(read_words{word_area::dt, 0, 3}, halves) == response{words_read{{1, 2, 3}}}));
    const std::vector<response> around{words_read{{0x8000, 0x0001}}};
    CHECK((join(read_run{relay(0x1E), 4}, around) == response{contacts_read{{false, true, true, false}}}));
    const std::vector<response> timers{contacts_read{{true, false}}, contacts_read{{true}}};
    CHECK((join(read_run{{contact_area::timer, 0}, 3}, timers) == response{contacts_read{{true, false, true}}}));
    CHECK((join(write_run{relay(0), {true}}, {executed{}, executed{}}) == response{executed{}}));
    CHECK((join(write_run{relay(0), {true}}, {no_response{}}) == response{no_response{}}));
}

TEST_SUITE_END();
