// ASCII stations that were told to end their frames with another character (diagnostics 03).
#include "tests/support/line_fixture.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::test;

namespace {

struct told_pump : line_fixture {
    told_pump()
    {
        line.port_opened();
        const auto q = ask({modbus::diagnostics{modbus::diagnostic::change_ascii_delimiter, {'$', 0}}});
        answer(q, modbus::diagnostics_answered{{'$', 0}});
    }
    client_line::question ask(modbus::request what, modbus::unit_id unit = modbus::unit_id{5})
    {
        line.forward(unit, std::move(what));
        return next();
    }
};

const modbus::request some_read = modbus::read_table{modbus::table::coils, modbus::address{0}, 1};

}  // namespace

TEST_CASE("modbus line: a station that was told its delimiter is spoken to with it, its neighbour is not")
{
    told_pump f;
    CHECK(f.ask(some_read).timing.delimiter == '$');
    CHECK(f.ask(some_read, modbus::unit_id{6}).timing.delimiter == '\n');
}

TEST_CASE(
    "modbus line: a delimiter that was told to all is used for all, and a station that did not hear it is found out")
{
    told_pump f;
    const auto q =
        f.ask(modbus::diagnostics{modbus::diagnostic::change_ascii_delimiter, {'#', 0}}, modbus::unit_id::broadcast);
    f.answer(q, modbus::no_response{});
    CHECK(f.ask(some_read).timing.delimiter == '#');
    CHECK(f.ask(modbus::write_single_coil{}, modbus::unit_id::broadcast).timing.delimiter == '#');
    const auto other = f.ask(some_read, modbus::unit_id{6});
    CHECK(other.timing.delimiter == '#');
    f.fail(other);
    CHECK(f.ask(some_read, modbus::unit_id{6}).timing.delimiter == '\n');
}

TEST_CASE("modbus line: who asks may bring a delimiter, but what the station was told goes before it")
{
    told_pump f;
    modbus::serial_options own;
    own.delimiter = '#';
    f.line.forward(modbus::unit_id{6}, some_read, own);
    CHECK(f.next().timing.delimiter == '#');
    f.line.forward(modbus::unit_id{5}, some_read, own);
    CHECK(f.next().timing.delimiter == '$');
}

TEST_CASE("modbus line: a refused delimiter is not used")
{
    line_fixture f;
    f.line.port_opened();
    f.line.forward(modbus::unit_id{5}, modbus::diagnostics{modbus::diagnostic::change_ascii_delimiter, {'$', 0}});
    f.answer(f.next(), modbus::exception_code::illegal_function);
    f.line.forward(modbus::unit_id{5}, some_read);
    CHECK(f.next().timing.delimiter == '\n');
}

TEST_CASE("modbus line: a told station that falls silent is asked in both ways by turns, for its power may have failed")
{
    told_pump f;
    f.fail(f.ask(some_read));
    const auto second = f.ask(some_read);
    CHECK(second.timing.delimiter == '\n');
    f.answer(second, modbus::bits_read{{true}});
    CHECK(f.ask(some_read).timing.delimiter == '\n');
}

TEST_SUITE_END();
