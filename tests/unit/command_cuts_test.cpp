// Where a MEWTOCOL route of several commands is cut.
#include "bridge/routes/command_cuts.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::mewtocol;

TEST_CASE("command cuts: words and contacts at which another command begins")
{
    using cuts = std::vector<std::size_t>;
    const bus_timing com{.protocol = bus_protocol::mewtocol_com};
    const bus_timing normal{.protocol = bus_protocol::mewtocol_com, .headers = headers::normal};
    const bus_timing seven{.protocol = bus_protocol::mewtocol7_com};
    const contact r1f{contact_area::internal_relay, 31};
    const contact r20{contact_area::internal_relay, 32};
    const contact t5{contact_area::timer, 5};
    const struct {
        const char* name;
        const bus_timing& bus;
        block asked;
        cuts expected;
    } rows[] = {
        {"one command", com, read_words{word_area::dt, 0, 509}, {}},
        {"behind an even number", com, read_words{word_area::dt, 0, 510}, {508}},
        {"header %", normal, read_words{word_area::dt, 0, 60}, {26, 52}},
        {"written", normal, write_words{word_area::dt, 0, std::vector<std::uint16_t>(30)}, {24}},
        {"contacts as words, from bit F on", normal, read_run{r1f, 500}, {26 * 16 - 15}},
        {"timers, eight at a time", com, read_run{t5, 20}, {8, 16}},
        {"contacts written as a whole word and the rest", com, write_run{r20, std::vector<bool>(20)}, {16}},
        {"MEWTOCOL7 reads any number by one command", seven, read_words{word_area::dt, 0, 1024}, {}},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        CHECK(command_cuts(row.bus, row.asked) == row.expected);
    }
}
