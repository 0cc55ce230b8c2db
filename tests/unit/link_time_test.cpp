// Link time, FX3 manual 2.2: its example, and where its own steps contradict its formulas.
#include "bridge/link_time.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("serial");

using namespace plcgw;
using namespace std::chrono_literals;
using modbus::function;
using plc::framing;

namespace {

// Read holding registers 0-9 in RTU at 19200 bit/s with 10 bits per character.
constexpr link_time_input manual_example{
    .format = {.baud_rate = 19200, .data_bits = 8, .check = parity::none, .stop_bits = 1},
    .mode = framing::rtu,
    .request_bytes = 8,
    .response_bytes = 25,
    .message_delay = 5ms,
    .max_scan = 5ms,
    .server_delay = 10ms,
};

// The manual prints one decimal of a millisecond.
bool is_about(duration t, duration printed) { return t > printed - 50us && t <= printed + 50us; }

}  // namespace

TEST_CASE("link time: the manual's example for the client")
{
    constexpr client_link_time t = client_time(manual_example);
    CHECK(t.t4 == 5ms);
    CHECK(t.t1 == 10ms);
    CHECK(t.t6 == 1ms);
    CHECK(is_about(t.t7, 5200us));
    CHECK(t.t8 == 10ms);
    CHECK(is_about(t.t9, 14000us));
    CHECK(is_about(t.t10, 2800us));
    CHECK(is_about(t.t5, 33000us));
    CHECK(t.t2 == 35ms);
    CHECK(t.t3 == 1ms);
    // The manual prints 41 ms, because its sum takes 5 ms for T1 although it has just found 10 ms.
    CHECK(t.total == 46ms);
}

TEST_CASE("link time: the manual's example for the server")
{
    constexpr server_link_time t = server_time(manual_example);
    CHECK(is_about(t.t14, 5200us));
    CHECK(t.t15 == 5ms);
    CHECK(is_about(t.t11, 15200us));
    CHECK(t.t12 == 1ms);
    CHECK(is_about(t.t13, 14000us));
    CHECK(is_about(t.total, 30200us));
}

TEST_CASE("link time: ASCII has no silence at the end of a frame")
{
    link_time_input in = manual_example;
    in.mode = framing::ascii;
    CHECK(client_time(in).t10 == 0us);
    CHECK(client_time(in).t5 == client_time(manual_example).t5 - client_time(manual_example).t10);
}

TEST_CASE("link time: a time that ends with a scan takes one more")
{
    CHECK(whole_scans(0us, 5ms) == 5ms);
    CHECK(whole_scans(4999us, 5ms) == 5ms);
    CHECK(whole_scans(5ms, 5ms) == 10ms);
    CHECK(whole_scans(33ms, 5ms) == 35ms);
}

TEST_CASE("link time: D8411 below 3.5 characters means 3.5 characters")
{
    link_time_input in = manual_example;
    in.message_delay = 0ms;
    CHECK(client_time(in).t4 == 1823us);  // 35 bits at 19200 bit/s
    CHECK(server_time(in).t15 == 1823us);
    in.message_delay = 2ms;
    CHECK(client_time(in).t4 == 2ms);
    in.format.baud_rate = 115200;
    in.message_delay = 1ms;
    CHECK(client_time(in).t4 == 1750us);
}

TEST_CASE("link time: sizes of requests and responses")
{
    struct row {
        unsigned code;
        std::size_t count;
        std::size_t write_count;
        std::optional<pdu_sizes> expected;
    };
    const row rows[] = {
        {0x01, 1, 0, pdu_sizes{5, 3}},
        {0x01, 2000, 0, pdu_sizes{5, 252}},
        {0x01, 2001, 0, {}},
        {0x02, 9, 0, pdu_sizes{5, 4}},
        {0x03, 10, 0, pdu_sizes{5, 22}},
        {0x03, 125, 0, pdu_sizes{5, 252}},
        {0x03, 126, 0, {}},
        {0x03, 0, 0, {}},
        {0x04, 1, 0, pdu_sizes{5, 4}},
        {0x05, 1, 0, pdu_sizes{5, 5}},
        {0x06, 1, 0, pdu_sizes{5, 5}},
        {0x06, 2, 0, {}},
        {0x07, 1, 0, pdu_sizes{1, 2}},
        {0x08, 1, 0, pdu_sizes{5, 5}},
        {0x0B, 1, 0, pdu_sizes{1, 5}},
        {0x0C, 0, 0, pdu_sizes{1, 8}},
        {0x0C, 64, 0, pdu_sizes{1, 72}},
        {0x0C, 65, 0, {}},
        {0x0F, 10, 0, pdu_sizes{8, 5}},
        {0x0F, 1968, 0, pdu_sizes{252, 5}},
        {0x0F, 1969, 0, {}},
        {0x10, 2, 0, pdu_sizes{10, 5}},
        {0x10, 123, 0, pdu_sizes{252, 5}},
        {0x10, 124, 0, {}},
        {0x11, 1, 0, pdu_sizes{1, 4}},
        {0x16, 1, 0, pdu_sizes{7, 7}},
        {0x17, 6, 3, pdu_sizes{16, 14}},
        {0x17, 125, 121, pdu_sizes{252, 252}},
        {0x17, 1, 122, {}},
        {0x17, 1, 0, {}},
        {0x09, 1, 0, {}},
        {0x2B, 1, 0, {}},
    };
    for (const row& each : rows) {
        CAPTURE(each.code);
        CAPTURE(each.count);
        CHECK(sizes_of(function{static_cast<std::uint8_t>(each.code)}, each.count, each.write_count) == each.expected);
    }
    CHECK(adu_size(5, framing::rtu) == 8);
    CHECK(adu_size(22, framing::rtu) == 25);
    CHECK(adu_size(5, framing::ascii) == 17);
    CHECK(adu_size(253, framing::ascii) == 513);  // the manual's limit
}

TEST_SUITE_END();
