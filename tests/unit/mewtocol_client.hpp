// Drives a MEWTOCOL-COM transaction as a serial line would, in virtual time.
#pragma once

#include "protocols/mewtocol/conversation.hpp"
#include "protocols/mewtocol/text.hpp"
#include "protocols/mewtocol/transaction.hpp"
#include "tests/unit/mewtocol_fake.hpp"

namespace plcgw::test {

using client = mewtocol::transaction<mewtocol::conversation>;

inline constexpr mewtocol::station_id one{1};
inline constexpr mewtocol::line_options timing{
    .response_timeout = 500ms, .retries = 1, .turnaround = 100ms, .silence = 100ms};
inline const duration gap = character_time(timing.format, 1);

// Of these characters and their CR.
inline duration on_wire(const std::string& characters) { return character_time(timing.format, characters.size() + 1); }

inline client ask(const mewtocol::command& question, mewtocol::station_id station = one,
                  const mewtocol::line_options& options = timing, mewtocol::header head = mewtocol::header::normal)
{
    return client(mewtocol::conversation(head, station, question), options, t0, t0);
}

// It wants this sent now. Tells it that it was.
inline bool sends(client& t, time_point now, const std::string& characters)
{
    const auto action = t.next(now);
    const auto* send = std::get_if<client::send>(&action);
    if (send == nullptr || buffer(send->adu.begin(), send->adu.end()) != with_cr(characters))
        return false;
    t.sent(now);
    return true;
}

// Until when it waits; nothing when it wants something else.
inline std::optional<time_point> waits(client& t, time_point now)
{
    const auto action = t.next(now);
    const auto* wait = std::get_if<client::wait>(&action);
    return wait == nullptr ? std::nullopt : std::optional(wait->until);
}

inline bool is_done(client& t, time_point now) { return std::holds_alternative<client::done>(t.next(now)); }

// With its BCC.
inline std::string checked(std::string characters)
{
    mewtocol::append_hex(characters, mewtocol::bcc(characters), 2);
    return characters;
}

}  // namespace plcgw::test
