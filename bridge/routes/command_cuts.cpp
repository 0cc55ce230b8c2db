#include "bridge/routes/command_cuts.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr std::size_t word_bits = 16;

// Words or contacts that a command carries; contacts that go as words count as contacts.
struct items_of_command {
    bool counts_contacts;

    std::size_t operator()(const mewtocol::read_words& c) const { return words(c.count); }
    std::size_t operator()(const mewtocol::write_words& c) const { return words(c.values.size()); }
    std::size_t operator()(const mewtocol::read_contacts& c) const { return c.at.size(); }
    std::size_t operator()(const mewtocol::write_contacts& c) const { return c.values.size(); }
    template <class Single>
    std::size_t operator()(const Single&) const
    {
        return 1;
    }

private:
    std::size_t words(std::size_t count) const { return counts_contacts ? word_bits * count : count; }
};

// Contacts are read as the words around them, so that the first word may begin before the first contact.
std::size_t before_first(const mewtocol::block& asked, bool as_words)
{
    const auto* const run = std::get_if<mewtocol::read_run>(&asked);
    return run != nullptr && as_words ? run->first.number % word_bits : 0;
}

template <class Command>
std::vector<std::size_t> cuts_between(const mewtocol::block& asked, const std::vector<Command>& commands)
{
    const bool counts_contacts =
        !std::holds_alternative<mewtocol::read_words>(asked) && !std::holds_alternative<mewtocol::write_words>(asked);
    const bool as_words = !commands.empty() && std::holds_alternative<mewtocol::read_words>(commands.front());
    std::vector<std::size_t> cuts;
    std::size_t end = 0;
    for (const Command& each : commands) {
        if (end != 0)
            cuts.push_back(end - before_first(asked, as_words));
        end += std::visit(items_of_command{counts_contacts}, each);
    }
    return cuts;
}

}  // namespace

std::vector<std::size_t> command_cuts(const bus_timing& bus, const mewtocol::block& asked)
{
    if (bus.protocol == bus_protocol::mewtocol7_com) {
        const auto plan = mewtocol::plan(asked, bus.dialect);
        return plan ? cuts_between(asked, *plan) : std::vector<std::size_t>();
    }
    const auto plan = mewtocol::plan(asked, bus.headers);
    return plan ? cuts_between(asked, plan->commands) : std::vector<std::size_t>();
}

}  // namespace plcgw
