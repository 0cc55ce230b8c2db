// Reads the operands of one ADPRW from the devices, and keeps the first that is wrong: error 218 of FX3 manual 12.6.
#pragma once

#include "bridge/plc/adprw_program.hpp"
#include "bridge/plc/adprw_table.hpp"
#include "bridge/plc/memory.hpp"

namespace plcgw::plc {

// D8067 of an operation error.
enum class operation_error : std::uint16_t {
    wrong_device = 6705,  // the operand may not be such a device
    out_of_range = 6706,  // its value may not be that, or not all the devices that it occupies exist
};

struct operand_fault {
    unsigned operand{};  // 1 to 5: S, S1, S2, S3, S4/D
    operation_error why{};
    bool operator==(const operand_fault&) const = default;
};

// After a fault everything reads as 0, so that nobody has to look after each operand. `allowed` is of `operands` above.
class operand_reader {
public:
    operand_reader(const adprw& of, const memory& devices) : operands_(of.operands), devices_(devices) {}

    // S to S3 are K, H, D or R.
    std::uint16_t value(unsigned number, std::uint16_t least = 0, std::uint16_t most = 0xFFFF);
    std::pair<std::uint16_t, std::uint16_t> pair(unsigned number);  // in two registers

    // S4/D: its devices, or what is in them. A constant stands for every register of a block.
    std::optional<place> block(unsigned allowed, std::size_t bits);
    std::vector<std::uint16_t> words(unsigned allowed, std::size_t count);
    std::vector<bool> coils(unsigned allowed, std::size_t count);  // bit devices, or the bits of words
    bool coil(unsigned allowed);                                   // a bit device, or a word that is 0 or 1

    bool is_constant(unsigned number) const;
    void refuse(unsigned number, operation_error why);
    const std::optional<operand_fault>& fault() const { return fault_; }

private:
    std::optional<place> find(unsigned number, unsigned allowed, std::size_t bits);

    const std::array<operand, 5>& operands_;
    const memory& devices_;
    std::optional<operand_fault> fault_;
};

}  // namespace plcgw::plc
