// A search for stations: what is asked, and what the answers say.
#include "bridge/scan/station_scan.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;

namespace {

const request first_holding{read_table{table::holding_registers, address{0}, 1}};
const request name_request{read_device_identification{read_device_identification::access::basic, 0}};

std::vector<station_number> units(unsigned first, unsigned last)
{
    std::vector<station_number> all;
    for (unsigned unit = first; unit <= last; ++unit)
        all.emplace_back(unit);
    return all;
}

request ask(station_scan& scan, unsigned unit)
{
    const auto q = scan.next();
    REQUIRE(q.has_value());
    CHECK(number(q->unit) == unit);
    CHECK_FALSE(scan.next().has_value());  // one at a time
    return std::get<request>(q->asked);
}

device_identification_read named(const char* vendor, const char* product)
{
    device_identification_read read;
    read.objects = {{0, vendor}, {1, product}};
    return read;
}

}  // namespace

TEST_CASE("scan: who is silent is asked once; who answers is asked for its name and its tables")
{
    station_scan scan(scan_language::modbus, units(4, 6));
    CHECK(ask(scan, 4) == first_holding);
    scan.failed(make_error_code(errc::timed_out));
    CHECK(ask(scan, 5) == first_holding);
    scan.answered(response{registers_read{{7}}});
    CHECK(ask(scan, 5) == name_request);
    scan.answered(response{named("Acme", "PM\x1b[5")});  // its escape sequence reaches no terminal
    CHECK(ask(scan, 5) == request{read_table{table::input_registers, address{0}, 1}});
    scan.answered(response{exception_code::illegal_data_address});
    CHECK(ask(scan, 5) == request{read_table{table::coils, address{0}, 1}});
    scan.answered(response{bits_read{{true}}});
    CHECK(ask(scan, 5) == request{read_table{table::discrete_inputs, address{0}, 1}});
    scan.failed(make_error_code(errc::timed_out));
    CHECK(ask(scan, 6) == first_holding);
    CHECK(scan.units_asked() == 2);
    CHECK_FALSE(scan.is_over());
    scan.failed(make_error_code(errc::timed_out));
    CHECK(scan.is_over());
    CHECK_FALSE(scan.next().has_value());
    CHECK(scan.questions() == 7);

    REQUIRE(scan.found().size() == 1);
    const scan_finding& found = scan.found().front();
    CHECK(number(found.unit) == 5);
    CHECK(found.identification == "Acme PM.[5");
    REQUIRE(found.areas.size() == 4);
    CHECK(area_name(found.areas[0].first) == "holding");
    CHECK(found.areas[0].what == scanned_area::says::values);
    CHECK(found.areas[1].reason == "exception 02 (illegal data address)");
    CHECK(found.areas[2].what == scanned_area::says::values);
    CHECK(found.areas[3].what == scanned_area::says::nothing);
}

TEST_CASE("scan: an exception is an answer, but 0A and 0B are those of a gateway before nobody")
{
    station_scan scan(scan_language::modbus, units(1, 3));
    ask(scan, 1);
    scan.answered(response{exception_code::gateway_target_failed_to_respond});
    ask(scan, 2);
    scan.answered(response{exception_code::gateway_path_unavailable});
    ask(scan, 3);
    scan.answered(response{exception_code::illegal_function});
    REQUIRE(scan.found().size() == 1);
    CHECK(number(scan.found()[0].unit) == 3);
    CHECK(scan.found()[0].areas[0].what == scanned_area::says::refused);
}

TEST_CASE("scan: who does not tell its name by 2B is asked by 11")
{
    struct {
        buffer data;
        const char* shown;
    } const rows[] = {
        {{0x0A, 'M', 'e', 't', 'e', 'r', 0xFF}, "Meter"},
        {{0xF3, 0xFF}, "server id F3 FF"},
    };
    for (const auto& row : rows) {
        CAPTURE(row.shown);
        station_scan scan(scan_language::modbus, units(1, 1));
        ask(scan, 1);
        scan.answered(response{registers_read{{0}}});
        CHECK(ask(scan, 1) == name_request);
        scan.answered(response{exception_code::illegal_function});
        CHECK(ask(scan, 1) == request{report_server_id{}});
        scan.answered(response{server_id_read{row.data}});
        CHECK(scan.found()[0].identification == row.shown);
    }
}

TEST_CASE("scan: a damaged answer is something, and a line that somebody else uses is said")
{
    station_scan scan(scan_language::modbus, units(1, 3));
    ask(scan, 1);
    scan.failed(make_error_code(errc::bad_checksum));
    for (int i = 0; i < 3; ++i) {
        ask(scan, 2);
        scan.failed(make_error_code(errc::line_not_quiet));
    }
    ask(scan, 3);
    scan.interrupted();  // the port went away: it is asked again
    ask(scan, 3);
    scan.failed(make_error_code(errc::timed_out));
    CHECK(scan.is_over());
    CHECK(scan.disturbed() == 1);
    REQUIRE(scan.found().size() == 1);
    CHECK(scan.found()[0].is_damaged);
    CHECK(number(scan.found()[0].unit) == 1);
}

TEST_CASE("scan: a MEWTOCOL station is read at DT0, and an error is an answer")
{
    station_scan scan(scan_language::mewtocol, units(1, 1));
    const auto q = scan.next();
    REQUIRE(q.has_value());
    CHECK(
        (std::get<mewtocol::block>(q->asked) == mewtocol::block{mewtocol::read_words{mewtocol::word_area::dt, 0, 1}}));
    scan.answered(mewtocol::response{mewtocol::error_code::data});
    REQUIRE(scan.found().size() == 1);
    CHECK(area_name(scan.found()[0].areas[0].first) == "DT");
    CHECK(scan.found()[0].areas[0].what == scanned_area::says::refused);
    CHECK(scan.next().has_value());
    scan.failed(make_error_code(errc::timed_out));
    CHECK(scan.next().has_value());
    scan.answered(mewtocol::response{mewtocol::contacts_read{{true}}});
    CHECK(scan.is_over());
    CHECK(scan.found()[0].areas.size() == 3);
}
