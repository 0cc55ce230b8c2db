// Error codes, details and flags of a station's channel, and who clears them: FX3 manual 6.1, 6.3 and 12.6, LS manual
// 9-6.
#include "tests/unit/station_bench.hpp"

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using test::server_1;
using test::station_bench;

namespace {

struct shown {
    std::uint16_t code, detail, serial;
    bool error, latched, serial_error;
    bool operator==(const shown&) const = default;
};

shown errors_of(const station_bench& b, unsigned channel)
{
    if (channel == 1)
        return {b.word("D8402"), b.word("D8403"), b.word("D8063"), b.bit("M8402"), b.bit("M8403"), b.bit("M8063")};
    return {b.word("D8422"), b.word("D8423"), b.word("D8438"), b.bit("M8422"), b.bit("M8423"), b.bit("M8438")};
}

constexpr shown nothing{0, 0, 0, false, false, false};

}  // namespace

TEST_CASE("station: an error shows on its own channel only, with 6321 or 3821")
{
    for (const unsigned channel : {1U, 2U}) {
        station_bench b("", plc::fx3u, channel);
        CHECK(errors_of(b, 1) == nothing);
        CHECK(errors_of(b, 2) == nothing);
        b.ask(test::bad_function);
        const std::uint16_t serial = channel == 1 ? 6321 : 3821;
        CHECK(errors_of(b, channel) == shown{209, 0, serial, true, true, true});
        CHECK(errors_of(b, 3 - channel) == nothing);
    }
}

TEST_CASE("station: what the line reports, its error code, counter and event")
{
    struct {
        const char* name;
        errc why;
        std::uint16_t code;
        counter counted;
        std::uint8_t logged;
    } const rows[] = {
        {"CRC or LRC", errc::bad_checksum, 205, counter::bus_communication_error, 0x82},
        {"too short", errc::too_short, 205, counter::bus_communication_error, 0x82},
        {"broken off", errc::incomplete, 205, counter::bus_communication_error, 0x82},
        {"our own reply came back changed", errc::collision, 204, counter::bus_communication_error, 0x82},
        {"too long", errc::overlong, 206, counter::character_overrun, 0x90},
        {"no hex digit", errc::bad_character, 208, counter::bus_communication_error, 0x82},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        station_bench b;
        b.station.bus_error(row.why);
        CHECK(errors_of(b, 1) == shown{row.code, 0, 6321, true, true, true});
        CHECK(b.count(row.counted) == 1);
        CHECK(b.count(counter::bus_message) == 0);
        CHECK(b.count(counter::bus_communication_error) + b.count(counter::character_overrun) == 1);
        CHECK(b.log() == buffer{row.logged});
    }
}

TEST_CASE("station: parity, framing and receive overrun are error 204")
{
    station_bench b;
    b.station.bit_error();
    CHECK(errors_of(b, 1) == shown{204, 0, 6321, true, true, true});
    CHECK(b.count(counter::bus_communication_error) == 1);
    CHECK(b.log() == buffer{0x82});
}

TEST_CASE("station: without its port it shows error 201 with the number of the channel")
{
    for (const unsigned channel : {1U, 2U}) {
        station_bench b("", plc::fx3u, channel);
        b.station.port_absent();
        const auto number = static_cast<std::uint16_t>(channel);
        const std::uint16_t serial = channel == 1 ? 6321 : 3821;
        CHECK(errors_of(b, channel) == shown{201, number, serial, true, true, true});
        CHECK(errors_of(b, 3 - channel) == nothing);
        CHECK(b.counters() == std::vector<std::uint16_t>(9));
        CHECK(b.log().empty());
    }
    station_bench refused("K248 D8414");
    refused.station.port_absent();
    CHECK(refused.word("D8402") == 202);
}

TEST_CASE("station: M8402 is of the current message, M8403, M8063 and the code stay (6.3)")
{
    station_bench b;
    b.ask(test::bad_function);
    b.ask(modbus::unit_id{2}, test::query);  // somebody else's message is not "another command"
    CHECK(b.bit("M8402"));
    b.ask(test::query);
    CHECK(errors_of(b, 1) == shown{209, 0, 6321, false, true, true});
    b.ask({0x03, 0xFF, 0xFF, 0x00, 0x01});
    CHECK(errors_of(b, 1) == shown{210, 0, 6321, true, true, true});
    b.tell_all({0x03, 0x00, 0x00, 0x00, 0x01});
    CHECK(errors_of(b, 1) == shown{215, 3, 6321, true, true, true});
    b.station.bus_error(errc::bad_checksum);
    CHECK(errors_of(b, 1) == shown{205, 0, 6321, true, true, true});  // without the older one's detail
    b.tell_all({0x06, 0x00, 0x00, 0x00, 0x01});
    CHECK_FALSE(b.bit("M8402"));
}

