#include "bridge/standby/line_listener.hpp"

#include <algorithm>
#include <utility>

namespace plcgw {
namespace {

using mewtocol::contact;
using mewtocol::contact_area;

constexpr contact_area with_words[] = {contact_area::external_input, contact_area::external_output,
                                       contact_area::internal_relay, contact_area::link_relay};

// The first contact in such a word; nothing if words of this area hold none.
std::optional<contact> contact_in(mewtocol::word_area area, std::uint32_t word)
{
    const auto found = std::find_if(std::begin(with_words), std::end(with_words),
                                    [area](contact_area each) { return mewtocol::words_of(each) == area; });
    if (found == std::end(with_words) || word > mewtocol::max_contact_number / 16)
        return std::nullopt;
    return contact{*found, static_cast<std::uint16_t>(16 * word)};
}

std::vector<bool> bits_of(const std::vector<std::uint16_t>& words)
{
    std::vector<bool> bits;
    for (const std::uint16_t word : words)
        for (unsigned bit = 0; bit < 16; ++bit)
            bits.push_back((word >> bit & 1U) != 0);
    return bits;
}

std::optional<mewtocol::block> block_of(const mewtocol::command& asked)
{
    if (const auto* const q = std::get_if<mewtocol::read_words>(&asked))
        return *q;
    if (const auto* const q = std::get_if<mewtocol::write_words>(&asked))
        return *q;
    if (const auto* const q = std::get_if<mewtocol::read_contact>(&asked))
        return mewtocol::read_run{q->at, 1};
    if (const auto* const q = std::get_if<mewtocol::write_contact>(&asked))
        return mewtocol::write_run{q->value.at, {q->value.on}};
    return std::nullopt;
}

// The same question about the contacts in its words.
std::optional<mewtocol::block> contacts_of(const mewtocol::command& asked)
{
    if (const auto* const q = std::get_if<mewtocol::read_words>(&asked)) {
        if (const auto first = contact_in(q->from, q->first))
            return mewtocol::read_run{*first, 16 * q->count};
    }
    else if (const auto* const write = std::get_if<mewtocol::write_words>(&asked)) {
        if (const auto first = contact_in(write->to, write->first))
            return mewtocol::write_run{*first, bits_of(write->values)};
    }
    return std::nullopt;
}

mewtocol::response contacts_of(const mewtocol::response& answer)
{
    const auto* const words = std::get_if<mewtocol::words_read>(&answer);
    return words == nullptr ? answer : mewtocol::contacts_read{bits_of(words->values)};
}

station_number station_of(mewtocol::station_id station)
{
    return station_number(station == mewtocol::station_id::global ? 0U : mewtocol::number(station));
}

}  // namespace

void line_listener::feed(time_point now, bytes received)
{
    std::visit([&](auto& in) { in.feed(now, received); }, in_);
}

void line_listener::spoke(time_point now, bytes ours)
{
    std::visit([&](auto& in) { in.spoke(now, ours); }, in_);
}

std::optional<overheard_exchange> line_listener::next(time_point now)
{
    const auto listen = [&](auto& in) {
        while (waiting_.empty()) {
            auto heard = in.next(now);
            if (!heard)
                return;
            take(std::move(*heard));
        }
    };
    std::visit(listen, in_);
    if (waiting_.empty())
        return std::nullopt;
    overheard_exchange first = std::move(waiting_.front());
    waiting_.pop_front();
    return first;
}

void line_listener::take(modbus::heard_exchange heard)
{
    std::optional<station_answer> answer;
    if (heard.answer)
        answer = std::move(*heard.answer);
    waiting_.push_back({heard.unit, std::move(heard.asked), std::move(answer)});
}

void line_listener::take(mewtocol::heard_exchange heard)
{
    const auto block = block_of(heard.asked);
    if (!block)
        return;
    const station_number unit = station_of(heard.station);
    std::optional<station_answer> answer;
    if (heard.answer)
        answer = *heard.answer;
    waiting_.push_back({unit, *block, std::move(answer)});
    const auto contacts = contacts_of(heard.asked);
    if (contacts && heard.answer)
        waiting_.push_back({unit, *contacts, contacts_of(*heard.answer)});
}

time_point line_listener::deadline() const
{
    return std::visit([](const auto& in) { return in.deadline(); }, in_);
}

std::optional<time_point> line_listener::foreign_question() const
{
    return std::visit([](const auto& in) { return in.foreign_question(); }, in_);
}

}  // namespace plcgw
