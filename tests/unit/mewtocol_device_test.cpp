// Names of a station's devices.
#include "protocols/mewtocol/device.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol;

namespace {

constexpr contact at(contact_area area, std::uint16_t number) { return {area, number}; }

}  // namespace

TEST_CASE("mewtocol device: names and what they mean")
{
    using enum contact_area;
    const struct {
        const char* text;
        device meant;
        const char* printed;
    } rows[] = {
        {"DT0", word_device{word_area::dt, 0}, "DT0"},
        {"DT65535", word_device{word_area::dt, 65'535}, "DT65535"},
        {"DT00100", word_device{word_area::dt, 100}, "DT100"},
        {"LD5", word_device{word_area::ld, 5}, "LD5"},
        {"FL12", word_device{word_area::fl, 12}, "FL12"},
        {"WR3", word_device{word_area::wr, 3}, "WR3"},
        {"WX9999", word_device{word_area::wx, 9999}, "WX9999"},
        {"SV7", word_device{word_area::sv, 7}, "SV7"},
        {"EV7", word_device{word_area::ev, 7}, "EV7"},
        {"IX", word_device{word_area::ix, 0}, "IX"},
        {"SYS400", word_device{word_area::system, 400}, "SYS400"},
        {"R1F", at(internal_relay, 0x1F), "R1F"},
        {"R12", at(internal_relay, 0x12), "R12"},
        {"R0", at(internal_relay, 0), "R0"},
        {"RF", at(internal_relay, 15), "RF"},
        {"X10A", at(external_input, 170), "X10A"},
        {"Y99F", at(external_output, 99 * 16 + 15), "Y99F"},
        {"L1D", at(link_relay, 0x1D), "L1D"},
        {"LE", at(link_relay, 14), "LE"},
        {"R2047F", at(internal_relay, 32'767), "R2047F"},
        {"T12", at(timer, 12), "T12"},
        {"C9999", at(counter, 9999), "C9999"},
    };
    for (const auto& row : rows) {
        CAPTURE(row.text);
        const auto found = parse_device(row.text);
        REQUIRE(found.has_value());
        CHECK((*found == row.meant));
        CHECK(to_string(*found) == row.printed);
        CHECK(is_contact(*found) == std::holds_alternative<contact>(row.meant));
    }
}

TEST_CASE("mewtocol device: what is no name")
{
    for (const char* text :
         {"",    "DT",  "D100", "dt1",    "DT-1", "DT1F", "DT100000", "LD",     "WR", "WRF", "WX10000", "R",
          "R1G", "RFF", "R1f",  "R4096F", "X 1",  "T",    "T1F",      "T10000", "Q1", "IX0", "1F",      "SV"}) {
        CAPTURE(text);
        CHECK_FALSE(parse_device(text).has_value());
    }
}

TEST_SUITE_END();
