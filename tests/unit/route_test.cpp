#include "tests/support/plc_fixture.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using plcgw::test::fx3u_fixture;
using plcgw::test::modbus_question;
using words = std::vector<std::uint16_t>;

namespace {

constexpr auto coils = table::coils;
constexpr auto discrete = table::discrete_inputs;
constexpr auto input = table::input_registers;
constexpr auto holding = table::holding_registers;

}  // namespace

TEST_CASE("route: the question of a read is the same every time")
{
    fx3u_fixture f;
    CHECK(modbus_question(f.route_to("D100", holding, 0x10, 3)) == request{read_table{holding, address{0x10}, 3}});
    CHECK(modbus_question(f.route_to("D100", input, 0, 125)) == request{read_table{input, address{0}, 125}});
    CHECK(modbus_question(f.route_to("M0", discrete, 7, 1)) == request{read_table{discrete, address{7}, 1}});
    CHECK(modbus_question(f.route_to("M0", coils, 7, 2000)) == request{read_table{coils, address{7}, 2000}});
}

TEST_CASE("route: the question of a write carries what the memory holds now")
{
    fx3u_fixture f;
    f.set("D100", 0x1234);
    f.set("D101", 0xABCD);
    f.set("M20", 0x0005);
    const auto write = [&](const char* device, table to, std::uint16_t count) {
        return modbus_question(f.route_to(device, to, 9, count, direction::write));
    };
    CHECK(write("D100", holding, 1) == request{write_single_register{address{9}, 0x1234}});
    CHECK(write("D100", holding, 2) == request{write_multiple_registers{address{9}, {0x1234, 0xABCD}}});
    CHECK(write("M20", coils, 1) == request{write_single_coil{address{9}, true}});
    CHECK(write("M20", coils, 3) == request{write_multiple_coils{address{9}, {true, false, true}}});
    CHECK(write("M20", holding, 1) == request{write_single_register{address{9}, 0x0005}});  // bits into a register
    CHECK(write("D100", coils, 4) ==
          request{write_multiple_coils{address{9}, {false, false, true, false}}});  // a register into bits
    f.set("D100", 1);
    CHECK(write("D100", holding, 1) == request{write_single_register{address{9}, 1}});
}

TEST_CASE("route: what was read lands in the devices")
{
    fx3u_fixture f;
    route registers = f.route_to("D100", holding, 0, 2);
    store(registers, question_of(registers), registers_read{{0x1234, 0xABCD}});
    CHECK(f.word("D100") == 0x1234);
    CHECK(f.word("D101") == 0xABCD);
    CHECK(f.word("D102") == 0);
    CHECK(registers.words == words{0x1234, 0xABCD});

    route bits = f.route_to("X5", discrete, 0, 3);
    store(bits, question_of(bits), bits_read{{true, false, true}});
    CHECK(f.bit("X5"));
    CHECK_FALSE(f.bit("X6"));
    CHECK(f.bit("X7"));
    CHECK_FALSE(f.bit("X10"));
    CHECK(bits.words == words{0b101});
}

TEST_CASE("route: registers go into bit devices, bits into registers")
{
    fx3u_fixture f;
    f.set_bit("M99", true);
    f.set_bit("M132", true);
    route into_bits = f.route_to("M100", input, 0, 2);  // M100 begins inside a register of the image
    store(into_bits, question_of(into_bits), registers_read{{0x8001, 0x0002}});
    for (const char* on : {"M99", "M100", "M115", "M117", "M132"})
        CHECK_MESSAGE(f.bit(on), on);
    for (const char* off : {"M101", "M114", "M116", "M118", "M131"})
        CHECK_MESSAGE(!f.bit(off), off);
    CHECK(into_bits.words == words{0x8001, 0x0002});
    CHECK(bits_of(into_bits) == 32);

    f.set("D101", 0xFF00);
    route into_words = f.route_to("D100", coils, 0, 20);
    std::vector<bool> values(20);
    values[0] = values[15] = values[16] = true;
    store(into_words, question_of(into_words), bits_read{values});
    CHECK(f.word("D100") == 0x8001);
    CHECK(f.word("D101") == 0xFF01);  // the bits behind the last one stay
    CHECK(into_words.words == words{0x8001, 0x0001});
    CHECK(bits_of(into_words) == 20);
}

