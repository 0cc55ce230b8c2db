// What the models answer, and the special registers of their channels: FX3 manual 6.1, 6.3 and 7.1 (the Chinese
// edition's table for FX3S), LS manual 4-1, 4-3 and 7-1.
#include "bridge/plc/model.hpp"
#include "tests/support/print.hpp"

#include <string>

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using namespace plcgw::plc;

namespace {

using codes = std::vector<unsigned>;

codes codes_of(std::span<const modbus::function> functions)
{
    codes list;
    for (const modbus::function each : functions)
        list.push_back(static_cast<unsigned>(each));
    return list;
}

struct manual_model {
    const char* name;
    codes serial;
    codes tcp;
    std::size_t channels;
    bool ascii;
    bool user_defined_map;
};

const codes basic = {1, 2, 3, 4, 5, 6, 0x0F, 0x10};
const codes basic_tcp = {1, 2, 3, 4, 5, 6, 0x0F, 0x10, 0x2B};
const codes fx3u_all = {1, 2, 3, 4, 5, 6, 7, 8, 0x0B, 0x0C, 0x0F, 0x10, 0x11, 0x16, 0x17};
const codes fx3u_tcp = {1, 2, 3, 4, 5, 6, 0x0F, 0x10, 0x16, 0x17, 0x2B};
const codes ls_all = {1, 2, 3, 4, 5, 6, 0x0F, 0x10, 0x17};
const codes ls_tcp = {1, 2, 3, 4, 5, 6, 0x0F, 0x10, 0x17, 0x2B};

// clang-format off
const manual_model manual_models[] = {
    // name   serial    TCP        channels  ASCII  D8470-D8485
    {"FX3S",  basic,    basic_tcp, 1,        false, false},
    {"FX3G",  basic,    basic_tcp, 2,        false, false},
    {"FX3GC", basic,    basic_tcp, 2,        false, false},
    {"FX3U",  fx3u_all, fx3u_tcp,  2,        true,  true},
    {"FX3UC", fx3u_all, fx3u_tcp,  2,        true,  true},
    {"LS22",  ls_all,   ls_tcp,    3,        true,  false},
    {"LS32",  ls_all,   ls_tcp,    3,        true,  false},
    {"FP7",   basic,    basic,     3,        false, false},
};

struct register_row {
    std::uint32_t channel_registers::*which;
    std::uint32_t fx3_1, fx3_2, ls_1, ls_2, ls_3;
    bool fx3u_only = false;
};

const register_row register_rows[] = {
    //                                      FX3         LS
    {&channel_registers::format,            8400, 8420, 8400, 8420, 8413},
    {&channel_registers::protocol,          8401, 8421, 0,    0,    0},
    {&channel_registers::error_code,        8402, 8422, 8402, 0,    0},
    {&channel_registers::error_detail,      8403, 8423, 0,    0,    0},
    {&channel_registers::error_step,        8404, 8424, 8404, 0,    0},
    {&channel_registers::format_display,    8405, 8425, 0,    0,    0},
    {&channel_registers::delimiter,         8406, 8426, 0,    0,    0, true},
    {&channel_registers::executing_step,    8407, 8427, 8407, 0,    0},
    {&channel_registers::retry_value,       8408, 8428, 8408, 0,    0},
    {&channel_registers::response_timeout,  8409, 8429, 8409, 0,    0},
    {&channel_registers::turnaround_delay,  8410, 8430, 0,    0,    0},
    {&channel_registers::message_delay,     8411, 8431, 0,    0,    0},
    {&channel_registers::retries,           8412, 8432, 8412, 0,    0},
    {&channel_registers::station,           8414, 8434, 8414, 8434, 8437},
    {&channel_registers::status_setup,      8415, 8435, 0,    0,    0, true},
    {&channel_registers::status_head,       8416, 8436, 0,    0,    0, true},
    {&channel_registers::serial_error,      8063, 8438, 0,    0,    0},
    {&channel_registers::mode,              8419, 8439, 0,    0,    0},
};

struct flag_row {
    std::uint32_t channel_flags::*which;
    std::uint32_t fx3_1, fx3_2, ls_1, ls_2, ls_3;
    bool fx3u_only = false;
};

const flag_row flag_rows[] = {
    {&channel_flags::setup_request,         8411, 8411, 8411, 8411, 8411},  // LS: ours
    {&channel_flags::completed,             8029, 8029, 8029, 0,    0},
    {&channel_flags::busy,                  8401, 8421, 8401, 0,    0},
    {&channel_flags::error,                 8402, 8422, 8402, 0,    0},
    {&channel_flags::error_latched,         8403, 8423, 8403, 0,    0},
    {&channel_flags::listen_only,           8404, 8424, 0,    0,    0, true},
    {&channel_flags::retrying,              8408, 8428, 8408, 0,    0},
    {&channel_flags::timeout,               8409, 8429, 8409, 0,    0},
    {&channel_flags::serial_error,          8063, 8438, 0,    0,    0},
};
// clang-format on

// The number that the table above has for a model's channel, counted from 0.
template <class Row>
std::uint32_t expected(const Row& row, const model& m, std::size_t channel)
{
    if (m.format == format_style::ls)
        return channel == 0 ? row.ls_1 : channel == 1 ? row.ls_2 : row.ls_3;
    if (row.fx3u_only && !m.ascii)
        return 0;
    return channel == 0 ? row.fx3_1 : row.fx3_2;
}

bool is_ls(const model& m) { return m.name.starts_with("LS"); }

}  // namespace

