// One server station of a serial line, RTU or ASCII: what an FX3's or LS's slave does with the frames on its bus. FX3
// manual chapters 6, 7, 9 and 12.6. No time, no ports: the line's driver tells what it saw and sends what is returned.
#pragma once

#include "bridge/services/diagnostics.hpp"
#include "bridge/services/station_checks.hpp"

namespace plcgw {

// For each frame on the line the driver calls, in this order: bus_message() of every station on it, or bus_error() if
// the frame was damaged; answer(); and after a reply has left, sent(). Frames of the line's other stations of ours
// count as messages too: their bus does not tell who sent them.
class modbus_station {
public:
    // The channel is as the manual counts: 1 or 2, LS 1 to 3. Tells the PLC that it is a server there.
    modbus_station(plc::simulated_plc& plc, modbus::unit_id unit, unsigned channel);

    modbus::unit_id unit() const { return unit_; }
    unsigned channel() const { return channel_; }
    plc::simulated_plc& plc() const { return *plc_; }

    void bus_message();        // a frame with a good check: anybody's request or response
    void bus_error(errc why);  // a damaged one: bad_checksum, too_short, incomplete, overlong, bad_character
    void bit_error();          // the same when the port says parity, framing or receive overrun

    void port_absent();  // the serial port is not there: what a PLC says without its adapter (error 0201)

    // The PDU of the reply. Nothing for other stations' requests, broadcasts, in listen-only mode, and when the PLC's
    // setup program forbids the channel to operate.
    std::optional<buffer> answer(const modbus::frame& request);

    // The reply has left: its event is logged, a restart and a new delimiter take effect.
    void sent();

    // As of now: power-on and STOP -> RUN of the PLC are seen.
    const comm_counters& counters();
    const event_log& log();
    bool listen_only();
    std::uint8_t delimiter();  // the character behind CR that ends an ASCII frame

private:
    // What waits for the reply to leave.
    struct reply_pending {
        std::uint8_t event;
        std::optional<modbus::diagnostics> effect;
    };

    void damaged(plc::modbus_error error);
    bool follow_plc();  // false: this channel does not operate
    void count(counter which);
    std::optional<buffer> serve_request(bytes pdu, cast to);
    std::optional<buffer> refuse(std::uint8_t function_code, const refusal& why, cast to);
    std::optional<buffer> reply_with(buffer pdu, std::uint8_t event, std::optional<modbus::diagnostics> effect);
    void listen(bytes pdu);
    void take_effect(const modbus::diagnostics& d);
    void restart(const modbus::diagnostics& d);
    void set_listen_only(bool on);
    void set_delimiter(std::uint8_t character);
    void show_status();

    plc::simulated_plc* plc_;
    modbus::unit_id unit_;
    unsigned channel_;
    comm_counters counters_;
    event_log log_;
    bool listen_only_ = false;
    std::uint8_t delimiter_;
    std::optional<reply_pending> pending_;
    unsigned power_ons_;
    unsigned starts_;
};

}  // namespace plcgw
