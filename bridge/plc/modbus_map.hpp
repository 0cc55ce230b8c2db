// Which device stands behind a coil, discrete input, input register or holding register of a PLC: the model's default
// (FX3 manual 9.3) or the user-defined allocation D8470-D8485 (9.4).
#pragma once

#include "bridge/plc/memory.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace plcgw::plc {

// Consecutive MODBUS numbers whose devices follow each other in one area.
struct extent {
    place at;
    std::size_t count{};  // bits in a bit table, registers in a register table
};

// D8470-D8485: eight sets of device code, size and head device.
using allocation = std::array<std::uint16_t, 16>;

inline constexpr std::uint32_t allocation_first = 8470;  // D number of allocation[0]

struct allocation_fault {
    std::uint32_t detail{};  // D number of the first invalid set's first register, as D8403 reports it
    std::string reason;      // for the engineer
};

class modbus_map {
public:
    static modbus_map standard(const model& m);

    // The sets before the first invalid one stay in force, the others are set to 0 in `sets`, as the PLC does. Without
    // any valid set the default map stays.
    static modbus_map user_defined(const model& m, allocation& sets, std::optional<allocation_fault>& fault);

    // Nothing when any of the numbers leads nowhere: exception 02.
    std::optional<std::vector<extent>> find(const memory& of, modbus::table table, modbus::address first,
                                            std::size_t count) const;

    const std::vector<map_row>& rows() const { return rows_; }

private:
    std::vector<map_row> rows_;  // each table's rows in the order of their numbers
};

}  // namespace plcgw::plc