TEST_CASE("models: functions, channels and frame modes are the manuals'")
{
    REQUIRE(all_models().size() == std::size(manual_models));
    for (const manual_model& row : manual_models) {
        CAPTURE(row.name);
        const model* const m = find_model(row.name);
        REQUIRE(m != nullptr);
        CHECK(codes_of(m->serial_functions) == row.serial);
        CHECK(codes_of(m->functions) == row.tcp);
        CHECK(m->channels.size() == row.channels);
        CHECK(m->ascii == row.ascii);
        CHECK(m->user_defined_map == row.user_defined_map);
        CHECK(m->one_channel == (m->programs && !is_ls(*m)));
        CHECK((m->errors == error_style::ls) == is_ls(*m));
        CHECK((m->format == format_style::ls) == is_ls(*m));
        CHECK((m->timers == timer_names::plain) == is_ls(*m));
    }
}

TEST_CASE("models: the transport decides what is answered")
{
    using modbus::function;
    const model& fx3u = *find_model("FX3U");
    CHECK(answers(fx3u, function::diagnostics, transport::serial));
    CHECK_FALSE(answers(fx3u, function::diagnostics, transport::tcp));
    CHECK_FALSE(answers(fx3u, function::encapsulated_interface, transport::serial));
    CHECK(answers(fx3u, function::encapsulated_interface, transport::tcp));
    CHECK_FALSE(answers(*find_model("FX3G"), function::mask_write_register, transport::serial));
    CHECK_FALSE(answers(*find_model("LS22"), function::mask_write_register, transport::tcp));
    CHECK_FALSE(answers(fx3u, function{0x14}, transport::serial));
}

TEST_CASE("models: special registers and flags of every channel")
{
    for (const model* m : all_models())
        for (std::size_t i = 0; m->programs && i < m->channels.size(); ++i) {
            CAPTURE(std::string(m->name));
            CAPTURE(i);
            const channel& of = m->channels[i];
            CHECK(of.number == i + 1);
            CHECK(of.client == (!is_ls(*m) || i == 0));
            for (std::size_t row = 0; row < std::size(register_rows); ++row) {
                CAPTURE(row);
                CHECK(of.registers.*register_rows[row].which == expected(register_rows[row], *m, i));
            }
            for (std::size_t row = 0; row < std::size(flag_rows); ++row) {
                CAPTURE(row);
                CHECK(of.flags.*flag_rows[row].which == expected(flag_rows[row], *m, i));
            }
            CHECK(of.serial_error_value == (is_ls(*m) ? 0 : i == 0 ? 6321 : 3821));
        }
}

TEST_CASE("models: every special register and flag of a channel is a device of its model")
{
    for (const model* m : all_models())
        for (const channel& of : m->channels) {
            CAPTURE(std::string(m->name));
            for (const register_row& row : register_rows)
                if (const std::uint32_t number = of.registers.*row.which; number != 0)
                    CHECK(exists(*m, {device_kind::d, number}));
            for (const flag_row& row : flag_rows)
                if (const std::uint32_t number = of.flags.*row.which; number != 0)
                    CHECK(exists(*m, {device_kind::m, number}));
        }
}

TEST_CASE("models: devices that only fill up a register do not exist")
{
    const model& fx3s = *find_model("FX3S");
    for (const char* there : {"CS31", "CS200", "CS255", "CN31", "CN200", "Y15", "X17", "TS137", "D2999", "M1535"})
        CHECK_MESSAGE(exists(fx3s, *parse_device(there)), there);
    for (const char* absent :
         {"CS32", "CS192", "CS199", "CS256", "CN32", "CN199", "Y16", "X20", "TS138", "D3000", "R0"})
        CHECK_MESSAGE(!exists(fx3s, *parse_device(absent)), absent);
}

TEST_SUITE_END();
