// A device with a small memory, and a station in front of it: what a server's tests need.
#pragma once

#include "bridge/services/mewtocol_service.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

#include <map>
#include <set>

namespace plcgw::test {

inline buffer to_bytes(std::string_view characters) { return {characters.begin(), characters.end()}; }
inline buffer with_cr(std::string characters) { return to_bytes(characters += '\r'); }

class fake_device final : public mewtocol_access {
public:
    using area = mewtocol::word_area;
    using words = std::vector<std::uint16_t>;

    // DT0 to DT32764, and small other areas.
    std::map<area, words> memory{{area::wx, words(128)},    {area::wy, words(128)},    {area::wr, words(900)},
                                 {area::wl, words(128)},    {area::dt, words(32'765)}, {area::ld, words(8448)},
                                 {area::fl, words(1000)},   {area::sv, words(1024)},   {area::ev, words(1024)},
                                 {area::ix, words(1)},      {area::iy, words(1)},      {area::id, words(2)},
                                 {area::system, words(512)}};
    std::set<std::uint16_t> timers;  // contacts that are on
    std::set<std::uint16_t> counters;
    mewtocol::plc_status rt{};
    std::optional<mewtocol::extended_status_read> extended;
    std::optional<mewtocol7::state_read> strd;
    bool prog = false;
    bool is_protected = false;
    std::uint64_t scan = 0;
    unsigned writes = 0;

    answer<words> read_words(area from, std::uint32_t first, std::uint32_t count) const override
    {
        const words& all = memory.at(from);
        return words(all.begin() + first, all.begin() + first + count);
    }
    refusal write_words(area to, std::uint32_t first, std::span<const std::uint16_t> values) override
    {
        if (to == area::system && is_protected)
            return mewtocol::error_code::protection;
        if (to == area::system && !prog)
            return mewtocol::error_code::mode;
        ++writes;
        std::copy(values.begin(), values.end(), memory.at(to).begin() + first);
        return std::nullopt;
    }
    answer<bool> read_contact(const mewtocol::contact& at) const override
    {
        if (at.area == mewtocol::contact_area::timer)
            return timers.contains(at.number);
        if (at.area == mewtocol::contact_area::counter)
            return counters.contains(at.number);
        const words& all = memory.at(word_of(at.area));
        if (at.number / 16U >= all.size())
            return mewtocol::error_code::data;
        return (all[at.number / 16U] >> at.number % 16U & 1U) != 0;
    }
    refusal write_contacts(std::span<const mewtocol::contact_value> values) override
    {
        for (const auto& each : values)
            if (each.at.number / 16U >= memory.at(word_of(each.at.area)).size())
                return mewtocol::error_code::data;
        ++writes;
        for (const auto& each : values)
            set(each.at, each.on);
        return std::nullopt;
    }
    std::uint32_t words_in(area a) const override
    {
        const auto found = memory.find(a);
        return found == memory.end() ? 0 : static_cast<std::uint32_t>(found->second.size());
    }
    mewtocol::plc_status status() const override { return rt; }
    answer<mewtocol::extended_status_read> extended_status() const override
    {
        if (!extended)
            return mewtocol::error_code::not_supported;
        return *extended;
    }
    answer<mewtocol7::state_read> state() const override
    {
        if (!strd)
            return mewtocol::error_code::not_supported;
        return *strd;
    }
    refusal change_mode(mewtocol::operating_mode to) override
    {
        prog = to == mewtocol::operating_mode::prog;
        return std::nullopt;
    }
    std::uint64_t scans() const override { return scan; }

    void set(area to, std::size_t first, const words& values)
    {
        std::copy(values.begin(), values.end(), memory.at(to).begin() + static_cast<std::ptrdiff_t>(first));
    }
    void set(const mewtocol::contact& at, bool on)
    {
        std::uint16_t& word = memory.at(word_of(at.area))[at.number / 16U];
        const unsigned bit = 1U << at.number % 16U;
        word = static_cast<std::uint16_t>(on ? word | bit : word & ~bit);
    }

private:
    static area word_of(mewtocol::contact_area a)
    {
        switch (a) {
        case mewtocol::contact_area::external_input: return area::wx;
        case mewtocol::contact_area::external_output: return area::wy;
        case mewtocol::contact_area::link_relay: return area::wl;
        default: return area::wr;
        }
    }
};

// A line with one station that speaks both protocols.
struct mewtocol_bench {
    fake_device device;
    mewtocol_registrations registered{};
    mewtocol::server_options options{.own = mewtocol::station_id{1}};
    mewtocol::server station{options};
    mewtocol7::server station7{{.own = mewtocol7::station_id{1}, .dialect = {}}};
    mewtocol::line_framer framer{1s};
    time_point now = t0;

    void restart(const mewtocol::server_options& with)
    {
        options = with;
        station = mewtocol::server(with);
    }

    // Everything that is sent while these bytes come.
    buffer hear(bytes received)
    {
        buffer sent;
        framer.feed(now, received);
        while (const auto r = framer.next(now))
            for (const auto& reply :
                 {reply_to(*r, now, station, device, registered), reply_to(*r, now, station7, device)})
                if (reply)
                    sent.insert(sent.end(), reply->begin(), reply->end());
        return sent;
    }
    std::string say(std::string request)  // without the CR of both
    {
        const buffer reply = hear(with_cr(std::move(request)));
        return reply.empty() ? std::string() : std::string(reply.begin(), reply.end() - 1);
    }
};

}  // namespace plcgw::test
