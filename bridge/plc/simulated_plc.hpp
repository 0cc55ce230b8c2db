// One simulated PLC: its memory and the MODBUS map that is in force since power-on.
#pragma once

#include "bridge/plc/modbus_map.hpp"
#include "bridge/plc/setup_program.hpp"

namespace plcgw::plc {

class simulated_plc {
public:
    simulated_plc(std::string name, const model& m, setup_program program);

    const std::string& name() const { return name_; }
    const plc::model& model() const { return memory_.model(); }
    plc::memory& memory() { return memory_; }
    const plc::memory& memory() const { return memory_; }
    const modbus_map& map() const { return map_; }

    // Error 0202 of the setup program, as it stands in D8402/D8403 too. The PLC runs with what was valid.
    const std::optional<parameter_fault>& fault() const { return program_.fault; }

private:
    void power_on();
    void set_special(device_kind kind, std::uint32_t number, std::uint16_t value);

    std::string name_;
    setup_program program_;
    plc::memory memory_;
    modbus_map map_;
};

}  // namespace plcgw::plc
