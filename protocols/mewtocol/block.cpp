#include "protocols/mewtocol/block.hpp"

#include <algorithm>

namespace plcgw::mewtocol {
namespace {

using commands = std::optional<std::vector<command>>;

contact moved(const contact& from, std::size_t by) { return {from.area, static_cast<std::uint16_t>(from.number + by)}; }

bool fits(const contact& first, std::size_t count)
{
    return count >= 1 && count <= UINT16_MAX && first.number + count - 1 <= UINT16_MAX;
}

// The words that hold these contacts.
std::optional<read_words> words_around(const read_run& r)
{
    const auto area = words_of(r.first.area);
    if (!area || !fits(r.first, r.count))
        return std::nullopt;
    const std::uint32_t first = r.first.number / 16U;
    const std::uint32_t last = (r.first.number + r.count - 1) / 16U;
    return read_words{*area, first, last - first + 1};
}

// Contacts that begin and end with a word, as words.
write_words as_words(word_area to, const contact& first, const std::vector<bool>& values, std::size_t from,
                     std::size_t count)
{
    write_words made{to, (first.number + static_cast<std::uint32_t>(from)) / 16U, {}};
    made.values.resize(count / 16);
    for (std::size_t i = 0; i < count; ++i)
        if (values[from + i])
            made.values[i / 16] = static_cast<std::uint16_t>(made.values[i / 16] | 1U << i % 16);
    return made;
}

commands checked(std::vector<command> made)
{
    if (!std::all_of(made.begin(), made.end(), [](const command& each) { return is_expressible(each); }))
        return std::nullopt;
    return made;
}

commands one_by_one(const read_run& r)
{
    if (!fits(r.first, r.count))
        return std::nullopt;
    if (r.count == 1)
        return checked({read_contact{r.first}});
    std::vector<command> made;
    for (std::uint32_t done = 0; done < r.count; done += max_contacts) {
        read_contacts piece;
        for (std::uint32_t i = done; i < std::min<std::uint32_t>(r.count, done + max_contacts); ++i)
            piece.at.push_back(moved(r.first, i));
        made.emplace_back(std::move(piece));
    }
    return checked(std::move(made));
}

command write_piece(const write_run& w, std::size_t from, std::size_t count)
{
    if (count == 1)
        return write_contact{{moved(w.first, from), w.values[from]}};
    write_contacts piece;
    for (std::size_t i = from; i < from + count; ++i)
        piece.values.push_back({moved(w.first, i), w.values[i]});
    return piece;
}

// One overload for each block.
struct planner {
    header head;

    commands operator()(const read_words& r) const { return r.count == 0 ? std::nullopt : plan_read(r, head); }
    commands operator()(const write_words& w) const { return w.values.empty() ? std::nullopt : plan_write(w, head); }

    commands operator()(const read_run& r) const
    {
        const bool single = r.count == 1 && r.first.number <= max_contact_number;
        if (is_numbered(r.first.area) || single)
            return one_by_one(r);
        const auto words = words_around(r);
        return words ? (*this)(*words) : std::nullopt;
    }

    commands operator()(const write_run& w) const
    {
        const auto area = words_of(w.first.area);
        if (!area || !is_writable(w.first.area) || !fits(w.first, w.values.size()))
            return std::nullopt;
        std::vector<command> made;
        for (std::size_t at = 0; at < w.values.size();) {
            const std::size_t bit = (w.first.number + at) % 16;
            const std::size_t left = w.values.size() - at;
            if (bit == 0 && left >= 16) {
                const auto words = plan_write(as_words(*area, w.first, w.values, at, left / 16 * 16), head);
                if (!words)
                    return std::nullopt;
                made.insert(made.end(), words->begin(), words->end());
                at += left / 16 * 16;
                continue;
            }
            const std::size_t count = std::min({left, 16 - bit, max_contacts});
            made.push_back(write_piece(w, at, count));
            at += count;
        }
        return checked(std::move(made));
    }
};

// The same for MEWTOCOL7-COM.
struct planner7 {
    using commands7 = std::optional<std::vector<mewtocol7::command>>;
    const mewtocol7::dialect& dialect;

    commands7 operator()(const read_words& r) const
    {
        if (!mewtocol7::is_expressible(r, dialect))
            return std::nullopt;
        return std::vector<mewtocol7::command>{r};
    }
    commands7 operator()(const write_words& w) const { return mewtocol7::plan_write(w, dialect); }
    commands7 operator()(const read_run& r) const
    {
        const auto words = words_around(r);
        return words ? (*this)(*words) : std::nullopt;
    }
    commands7 operator()(const write_run& w) const
    {
        const auto area = words_of(w.first.area);
        const bool whole = w.first.number % 16 == 0 && w.values.size() % 16 == 0;
        if (!area || !is_writable(w.first.area) || !whole || !fits(w.first, w.values.size()))
            return std::nullopt;
        return (*this)(as_words(*area, w.first, w.values, 0, w.values.size()));
    }
};

contacts_read cut_out(const read_run& r, const std::vector<std::uint16_t>& words)
{
    contacts_read cut;
    for (std::size_t i = 0; i < r.count; ++i) {
        const std::size_t bit = r.first.number % 16U + i;
        cut.values.push_back(bit / 16 < words.size() && (words[bit / 16] >> bit % 16 & 1U) != 0);
    }
    return cut;
}

}  // namespace

std::optional<planned> plan(const block& b, headers which)
{
    const auto with = [&b](header head) -> std::optional<planned> {
        auto made = std::visit(planner{head}, b);
        return made ? std::optional(planned{head, std::move(*made)}) : std::nullopt;
    };
    auto normal = with(header::normal);
    if (which == headers::normal || !normal || normal->commands.size() == 1)
        return normal;
    auto longer = with(header::expansion);
    return longer && longer->commands.size() < normal->commands.size() ? longer : normal;
}

std::optional<std::vector<mewtocol7::command>> plan(const block& b, const mewtocol7::dialect& d)
{
    return std::visit(planner7{d}, b);
}

response join(const block& b, const std::vector<response>& parts)
{
    contacts_read contacts;
    words_read words;
    for (const response& each : parts) {
        if (const auto* some = std::get_if<contacts_read>(&each))
            contacts.values.insert(contacts.values.end(), some->values.begin(), some->values.end());
        else if (const auto* more = std::get_if<words_read>(&each))
            words.values.insert(words.values.end(), more->values.begin(), more->values.end());
        else
            return each;  // a write says nothing more with the next command
    }
    if (const auto* run = std::get_if<read_run>(&b))
        return contacts.values.empty() ? cut_out(*run, words.values) : contacts;
    return words;
}

response as_response(mewtocol7::response answer)
{
    if (auto* words = std::get_if<words_read>(&answer))
        return std::move(*words);
    if (const auto* refused = std::get_if<error_code>(&answer))
        return *refused;
    return std::holds_alternative<no_response>(answer) ? response{no_response{}} : response{executed{}};
}

}  // namespace plcgw::mewtocol
