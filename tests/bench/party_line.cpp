#include "tests/bench/party_line.hpp"

#include <algorithm>
#include <utility>

namespace plcgw::bench {
namespace {

constexpr std::uint8_t damage = 0x55;         // what two talkers make of a byte
constexpr std::size_t nonsense = 300;         // bytes that no request has
constexpr nanoseconds forever = 100'000'000;  // a pause that ends whatever was begun

unsigned word_at(const byte_vector& from, std::size_t at)
{
    return static_cast<unsigned>(from[at]) << 8 | from[at + 1];
}

}  // namespace

void party_line::heard(nanoseconds now, std::size_t member, byte_span bytes)
{
    auto& of = members_[member];
    if (!of.is_cut)
        say(static_cast<int>(member), of.sent_until, now, bytes);
}

void party_line::say(int talker, nanoseconds& sent_until, nanoseconds from, byte_span bytes)
{
    const nanoseconds start = std::max(from, sent_until);
    std::int64_t count = 0;
    for (const std::uint8_t each : bytes) {
        on_wire added{start + format_.characters(count), start + format_.characters(count + 1), talker, each, false};
        ++count;
        note_hits(added);
        const auto behind = std::upper_bound(air_.begin(), air_.end(), added,
                                             [](const on_wire& a, const on_wire& b) { return a.end < b.end; });
        air_.insert(behind, added);
    }
    sent_until = start + format_.characters(count);
}

// Bytes that touch each other are one collision.
void party_line::note_hits(on_wire& added)
{
    for (on_wire& each : air_) {
        if (each.talker == added.talker || each.end <= added.start || each.start >= added.end)
            continue;
        each.hit = added.hit = true;
        const nanoseconds at = std::max(each.start, added.start);
        if (at > collision_until_ + format_.characters(2))
            events_.push_back({.what = event::kind::collision, .at = at, .talker = added.talker, .other = each.talker});
        collision_until_ = std::max({collision_until_, each.end, added.end});
    }
}

nanoseconds party_line::deadline() const { return air_.empty() ? never() : air_.front().end; }

std::vector<party_line::received> party_line::due(nanoseconds now)
{
    std::vector<received> all;
    while (!air_.empty() && air_.front().end <= now) {
        const on_wire byte = air_.front();
        air_.pop_front();
        const auto value = static_cast<std::uint8_t>(byte.hit ? byte.byte ^ damage : byte.byte);
        for (std::size_t i = 0; i < members_.size(); ++i)
            if (static_cast<int>(i) != byte.talker && !members_[i].is_cut)
                all.push_back({i, value});
        if (byte.talker != stations)
            assemble(members_[static_cast<std::size_t>(byte.talker)], byte);
        busy_until_ = byte.end;
    }
    return all;
}

void party_line::assemble(member_state& of, const on_wire& byte)
{
    if (byte.start - of.last > forever)
        of.request.clear();
    of.last = byte.end;
    if (of.request.empty()) {
        of.begun = byte.start;
        of.silence = busy_until_ == 0 ? never() : byte.start - busy_until_;
        of.damaged = false;
    }
    of.damaged = of.damaged || byte.hit;
    of.request.push_back(byte.byte);
    const auto size = request_size(of.request);
    if (!size || of.request.size() > nonsense)
        of.request.clear();
    else if (of.request.size() == *size)
        end_request(of, byte);
}

void party_line::end_request(member_state& of, const on_wire& last)
{
    const byte_vector adu = std::exchange(of.request, {});
    const unsigned first = word_at(adu, 2);
    events_.push_back({.what = event::kind::request,
                       .at = of.begun,
                       .talker = last.talker,
                       .unit = adu[0],
                       .function = adu[1],
                       .first = first,
                       .value = word_at(adu, 4),
                       .damaged = of.damaged,
                       .silence = of.silence});
    if (of.damaged)
        return;
    const auto answer = stations_.ask(adu);
    if (!answer)
        return;
    const bool writes = adu[1] == 6 || adu[1] == 16;
    const unsigned count = adu[1] == 6 ? 1 : word_at(adu, 4);
    for (unsigned i = 0; writes && answer->response[1] == adu[1] && i < count; ++i)
        events_.push_back({.what = event::kind::write,
                           .at = last.end,
                           .talker = last.talker,
                           .unit = adu[0],
                           .function = adu[1],
                           .first = first + i,
                           .value = word_at(adu, adu[1] == 6 ? 4 : 7 + std::size_t{2} * i)});
    say(stations, stations_sent_until_, last.end + answer->turnaround, answer->response);
}

std::vector<party_line::event> party_line::take_events() { return std::exchange(events_, {}); }

}  // namespace plcgw::bench
