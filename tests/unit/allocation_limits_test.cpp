// Which sets of D8470-D8485 the FX3U takes, FX3 manual 9.4.1: size, head and range of every device code.
#include "bridge/plc/modbus_map.hpp"
#include "bridge/plc/models/fx3u.hpp"
#include "tests/support/print.hpp"

#include <string>

TEST_SUITE_BEGIN("plc");

using namespace plcgw;
using namespace plcgw::plc;
using modbus::address;
using modbus::table;

namespace {

enum code : unsigned { m, s, ts, cs, y, x, m_words, s_words, ts_words, cs_words, y_words, x_words, d, r, tn, cn };

struct limit_row {
    code device;
    unsigned blocks;
    unsigned head;
    unsigned numbers;  // coils or registers that it takes; 0 = invalid
};

// clang-format off
const limit_row rows[] = {
    // bit devices as coils: 16 in a block, head a multiple of 8, within the range, normal and special M apart
    {m,  480,    0, 7680}, {m, 481,    0, 0}, {m, 1, 7664, 16}, {m, 1, 7672, 0}, {m, 1, 7680, 0}, {m, 1, 7992, 0},
    {m,    1,    8,   16}, {m,   1,    4, 0}, {m, 1,    1,  0}, {m, 1, 7679, 0},
    {m,   32, 8000,  512}, {m,  33, 8000, 0}, {m, 1, 8008, 16}, {m, 1, 8496, 16}, {m, 1, 8504, 0}, {m, 1, 8512, 0},
    {s,  256,    0, 4096}, {s, 257,    0, 0}, {s, 1,   24, 16}, {s, 1,   20, 0}, {s, 1, 4096, 0},
    {ts,  32,    0,  512}, {ts, 33,    0, 0}, {ts, 1,   8, 16}, {ts, 1,  12, 0},
    {cs,  16,    0,  256}, {cs, 17,    0, 0}, {cs, 1, 248,  0}, {cs, 1, 240, 16},
    {y,   16,    0,  256}, {y,  17,    0, 0},
    {x,   16,    0,  256}, {x,  17,    0, 0},
    // the decimal digits of the register are the octal number: K20 is X20, the 17th point
    {x, 1, 20, 16}, {x, 1, 10, 16}, {y, 1, 360, 16}, {y, 1, 370, 0}, {x, 1, 400, 0}, {x, 1, 16, 0}, {x, 1, 8, 0},
    {x_words, 1, 20, 1}, {x_words, 1, 10, 0}, {y_words, 1, 360, 1}, {y_words, 1, 38, 0},
    // the same as holding registers: one register in a block, head a multiple of 16
    {m_words,  480,    0, 480}, {m_words, 481,    0, 0}, {m_words, 1,   16, 1}, {m_words, 1,  8, 0}, {m_words, 1, 24, 0},
    {m_words,   32, 8000,  32}, {m_words,  33, 8000, 0}, {m_words, 1, 8008, 0}, {m_words, 1, 8496, 1},
    {s_words,  256,    0, 256}, {s_words, 257,    0, 0}, {s_words, 1,    8, 0},
    {ts_words,  32,    0,  32}, {ts_words, 33,    0, 0}, {ts_words, 1,   8, 0},
    {cs_words,  16,    0,  16}, {cs_words, 17,    0, 0}, {cs_words, 2, 240, 0}, {cs_words, 1, 240, 1},
    {y_words,   16,    0,  16}, {y_words,  17,    0, 0},
    {x_words,   16,    0,  16}, {x_words,  17,    0, 0},
    // D and R: 16 registers in a block, any head; normal and special D apart
    {d,  500,    0, 8000}, {d, 501,    0, 0}, {d, 1,    1, 16}, {d, 1, 7984, 16}, {d, 1, 7985, 0}, {d, 2, 7984, 0},
    {d,   32, 8000,  512}, {d,  33, 8000, 0}, {d, 1, 8496, 16}, {d, 1, 8497,  0}, {d, 1, 8512, 0},
    {r, 2048,    0, 32768}, {r, 2048, 1, 0}, {r, 1, 32752, 16}, {r, 1, 32753, 0}, {r, 1, 32768, 0}, {r, 1, 65535, 0},
    // the size field has 12 bits, sizes end at 2048
    {r, 0x801, 0, 0}, {r, 0xFFF, 0, 0}, {tn, 0x801, 0, 0},
    // TN and CN: one device in a block, 16-bit and 32-bit counters apart
    {tn, 512,    0,  512}, {tn, 513,   0, 0}, {tn, 1, 511, 1}, {tn, 2, 511, 0}, {tn, 1, 512, 0},
    {cn, 200,    0,  200}, {cn, 201,   0, 0}, {cn, 1, 199, 1}, {cn, 2, 199, 0},
    {cn,  56,  200,  112}, {cn,  57, 200, 0}, {cn, 1, 255, 2}, {cn, 2, 255, 0}, {cn, 1, 256, 0},
};
// clang-format on

}  // namespace

TEST_CASE("allocation: size, head and range of every device code")
{
    const memory devices(fx3u);
    for (const limit_row& row : rows) {
        CAPTURE(row.device);
        CAPTURE(row.blocks);
        CAPTURE(row.head);
        allocation sets{static_cast<std::uint16_t>(row.device << 12 | row.blocks),
                        static_cast<std::uint16_t>(row.head)};
        const allocation wanted = sets;
        std::optional<allocation_fault> fault;
        const modbus_map map = modbus_map::user_defined(fx3u, sets, fault);
        REQUIRE(fault.has_value() == (row.numbers == 0));
        if (fault) {
            CHECK(fault->detail == 8470);
            CHECK_FALSE(fault->reason.empty());
            CHECK(sets == allocation{});
            continue;
        }
        CHECK(sets == wanted);
        const table in = row.device < m_words ? table::coils : table::holding_registers;
        CHECK(map.find(devices, in, address{0}, row.numbers).has_value());
        CHECK_FALSE(map.find(devices, in, address{0}, row.numbers + 1).has_value());
    }
}

TEST_CASE("allocation: the engineer is told what is wrong")
{
    const auto reason = [](std::uint16_t code_and_size, std::uint16_t head) {
        allocation sets{code_and_size, head};
        std::optional<allocation_fault> fault;
        modbus_map::user_defined(fx3u, sets, fault);
        REQUIRE(fault.has_value());
        return fault->reason;
    };
    CHECK(reason(0xD801, 0) == "size 2049 is more than 2048 blocks");
    CHECK(reason(0x0001, 4) == "head M4 is no multiple of 8 points");
    CHECK(reason(0x6001, 8) == "head M8 is no multiple of 16 points");
    CHECK(reason(0x0001, 7700) == "M7700 does not exist in this PLC");
    CHECK(reason(0x5011, 0) == "X0-X417 exceeds the range of this PLC, which ends at X377");
    CHECK(reason(0xF002, 199) == "CN199-CN200 exceeds the range of this PLC, which ends at CN199");
}

TEST_CASE("allocation: the head of X and Y is the octal number in decimal digits")
{
    allocation sets{0x5001, 20};
    std::optional<allocation_fault> fault;
    const auto map = modbus_map::user_defined(fx3u, sets, fault);
    const memory memory(fx3u);
    REQUIRE_FALSE(fault);
    CHECK(map.find(memory, table::coils, address{0}, 1)->front().at == memory.find(*parse_device("X20")));
    CHECK(map.find(memory, table::coils, address{15}, 1)->front().at == memory.find(*parse_device("X37")));
}

TEST_SUITE_END();
