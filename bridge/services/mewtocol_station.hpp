// One MEWTOCOL station of a line: an FP7's port as the frames on its line see it. An FP7 answers MEWTOCOL-COM and
// MEWTOCOL7-COM on one port, the header tells which, and so does this.
#pragma once

#include "bridge/services/fp7_access.hpp"
#include "bridge/services/mewtocol_service.hpp"

namespace plcgw {

struct mewtocol_station_options {
    unsigned number = 1;      // 1 to 999; beyond 99 MEWTOCOL-COM cannot name it
    bool answers_any = true;  // EE and EEE: one station of a line only
    mewtocol::command_set offered = mewtocol::fp7_commands;
    bool expansion = true;       // of MEWTOCOL-COM, as in mewtocol::server_options
    bool several_frames = true;  // likewise
    duration rest_kept{30'000'000};
    std::size_t max_contacts = 80;  // of MC
    std::size_t max_words = 16;     // of MD
    mewtocol7::dialect dialect{};
};

class mewtocol_station {
public:
    // The PLC is an FP7 and outlives the station.
    mewtocol_station(plc::simulated_plc& plc, mewtocol_station_options options);

    plc::simulated_plc& plc() const { return access_.plc(); }

    // The bytes to send to what a line's framer brought; nothing when this station is silent.
    std::optional<buffer> hear(time_point now, const mewtocol::reception& r);

    // Messages in several frames and what MC and MD registered are forgotten, as when the power comes on.
    void reset();

private:
    mewtocol_station_options options_;
    fp7_access access_;
    mewtocol::server normal_;
    mewtocol7::server seven_;
    mewtocol_registrations registered_;
    unsigned power_ons_;
};

// Whether a client may send the same bytes: pieces of messages have no mark that tells who speaks.
bool is_like_request(bytes reply);

}  // namespace plcgw
