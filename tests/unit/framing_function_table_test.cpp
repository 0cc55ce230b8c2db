#include "protocols/modbus/function_table.hpp"
#include "protocols/modbus/response.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;

namespace {

const read_table coils{table::coils, address{0x13}, 37};
const read_table registers{table::holding_registers, address{0x6B}, 3};

struct row {
    const char* name;
    request question;
    response answer;
};

// clang-format off
const row rows[] = {
    {"01", coils, bits_read{std::vector<bool>(37, true)}},
    {"02", read_table{table::discrete_inputs, address{0}, 2000}, bits_read{std::vector<bool>(2000)}},
    {"03", registers, registers_read{{1, 2, 3}}},
    {"04", read_table{table::input_registers, address{0}, 125}, registers_read{std::vector<std::uint16_t>(125)}},
    {"05", write_single_coil{address{1}, true}, written{}},
    {"06", write_single_register{address{1}, 3}, written{}},
    {"07", read_exception_status{}, exception_status_read{0x6D}},
    {"0B", get_comm_event_counter{}, event_counter_read{0xFFFF, 0x0108}},
    {"0C", get_comm_event_log{}, event_log_read{0, 0x0108, 0x0121, {0x20, 0x00}}},
    {"0F", write_multiple_coils{address{0x13}, std::vector<bool>(1968)}, written{}},
    {"10", write_multiple_registers{address{1}, std::vector<std::uint16_t>(123)}, written{}},
    {"11", report_server_id{}, server_id_read{{0xF3, 0xFF}}},
    {"16", mask_write_register{address{4}, 0xF2, 0x25}, written{}},
    {"17", read_write_multiple_registers{address{3}, 6, address{14}, {0xFF, 0xFF, 0xFF}},
           registers_read{{1, 2, 3, 4, 5, 6}}},
    {"2B", read_device_identification{read_device_identification::access::basic, 0},
           device_identification_read{read_device_identification::access::basic, 1, 0, 0, {{0, "FX3U"}, {1, ""}}}},
};
// clang-format on

using length_of = std::optional<std::size_t> (*)(bytes);

// Nothing until the bytes tell, then the size, whatever follows.
void check(length_of told, buffer pdu)
{
    const std::size_t size = pdu.size();
    CHECK(told(pdu) == size);
    for (std::size_t came = 0; came < size; ++came) {
        const auto so_far = told(bytes(pdu).first(came));
        CHECK((!so_far || so_far == size));
    }
    pdu.push_back(0x55);
    CHECK(told(pdu) == size);
}

}  // namespace

TEST_CASE("function table: requests and responses are as long as we make them")
{
    for (const row& each : rows) {
        CAPTURE(each.name);
        check(request_length, encode_request(each.question));
        check(response_length, encode_response(each.question, each.answer));
        check(response_length, encode_response(each.question, exception_code::illegal_data_address));
    }
    const diagnostics loopback{diagnostic::return_query_data, {0xA5, 0x37}};
    check(request_length, encode_request(loopback));
}

TEST_CASE("function table: files and queues, of V1.1b3 sections 6.14, 6.15 and 6.18")
{
    check(request_length, {0x14, 0x07, 0x06, 0x00, 0x04, 0x00, 0x01, 0x00, 0x02});
    check(response_length, {0x14, 0x06, 0x05, 0x06, 0x0D, 0xFE, 0x00, 0x20});
    check(request_length, {0x15, 0x09, 0x06, 0x00, 0x04, 0x00, 0x07, 0x00, 0x01, 0x06, 0xAF});
    check(request_length, {0x18, 0x04, 0xDE});
    check(response_length, {0x18, 0x00, 0x06, 0x00, 0x02, 0x01, 0xB8, 0x12, 0x84});
}

TEST_CASE("function table: where no length is known, or no such frame can be")
{
    CHECK(request_length(buffer{0x41}) == 0U);
    CHECK(response_length(buffer{0x41}) == 0U);
    CHECK(response_length(buffer{0x08, 0, 0}) == 0U);  // as long as the request
    CHECK(request_length(buffer{0x2B, 0x0D}) == 0U);   // CANopen
    CHECK(request_length(buffer{0x83}) == 0U);         // an exception is a response
    CHECK(response_length(buffer{0x03, 0x00}) == 0U);  // no data
    CHECK(response_length(buffer{0x03, 0x05}) == 0U);  // half a register
    CHECK(request_length(buffer{0x10, 0, 0, 0, 1, 1}) == 0U);
    CHECK(request_length(buffer{0x10, 0, 0, 0, 1, 4}) == 0U);  // two registers, of one
    CHECK(request_length(buffer{0x0F, 0, 0, 0, 9, 1}) == 0U);
    CHECK(request_length(buffer{0x14, 0x08}) == 0U);  // a group has seven bytes
}

TEST_SUITE_END();
