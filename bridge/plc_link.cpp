#include "bridge/plc_link.hpp"

#include <algorithm>

namespace plcgw {
namespace {

struct range_rule {
    std::string_view setting;
    unsigned plc_link_settings::*value;
    unsigned most;
};

// Table 6.2.3.
constexpr range_rule ranges[] = {
    {"block", &plc_link_settings::block, 1},
    {"max_station", &plc_link_settings::max_station, most_link_stations},
    {"relay_words", &plc_link_settings::relay_words, link_block_relay_words},
    {"register_words", &plc_link_settings::register_words, link_block_registers},
    {"relay_first", &plc_link_settings::relay_first, 63},
    {"relay_count", &plc_link_settings::relay_count, 64},
    {"register_first", &plc_link_settings::register_first, 127},
    {"register_count", &plc_link_settings::register_count, 127},
};

// Link relays and link registers have the same rules.
struct link_area {
    std::string_view name;
    std::string_view words_setting;
    std::string_view first_setting;
    std::string_view count_setting;
    unsigned plc_link_settings::*words;
    unsigned plc_link_settings::*first;
    unsigned plc_link_settings::*count;
};

constexpr link_area areas[] = {
    {"WL", "relay_words", "relay_first", "relay_count", &plc_link_settings::relay_words,
     &plc_link_settings::relay_first, &plc_link_settings::relay_count},
    {"LD", "register_words", "register_first", "register_count", &plc_link_settings::register_words,
     &plc_link_settings::register_first, &plc_link_settings::register_count},
};

class checker {
public:
    explicit checker(std::span<const plc_link_station> stations) : stations_(stations) {}

    std::vector<plc_link_mistake> result()
    {
        for (std::size_t i = 0; i < stations_.size(); ++i) {
            check_alone(i);
            for (std::size_t before = 0; before < i; ++before)
                check_pair(i, before);
        }
        return std::move(found_);
    }

private:
    void complain(std::size_t i, std::string_view setting, std::string text)
    {
        found_.push_back({i, setting, std::move(text)});
    }

    void check_alone(std::size_t i)
    {
        const auto& [station, s] = stations_[i];
        if (station < 1 || station > most_link_stations)
            complain(i, "station", "is " + std::to_string(station) + ", but a PLC link has the stations 1 to 16");
        else if (s.max_station <= most_link_stations && station > effective_max_station(s))
            complain(i, "station",
                     "is " + std::to_string(station) + ", above the highest station of this PLC, which is " +
                         std::to_string(effective_max_station(s)));
        for (const range_rule& rule : ranges)
            if (s.*rule.value > rule.most)
                complain(i, rule.setting,
                         "is " + std::to_string(s.*rule.value) + ", expected 0 to " + std::to_string(rule.most));
        for (const link_area& a : areas)
            if (s.*a.count != 0 && s.*a.first + s.*a.count > s.*a.words)
                complain(i, a.count_setting,
                         "sends " + sent(a, s) + ", but this PLC uses only " + std::to_string(s.*a.words) +
                             " words for the link: raise " + std::string(a.words_setting));
    }

    void check_pair(std::size_t i, std::size_t before)
    {
        const plc_link_station& a = stations_[i];
        const plc_link_station& b = stations_[before];
        if (a.station == b.station) {
            complain(i, "station",
                     "is " + std::to_string(a.station) +
                         " a second time: each station has its own number, and one send area");
            return;
        }
        if (effective_max_station(a.settings) != effective_max_station(b.settings))
            complain(i, "max_station",
                     "is " + std::to_string(a.settings.max_station) + ", but " +
                         std::to_string(b.settings.max_station) + " in " + name_of(b) +
                         ": it must be the same in all of them");
        for (const link_area& area : areas) {
            check_overlap(area, i, b);
            check_seen(area, i, a.settings, b);
            check_seen(area, before, b.settings, a);
        }
    }

    void check_overlap(const link_area& in, std::size_t i, const plc_link_station& b)
    {
        const plc_link_settings& s = stations_[i].settings;
        const plc_link_settings& o = b.settings;
        const bool both = s.*in.count != 0 && o.*in.count != 0;
        if (both && s.*in.first < o.*in.first + o.*in.count && o.*in.first < s.*in.first + s.*in.count)
            complain(i, in.first_setting,
                     "sends " + sent(in, s) + ", which overlaps with " + sent(in, o) + " of " + name_of(b));
    }

    // 6.3.5: what is received has the same numbers as what is sent, so it must lie within what the receiver uses.
    void check_seen(const link_area& in, std::size_t receiver, const plc_link_settings& s, const plc_link_station& from)
    {
        if (from.settings.*in.count != 0 && from.settings.*in.first + from.settings.*in.count > s.*in.words)
            complain(receiver, in.words_setting,
                     "is " + std::to_string(s.*in.words) + ", but " + name_of(from) + " sends " +
                         sent(in, from.settings) + ": raise it, it would not be seen here");
    }

    static std::string sent(const link_area& a, const plc_link_settings& s)
    {
        const std::string name(a.name);
        return name + std::to_string(s.*a.first) + "-" + name + std::to_string(s.*a.first + s.*a.count - 1);
    }

    static std::string name_of(const plc_link_station& s) { return "station " + std::to_string(s.station); }

    std::span<const plc_link_station> stations_;
    std::vector<plc_link_mistake> found_;
};

}  // namespace

std::vector<plc_link_mistake> check_plc_link(std::span<const plc_link_station> stations)
{
    return checker(stations).result();
}

std::vector<unsigned> absent_link_stations(std::span<const plc_link_station> stations)
{
    unsigned highest = 0;
    for (const plc_link_station& each : stations)
        highest = std::max(highest, std::min(effective_max_station(each.settings), most_link_stations));
    std::vector<unsigned> absent;
    for (unsigned number = 1; number <= highest; ++number)
        if (std::none_of(stations.begin(), stations.end(), [&](const auto& each) { return each.station == number; }))
            absent.push_back(number);
    return absent;
}

}  // namespace plcgw