TEST_CASE("route: a write that was taken says what was written, the memory may have gone on")
{
    fx3u_fixture f;
    f.set("D100", 7);
    f.set("D101", 8);
    f.set("M0", 0x0003);
    struct {
        const char* device;
        table to;
        std::uint16_t count;
        words said;
    } const rows[] = {
        {"D100", holding, 1, {7}}, {"D100", holding, 2, {7, 8}}, {"M0", coils, 1, {1}}, {"M0", coils, 18, {3, 0}}};
    for (const auto& row : rows) {
        CAPTURE(row.device);
        route r = f.route_to(row.device, row.to, 0, row.count, direction::write);
        const request asked = modbus_question(r);
        f.set(row.device, 0x00F0);
        store(r, asked, written{});
        CHECK(r.words == row.said);
        CHECK(f.word(row.device) == 0x00F0);
        f.set(row.device, row.said[0] == 1 ? 3 : row.said[0]);
    }
}

TEST_CASE("route: an exception changes nothing")
{
    fx3u_fixture f;
    route r = f.route_to("D100", holding, 0, 1);
    r.words = {5};
    store(r, question_of(r), exception_code::server_device_busy);
    CHECK(r.words == words{5});
    CHECK_FALSE(f.plc.memory().has_changes());
}

TEST_CASE("route: its sample")
{
    fx3u_fixture f;
    route r = f.route_to("D100", input, 0x20, 2);
    r.name = "boiler.temperatures";
    r.words = {1, 2};
    r.state = quality::comm_error;
    r.source = wall_time{77};
    const sample registers = sample_of(r);
    CHECK(registers.route == "boiler.temperatures");
    CHECK(registers.area == "input");
    CHECK(registers.first == 0x20);
    CHECK(registers.format == sample_format::words);
    CHECK(registers.count == 2);
    CHECK(registers.words == words{1, 2});
    CHECK(registers.state == quality::comm_error);
    CHECK(registers.source == wall_time{77});

    const sample bits = sample_of(f.route_to("M0", coils, 3, 20));
    CHECK(bits.area == "coil");
    CHECK(bits.format == sample_format::bits);
    CHECK(bits.count == 20);
    CHECK(bits.state == quality::never_read);
    CHECK(bits.source == wall_time::never);
    CHECK(sample_of(f.route_to("D0", holding, 0, 1)).area == "holding");
    CHECK(sample_of(f.route_to("M0", discrete, 0, 1)).area == "discrete");
}

TEST_CASE("route: which changes of a memory touch it")
{
    fx3u_fixture f;
    const fx3u_fixture other;
    const route registers = f.route_to("D100", holding, 0, 10);
    const std::size_t area = registers.at.area;
    CHECK(touches(registers, f.plc, {area, 16 * 109, 16}));
    CHECK(touches(registers, f.plc, {area, 0, 16 * 101}));
    CHECK_FALSE(touches(registers, f.plc, {area, 16 * 110, 16}));
    CHECK_FALSE(touches(registers, f.plc, {area, 0, 16 * 100}));
    CHECK_FALSE(touches(registers, f.plc, {area + 1, 16 * 100, 16}));
    CHECK_FALSE(touches(registers, other.plc, {area, 16 * 100, 16}));

    const route bits = f.route_to("M10", coils, 0, 3);
    CHECK(touches(bits, f.plc, {bits.at.area, 12, 1}));
    CHECK_FALSE(touches(bits, f.plc, {bits.at.area, 9, 1}));  // in the same register of the image
    CHECK_FALSE(touches(bits, f.plc, {bits.at.area, 13, 3}));

    const route registers_as_bits = f.route_to("M100", holding, 0, 1);  // M100-M115
    CHECK(touches(registers_as_bits, f.plc, {bits.at.area, 115, 1}));
    CHECK_FALSE(touches(registers_as_bits, f.plc, {bits.at.area, 116, 1}));
}

TEST_SUITE_END();
