// One simulated PLC: its memory, the MODBUS map in force since power-on, RUN and STOP, and the special devices that
// show the state of its MODBUS channels (FX3 manual chapter 6 and 12.5).
#pragma once

#include "bridge/plc/setup_check.hpp"

namespace plcgw::plc {

// The line of the configuration that stands behind a channel. What the setup program says of it goes before this, in
// D8400, D8401 and D8414; D8405 shows what is in force.
struct channel_line {
    role as = role::server;
    std::uint8_t station = 0;  // of a server; 0 = not said
    framing mode = framing::rtu;
    bool rs485 = false;
    std::optional<character_format> format{};  // nothing: no serial line, or not said
};

enum class run_state : std::uint8_t { stop, run };

class simulated_plc {
public:
    simulated_plc(std::string name, const model& m, setup_program program);  // powered on, in RUN

    const std::string& name() const { return name_; }
    const plc::model& model() const { return memory_.model(); }
    plc::memory& memory() { return memory_; }
    const plc::memory& memory() const { return memory_; }
    const modbus_map& map() const { return setup_.map; }

    // The first error 0202 of the setup program, as it stands in D8402/D8403 too. The PLC runs with what was valid.
    const std::optional<parameter_fault>& fault() const { return fault_; }
    const std::vector<setup_fault>& faults() const { return setup_.faults; }  // all, error 0203 among them

    // The switch. STOP -> RUN clears counters, event logs, what belongs to the client's last instruction, and M8402,
    // M8403 and M8063 or M8438; D8402 and D8403 of a client only. RUN -> STOP clears nothing here.
    void run();
    void stop();
    run_state state() const { return state_; }

    // Clears all devices and checks the setup program again. The switch stays where it is.
    void power_cycle();

    // Who keeps state beside the devices compares these: how often the power came on, and how often RUN began with it.
    unsigned power_ons() const { return power_ons_; }
    unsigned starts() const { return starts_; }

    const std::vector<channel_state>& channels() const { return setup_.channels; }
    const channel_state& channel_at(unsigned number) const;  // throws std::out_of_range

    // A line of the configuration stands behind this channel, whatever the program says. Power cycles keep it.
    void attach(unsigned channel, const channel_line& line);
    void attach(unsigned channel, role as) { attach(channel, channel_line{.as = as}); }

    // Error code and detail, the error flag and its latch, and the serial error of this channel (12.6).
    void show_error(unsigned channel, modbus_error code, std::uint16_t detail = 0);

    // Special devices by their number in special_registers.hpp; 0 is none. Those that the manuals mark "R" change by
    // these alone, but for the error flags: "can be cleared by a program or a peripheral device" (7.11.6).
    void show_register(std::uint32_t number, std::uint16_t value);
    void show_flag(std::uint32_t number, bool on);
    bool flag(std::uint32_t number) const;

private:
    void power_on();
    void clear_devices();
    void show_state();
    void show_channel(const channel_state& c);
    void show_line(const channel_state& c, const channel_line& line);
    void protect_read_only();

    std::string name_;
    setup_program program_;
    plc::memory memory_;
    checked_setup setup_;
    std::optional<parameter_fault> fault_;
    std::map<unsigned, channel_line> attached_;  // by channel number
    run_state state_ = run_state::run;
    unsigned power_ons_ = 0;
    unsigned starts_ = 0;
};

}  // namespace plcgw::plc
