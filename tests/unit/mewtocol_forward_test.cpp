// MODBUS requests to a MEWTOCOL station, by table 8.2 of the FP7 manual.
#include "bridge/services/mewtocol_forward.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using mewtocol::block;
using mewtocol::contact_area;
using mewtocol::read_run;
using mewtocol::read_words;
using mewtocol::word_area;
using mewtocol::write_run;
using mewtocol::write_words;
using modbus::address;
using modbus::exception_code;
using modbus::table;

namespace {

struct row {
    modbus::request asked;
    std::vector<block> meant;
};

modbus::request read(table from, unsigned first, std::uint16_t count)
{
    return modbus::read_table{from, address(first), count};
}

exception_code refused(const modbus::request& asked)
{
    const auto blocks = blocks_of(asked);
    REQUIRE(blocks.has_error());
    return blocks.error();
}

}  // namespace

TEST_CASE("mewtocol forward: the map of an FP7, first and last of each row")
{
    const row rows[] = {
        {read(table::coils, 0, 3), {read_run{{contact_area::external_output, 0}, 3}}},
        {read(table::coils, 0x7FF, 1), {read_run{{contact_area::external_output, 0x7FF}, 1}}},
        {read(table::coils, 0x800, 2), {read_run{{contact_area::internal_relay, 0}, 2}}},
        {read(table::coils, 0x87FF, 1), {read_run{{contact_area::internal_relay, 32'767}, 1}}},
        {read(table::discrete_inputs, 0x1FFF, 1), {read_run{{contact_area::external_input, 8191}, 1}}},
        {read(table::holding_registers, 0, 125), {read_words{word_area::dt, 0, 125}}},
        {read(table::holding_registers, 0xFFFF, 1), {read_words{word_area::dt, 65'535, 1}}},
        {read(table::input_registers, 0x3FF, 1), {read_words{word_area::wl, 1023, 1}}},
        {read(table::input_registers, 0x7D0, 1), {read_words{word_area::ld, 0, 1}}},
        {read(table::input_registers, 0x47CF, 1), {read_words{word_area::ld, 16'383, 1}}},
        // Across two rows
        {read(table::coils, 0x7FE, 4),
         {read_run{{contact_area::external_output, 0x7FE}, 2}, read_run{{contact_area::internal_relay, 0}, 2}}},
        {modbus::write_multiple_coils{address{0x7FF}, {true, false, true}},
         {write_run{{contact_area::external_output, 0x7FF}, {true}},
          write_run{{contact_area::internal_relay, 0}, {false, true}}}},
        {modbus::write_single_coil{address{0x810}, true}, {write_run{{contact_area::internal_relay, 16}, {true}}}},
        {modbus::write_single_register{address{5}, 0x1234}, {write_words{word_area::dt, 5, {0x1234}}}},
        {modbus::write_multiple_registers{address{5}, {1, 2}}, {write_words{word_area::dt, 5, {1, 2}}}},
        {modbus::read_write_multiple_registers{address{10}, 2, address{5}, {1}},
         {write_words{word_area::dt, 5, {1}}, read_words{word_area::dt, 10, 2}}},
    };
    for (const row& each : rows) {
        CAPTURE(static_cast<int>(modbus::function_of(each.asked)));
        const auto blocks = blocks_of(each.asked);
        REQUIRE(blocks.has_value());
        CHECK((*blocks == each.meant));
    }
}

TEST_CASE("mewtocol forward: what the map does not have, and what is no device")
{
    CHECK(refused(read(table::coils, 0x8800, 1)) == exception_code::illegal_data_address);
    CHECK(refused(read(table::coils, 0x87FF, 2)) == exception_code::illegal_data_address);
    CHECK(refused(read(table::discrete_inputs, 0x2000, 1)) == exception_code::illegal_data_address);
    CHECK(refused(read(table::input_registers, 0x400, 1)) == exception_code::illegal_data_address);
    CHECK(refused(read(table::input_registers, 0x3FF, 2)) == exception_code::illegal_data_address);
    CHECK(refused(read(table::holding_registers, 0xFFFF, 2)) == exception_code::illegal_data_address);
    CHECK(refused(modbus::read_write_multiple_registers{address{0xFFFF}, 2, address{5}, {1}}) ==
          exception_code::illegal_data_address);
    CHECK(refused(modbus::write_multiple_coils{address{0x87FF}, {true, true}}) == exception_code::illegal_data_address);
    CHECK(refused(modbus::mask_write_register{address{0}, 1, 2}) == exception_code::illegal_function);
    CHECK(refused(modbus::report_server_id{}) == exception_code::illegal_function);
    CHECK(refused(modbus::diagnostics{modbus::diagnostic::return_query_data, {0, 1}}) ==
          exception_code::illegal_function);
}

TEST_CASE("mewtocol forward: answers, of several blocks too")
{
    using mewtocol::contacts_read;
    using mewtocol::executed;
    using mewtocol::words_read;
    CHECK((modbus_answer(read(table::holding_registers, 0, 2), {words_read{{1, 2}}}) ==
           modbus::response{modbus::registers_read{{1, 2}}}));
    CHECK((modbus_answer(read(table::coils, 0x7FE, 3), {contacts_read{{true, false}}, contacts_read{{true}}}) ==
           modbus::response{modbus::bits_read{{true, false, true}}}));
    CHECK((modbus_answer(modbus::write_single_register{address{5}, 1}, {executed{}}) ==
           modbus::response{modbus::written{}}));
    CHECK((modbus_answer(modbus::write_single_register{address{5}, 1}, {mewtocol::no_response{}}) ==
           modbus::response{modbus::no_response{}}));
    CHECK((modbus_answer(modbus::read_write_multiple_registers{address{0}, 1, address{5}, {1}},
                         {executed{}, words_read{{9}}}) == modbus::response{modbus::registers_read{{9}}}));
}

TEST_CASE("mewtocol forward: error codes of the station as exceptions")
{
    using mewtocol::error_code;
    const struct {
        error_code said;
        exception_code told;
    } rows[] = {
        {error_code::data, exception_code::illegal_data_address},
        {error_code::parameter, exception_code::illegal_data_address},
        {error_code::busy, exception_code::server_device_busy},
        {error_code::procedure, exception_code::server_device_busy},
        {error_code::not_supported, exception_code::illegal_function},
        {error_code::protection, exception_code::server_device_failure},
        {error_code{0x99}, exception_code::server_device_failure},
    };
    for (const auto& row : rows)
        CHECK((modbus_answer(read(table::coils, 0, 1), {row.said}) == modbus::response{row.told}));
}

TEST_SUITE_END();