TEST_CASE("station: in listen-only mode damage still shows, requests do not")
{
    station_bench b;
    b.ask(test::listen_only);
    b.ask(test::bad_function);
    CHECK(errors_of(b, 1) == nothing);
    b.station.bus_error(errc::bad_checksum);
    CHECK(errors_of(b, 1) == shown{205, 0, 6321, true, true, true});
}

TEST_CASE("station: STOP -> RUN clears the flags of a server, not its codes; power-on clears all (6.1, 6.3)")
{
    for (const unsigned channel : {1U, 2U}) {
        station_bench b("", plc::fx3u, channel);
        const std::uint16_t serial = channel == 1 ? 6321 : 3821;
        b.tell_all({0x07});
        b.plc.stop();
        CHECK(errors_of(b, channel) == shown{215, 7, serial, true, true, true});
        b.plc.run();
        CHECK(errors_of(b, channel) == shown{215, 7, serial, false, false, false});
        b.plc.power_cycle();
        CHECK(errors_of(b, channel) == nothing);
    }
}

TEST_CASE("station: a client may clear the latched error by writing to the flags (7.11.6)")
{
    station_bench b;
    b.ask(test::bad_function);
    CHECK(b.ask({0x05, 0x1E, 0x3F, 0x00, 0x00}).has_value());  // M8063
    CHECK(b.ask({0x07}) == buffer{0x07, 0x00});
}

TEST_CASE("station: an LS shows the codes that its manual has, and only on channel 1")
{
    station_bench b("", plc::ls22);
    b.ask(test::bad_function);  // 209 is not in the list
    b.tell_all({0x03, 0x00, 0x00, 0x00, 0x01});
    b.ask({0x04, 0x00, 0x00, 0x00, 0x01});  // 210: its input registers lead nowhere
    b.station.bus_error(errc::bad_character);
    CHECK(b.word("D8402") == 0);
    CHECK_FALSE(b.bit("M8402"));
    b.ask({0x05, 0x00, 0x00, 0x12, 0x34});
    CHECK(b.word("D8402") == 216);
    CHECK(b.bit("M8402"));
    CHECK(b.bit("M8403"));
    CHECK(b.word("D8403") == 0);
    CHECK(b.word("D8063") == 0);  // not an LS register
    b.ask({0x03, 0x00, 0x00, 0x00, 0x00});
    CHECK(b.word("D8402") == 207);
    b.station.bus_error(errc::bad_checksum);
    CHECK(b.word("D8402") == 205);
    b.plc.stop();
    b.plc.run();
    CHECK(b.word("D8402") == 0);
    CHECK_FALSE(b.bit("M8403"));

    for (const unsigned channel : {2U, 3U}) {
        station_bench other("", plc::ls32, channel);
        other.ask({0x05, 0x00, 0x00, 0x12, 0x34});
        CHECK(other.word("D8402") == 0);
        CHECK(other.word("D8422") == 0);
        CHECK(other.ask({0x06, 0x00, 0x00, 0x00, 0x09}).has_value());
        CHECK(other.word("D0") == 9);
    }
}

TEST_CASE("station: models without a channel")
{
    plc::simulated_plc small("main", plc::fx3s, {});
    CHECK_THROWS_AS(modbus_station(small, modbus::unit_id{1}, 2), std::out_of_range);
    plc::simulated_plc fx("main", plc::fx3u, {});
    CHECK_THROWS_AS(modbus_station(fx, modbus::unit_id{1}, 3), std::out_of_range);
    CHECK_THROWS_AS(modbus_station(fx, modbus::unit_id{1}, 0), std::out_of_range);
}

TEST_CASE("station: a setup program that the PLC refuses leaves the station silent")
{
    const char* const refused[] = {
        "H1097 D8400, H11 D8401, K248 D8414",  // 6.1, D8414: will not respond to any requests
        "H1097 D8400, H11 D8401, K0 D8414",
        "H1097 D8400, H11 D8401",  // 0 is what D8414 is without a MOV
        "K248 D8414",
        "H10C7 D8400, H11 D8401, K1 D8414",  // baud code 1100
    };
    for (const char* moves : refused) {
        CAPTURE(moves);
        station_bench b(moves);
        CHECK(b.word("D8402") == 202);
        CHECK_FALSE(b.ask(test::query));
        CHECK_FALSE(b.tell_all({0x06, 0x00, 0x00, 0x00, 0x01}));
        b.station.bus_error(errc::bad_checksum);
        CHECK(b.counters() == std::vector<std::uint16_t>(9));
        CHECK(b.log().empty());
        CHECK(b.word("D0") == 0);
        CHECK(b.word("D8402") == 202);
    }
    station_bench two(std::string(server_1) + test::server_2, plc::fx3u, 2);  // channel 1 has priority
    CHECK_FALSE(two.ask(test::query));
    station_bench one(std::string(server_1) + test::server_2, plc::fx3u, 1);
    CHECK(one.ask(test::query) == test::query);
}

TEST_SUITE_END();
