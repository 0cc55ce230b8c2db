// One station of a PLC link at work: which words it sends and when, and where the words of the others go. FP7 manual
// 6.1 and 6.3. Words have the same numbers in all stations, counted from the beginning of each station's block.
//
// "If the areas are allocated wrongly, an error occurs and there is no communication" (6.3.6): a station whose number
// or send area belongs to another is refused, while those that were there before it go on. The manual does not say what
// becomes of the words of a station that is gone: here they stay as they were.
#pragma once

#include "bridge/plc/simulated_plc.hpp"
#include "bridge/plc_link_roll.hpp"

#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace plcgw {

struct plc_link_pace {
    duration shortest_pause{10'000};    // from one sending to the next
    duration longest_silence{200'000};  // unchanged words are sent again
    duration given_up{1'000'000};       // a station not heard for so long is gone
};

// For the log.
struct plc_link_event {
    enum class severity : std::uint8_t { info, warning } level{};
    std::string text;
};

class plc_link_exchange {
public:
    // `own` has no mistakes and the PLC is an FP7. The PLC lives as long as this.
    plc_link_exchange(std::string link, plc::simulated_plc& plc, plc_link_station own, plc_link_sender self,
                      plc_link_pace pace = {});

    const std::string& link() const { return link_; }
    const plc::simulated_plc& plc() const { return *plc_; }
    const plc_link_station& own() const { return own_; }

    // False when it is none of the words that this station sends.
    bool memory_changed(const plc::simulated_plc& plc, const plc::change& changed);

    // What is to be sent at this moment. At first at once, then when words changed, and now and then unchanged.
    std::optional<plc_link_area> next(time_point now, wall_time source);

    // Puts the words of another station into the PLC's memory, or refuses them. Those of other links and our own are
    // not looked at.
    void received(time_point now, const plc_link_area& area);
    void gone(time_point now, const plc_link_gone& who);
    void look(time_point now);  // gives up those that were silent for too long

    // The channel reset of the port (9.4.3, Y10): the others are taken in anew, and our words go out at once.
    void reset();

    time_point wake_at() const;  // when next() or look() is due although nothing happens

    std::vector<unsigned> others() const;                   // stations that take part
    std::vector<plc_link_seen> seen(time_point now) const;  // all that were heard since the start or a reset
    std::vector<plc_link_event> take_events() { return std::exchange(events_, {}); }

private:
    struct other {
        plc_link_sender sender;
        plc_link_settings settings;
        time_point heard{};
    };
    using sender_key = std::tuple<unsigned, std::string, std::string>;  // station, gateway, member

    std::optional<std::string> reason_to_refuse(const plc_link_area& area) const;
    std::string reservations(const plc_link_area& area) const;
    void store(const plc_link_area& area);
    void give_up(time_point now, std::map<unsigned, other>::iterator which);
    void say(const sender_key& of, plc_link_event::severity level, std::string text);
    std::string name_of(unsigned station, const plc_link_sender& sender) const;

    std::string link_;
    plc::simulated_plc* plc_;
    plc_link_station own_;
    plc_link_sender self_;
    plc_link_pace pace_;
    plc::place relays_;     // of word 0 of the block
    plc::place registers_;  // likewise
    std::map<unsigned, other> others_;
    std::map<sender_key, std::string> said_;  // the last about each, so that it is said once
    std::vector<plc_link_event> events_;
    plc_link_roll roll_;
    std::optional<time_point> sent_at_;
    bool changed_ = true;
    std::uint64_t sequence_ = 0;
};

}  // namespace plcgw
