// MEWTOCOL commands on the memory of an FP7. FP7 serial communication manual 7.2; where MEWTOCOL-COM knows less than an
// FP7 has, bridge/plc/mewtocol_areas.hpp says which devices are meant.
//
// It has WX WY WR WL, DT, LD and the values of timers and counters. WX cannot be written: 60. Nothing is protected.
#pragma once

#include "bridge/plc/simulated_plc.hpp"
#include "bridge/services/mewtocol_access.hpp"

namespace plcgw {

class fp7_access final : public mewtocol_access {
public:
    // A simulated PLC has no scan of its own: one takes `scan`, while it is in RUN.
    explicit fp7_access(plc::simulated_plc& plc, duration scan = std::chrono::milliseconds(10));

    plc::simulated_plc& plc() const { return *plc_; }

    // To be called before each command: time passes for scans(). RUN and STOP between two calls are not seen.
    void look(time_point now);

    answer<std::vector<std::uint16_t>> read_words(mewtocol::word_area from, std::uint32_t first,
                                                  std::uint32_t count) const override;
    refusal write_words(mewtocol::word_area to, std::uint32_t first, std::span<const std::uint16_t> values) override;
    answer<bool> read_contact(const mewtocol::contact& at) const override;
    refusal write_contacts(std::span<const mewtocol::contact_value> values) override;
    std::uint32_t words_in(mewtocol::word_area area) const override;
    mewtocol::plc_status status() const override;
    answer<mewtocol7::state_read> state() const override;
    refusal change_mode(mewtocol::operating_mode to) override;
    std::uint64_t scans() const override;

private:
    plc::simulated_plc* plc_;
    duration scan_;
    std::optional<time_point> looked_;
    duration in_run_{};
};

}  // namespace plcgw
