#include "bridge/plc_link_exchange.hpp"

#include <algorithm>
#include <array>

namespace plcgw {
namespace {

using severity = plc_link_event::severity;

constexpr std::size_t most_said = 64;  // senders that are remembered; a foreign one may make up any number of names

plc::place word_at(plc::place block, unsigned word) { return {block.area, block.bit + std::size_t{16} * word}; }

// Such a station can take part all the same: words that one of the two does not use are not seen there.
bool is_reservation(const plc_link_mistake& m)
{
    return m.setting == "max_station" || m.setting == "relay_words" || m.setting == "register_words";
}

std::string text_of(const plc_link_mistake& m) { return std::string(m.setting) + " " + m.text; }

std::vector<plc_link_mistake> check_pair(const plc_link_station& before, const plc_link_station& after)
{
    return check_plc_link(std::array{before, after});
}

}  // namespace

plc_link_exchange::plc_link_exchange(std::string link, plc::simulated_plc& plc, plc_link_station own,
                                     plc_link_sender self, plc_link_pace pace)
    : link_(std::move(link)), plc_(&plc), own_(own), self_(std::move(self)), pace_(pace),
      relays_(plc.memory().find(link_relay_word(own.settings, 0)).value()),
      registers_(plc.memory().find(link_register(own.settings, 0)).value())
{
}

bool plc_link_exchange::memory_changed(const plc::simulated_plc& plc, const plc::change& changed)
{
    const plc_link_settings& s = own_.settings;
    const auto within = [&](plc::place block, unsigned first, unsigned count) {
        return count != 0 && plc::overlaps(changed, word_at(block, first), std::size_t{16} * count);
    };
    const bool sent = &plc == plc_ && (within(relays_, s.relay_first, s.relay_count) ||
                                       within(registers_, s.register_first, s.register_count));
    changed_ = changed_ || sent;
    return sent;
}

std::optional<plc_link_area> plc_link_exchange::next(time_point now, wall_time source)
{
    if (sent_at_ && now < *sent_at_ + (changed_ ? pace_.shortest_pause : pace_.longest_silence))
        return std::nullopt;
    sent_at_ = now;
    changed_ = false;

    const plc_link_settings& s = own_.settings;
    plc_link_area area{link_, self_, own_, ++sequence_, source, {}, {}};
    area.relays.resize(s.relay_count);
    area.registers.resize(s.register_count);
    plc_->memory().read(word_at(relays_, s.relay_first), area.relays);
    plc_->memory().read(word_at(registers_, s.register_first), area.registers);
    return area;
}

time_point plc_link_exchange::wake_at() const
{
    if (!sent_at_)
        return time_point::min();
    time_point at = *sent_at_ + (changed_ ? pace_.shortest_pause : pace_.longest_silence);
    for (const auto& [number, each] : others_)
        at = std::min(at, each.heard + pace_.given_up);
    return at;
}

void plc_link_exchange::received(time_point now, const plc_link_area& area)
{
    const unsigned number = area.station.station;
    if (area.link != link_ || (number == own_.station && area.sender == self_))
        return;
    const auto known = others_.find(number);
    if (known != others_.end() && known->second.sender == area.sender &&
        known->second.settings == area.station.settings) {
        known->second.heard = now;
        roll_.heard(now, area);
        store(area);
        return;
    }

    const sender_key key{number, area.sender.gateway, area.sender.member};
    if (const auto why = reason_to_refuse(area)) {
        say(key, severity::warning, name_of(number, area.sender) + " is refused: " + *why);
        roll_.heard(now, area, plc_link_state::refused, *why);
        return;
    }
    others_[number] = {area.sender, area.station.settings, now};
    const std::string but = reservations(area);
    say(key, but.empty() ? severity::info : severity::warning,
        name_of(number, area.sender) + " takes part" + (but.empty() ? "" : ", but " + but));
    roll_.heard(now, area, plc_link_state::active, but);
    store(area);
}

std::optional<std::string> plc_link_exchange::reason_to_refuse(const plc_link_area& area) const
{
    const unsigned number = area.station.station;
    if (number == own_.station)
        return "it is the number of this PLC, " + plc_->name();
    const auto known = others_.find(number);
    if (known != others_.end()) {
        const plc_link_sender& before = known->second.sender;
        const bool same = before.gateway == area.sender.gateway && before.member == area.sender.member;
        if (!same)
            return "gateway " + before.gateway + " (" + before.member + ") has this number";
        if (area.sender.started < before.started)
            return "a gateway of the same name, started later, has this number";
    }
    const auto overlap = [&](const plc_link_station& before) -> std::optional<std::string> {
        for (const plc_link_mistake& m : check_pair(before, area.station))
            if (m.index == 1 && !is_reservation(m))
                return text_of(m);
        return std::nullopt;
    };
    if (auto with_own = overlap(own_))
        return with_own;
    for (const auto& [other_number, each] : others_)
        if (other_number != number)
            if (auto with_other = overlap({other_number, each.settings}))
                return with_other;
    return std::nullopt;
}

std::string plc_link_exchange::reservations(const plc_link_area& area) const
{
    std::string but;
    for (const plc_link_mistake& m : check_pair(own_, area.station))
        but += (but.empty() ? "" : "; ") + std::string(m.index == 0 ? "in this PLC, " + plc_->name() + ", " : "its ") +
               text_of(m);
    return but;
}

void plc_link_exchange::store(const plc_link_area& area)
{
    const auto put = [&](plc::place block, unsigned first, unsigned used, const std::vector<std::uint16_t>& words) {
        for (unsigned i = 0; i < words.size() && first + i < used; ++i)
            plc_->memory().set_word(word_at(block, first + i), words[i]);
    };
    const plc_link_settings& s = area.station.settings;
    put(relays_, s.relay_first, own_.settings.relay_words, area.relays);
    put(registers_, s.register_first, own_.settings.register_words, area.registers);
}

void plc_link_exchange::gone(time_point now, const plc_link_gone& who)
{
    if (who.link != link_)
        return;
    const auto known = others_.find(who.station);
    if (known != others_.end() && known->second.sender.gateway == who.gateway &&
        known->second.sender.member == who.member)
        give_up(now, known);
    else
        said_.erase({who.station, who.gateway, who.member});
    roll_.gone(now, who.station, who.gateway, who.member);
}

void plc_link_exchange::look(time_point now)
{
    for (auto each = others_.begin(); each != others_.end();) {
        const auto which = each++;
        if (now >= which->second.heard + pace_.given_up)
            give_up(now, which);
    }
}

void plc_link_exchange::reset()
{
    others_.clear();
    said_.clear();
    roll_.clear();
    sent_at_.reset();
    changed_ = true;
}

void plc_link_exchange::give_up(time_point now, std::map<unsigned, other>::iterator which)
{
    const auto& [number, was] = *which;
    said_.erase({number, was.sender.gateway, was.sender.member});
    roll_.gone(now, number, was.sender.gateway, was.sender.member);
    events_.push_back({severity::warning, name_of(number, was.sender) + " is gone: its words stay as they were"});
    others_.erase(which);
}

void plc_link_exchange::say(const sender_key& of, severity level, std::string text)
{
    const auto known = said_.find(of);
    if (known == said_.end() ? said_.size() >= most_said : known->second == text)
        return;
    said_[of] = text;
    events_.push_back({level, std::move(text)});
}

std::string plc_link_exchange::name_of(unsigned station, const plc_link_sender& sender) const
{
    return "PLC link " + link_ + ": station " + std::to_string(station) + " of gateway " + sender.gateway + " (" +
           sender.member + ")";
}

std::vector<plc_link_seen> plc_link_exchange::seen(time_point now) const { return roll_.seen(now, pace_.given_up); }

std::vector<unsigned> plc_link_exchange::others() const
{
    std::vector<unsigned> numbers;
    for (const auto& [number, each] : others_)
        numbers.push_back(number);
    return numbers;
}

}  // namespace plcgw
