#include "bridge/services/mewtocol_service.hpp"

namespace plcgw {
namespace {

using mewtocol::error_code;
using mewtocol::response;
using refusal = mewtocol_access::refusal;

response done(refusal why_not) { return why_not ? response{*why_not} : mewtocol::executed{}; }

// 60 or 61 before anything is asked of the device, so that a range far beyond its end costs nothing.
refusal check_range(const mewtocol_access& device, mewtocol::word_area area, std::uint32_t first, std::size_t count)
{
    const std::uint32_t size = device.words_in(area);
    if (size == 0)
        return error_code::parameter;
    if (first >= size || count > size - first)
        return error_code::data;
    return std::nullopt;
}

template <class Response>
Response read_range(const mewtocol_access& device, const mewtocol::read_words& c)
{
    if (const refusal why = check_range(device, c.from, c.first, c.count))
        return *why;
    auto values = device.read_words(c.from, c.first, c.count);
    if (!values)
        return values.error();
    return mewtocol::words_read{std::move(*values)};
}

refusal write_range(mewtocol_access& device, const mewtocol::write_words& c)
{
    if (const refusal why = check_range(device, c.to, c.first, c.values.size()))
        return why;
    return device.write_words(c.to, c.first, c.values);
}

// One overload for each command.
struct server {
    mewtocol_access& device;
    mewtocol_registrations& registered;

    response operator()(const mewtocol::read_contact& c) const { return read(std::span(&c.at, 1)); }
    response operator()(const mewtocol::read_contacts& c) const { return read(c.at); }
    response operator()(const mewtocol::write_contact& c) const
    {
        return done(device.write_contacts(std::span(&c.value, 1)));
    }
    response operator()(const mewtocol::write_contacts& c) const { return done(device.write_contacts(c.values)); }
    response operator()(const mewtocol::read_words& c) const { return read_range<response>(device, c); }
    response operator()(const mewtocol::write_words& c) const { return done(write_range(device, c)); }
    response operator()(const mewtocol::fill_words& c) const
    {
        if (const refusal why = check_range(device, c.to, c.first, c.count))
            return *why;
        const std::vector<std::uint16_t> values(c.count, c.value);
        return done(device.write_words(c.to, c.first, values));
    }

    response operator()(const mewtocol::register_contacts& c) const
    {
        if (!registered.contacts.empty() || c.items.size() > registered.max_contacts)
            return error_code::registration;
        const response now = read(c.items);
        if (const auto* why = std::get_if<error_code>(&now))
            return *why;
        begin_counting();
        registered.contacts = c.items;
        return mewtocol::executed{};
    }
    response operator()(const mewtocol::forget_contacts&) const
    {
        registered.contacts.clear();
        return mewtocol::executed{};
    }
    response operator()(const mewtocol::register_data& c) const
    {
        if (!registered.words.empty() || c.items.size() > registered.max_words)
            return error_code::registration;
        for (const mewtocol::data_item& each : c.items)
            if (const refusal why = check_range(device, each.area, each.number, 1))
                return *why;
        begin_counting();
        registered.words = c.items;
        return mewtocol::executed{};
    }
    response operator()(const mewtocol::forget_data&) const
    {
        registered.words.clear();
        return mewtocol::executed{};
    }

    response operator()(const mewtocol::monitor&) const
    {
        if (registered.contacts.empty() && registered.words.empty())
            return error_code::registration;
        mewtocol::monitored m;
        m.contacts.resize((registered.contacts.size() + 7) / 8);
        for (std::size_t i = 0; i < registered.contacts.size(); ++i) {
            const auto on = device.read_contact(registered.contacts[i]);
            if (!on)
                return on.error();
            m.contacts[i / 8] = static_cast<std::uint8_t>(m.contacts[i / 8] | (*on ? 1U << i % 8 : 0U));
        }
        for (const mewtocol::data_item& each : registered.words) {
            const auto word = device.read_words(each.area, each.number, 1);
            if (!word)
                return word.error();
            m.words.push_back(word->front());
        }
        const std::uint64_t scans = device.scans();
        m.scans = static_cast<unsigned>(std::min<std::uint64_t>(scans - registered.scans_seen, 10));
        registered.scans_seen = scans;
        return m;
    }

    response operator()(const mewtocol::change_mode& c) const { return done(device.change_mode(c.to)); }
    response operator()(const mewtocol::read_status&) const { return mewtocol::status_read{device.status()}; }
    response operator()(const mewtocol::read_extended_status&) const
    {
        auto status = device.extended_status();
        if (!status)
            return status.error();
        return std::move(*status);
    }
    response operator()(const mewtocol::abort_transfer&) const { return mewtocol::no_response{}; }

private:
    response read(std::span<const mewtocol::contact> at) const
    {
        mewtocol::contacts_read values;
        for (const mewtocol::contact& each : at) {
            const auto on = device.read_contact(each);
            if (!on)
                return on.error();
            values.values.push_back(*on);
        }
        return values;
    }
    void begin_counting() const
    {
        if (registered.contacts.empty() && registered.words.empty())
            registered.scans_seen = device.scans();
    }
};

struct server7 {
    mewtocol_access& device;

    mewtocol7::response operator()(const mewtocol::read_words& c) const
    {
        return read_range<mewtocol7::response>(device, c);
    }
    mewtocol7::response operator()(const mewtocol::write_words& c) const
    {
        if (const refusal why = write_range(device, c))
            return *why;
        return mewtocol::executed{};
    }
    mewtocol7::response operator()(const mewtocol::read_status&) const
    {
        auto state = device.state();
        if (!state)
            return state.error();
        return std::move(*state);
    }
};

// What the station wants: bytes to send as they are, or a command whose answer becomes bytes.
template <class Station, class Command, class Serve>
std::optional<buffer> reply(const mewtocol::reception& r, time_point now, Station& station, Serve serve_one)
{
    auto action = station.hear(now, r);
    if (auto* bytes_to_send = std::get_if<buffer>(&action))
        return std::move(*bytes_to_send);
    if (const auto* asked = std::get_if<Command>(&action))
        return station.answer(now, serve_one(*asked));
    return std::nullopt;
}

}  // namespace

response serve(const mewtocol::command& asked, mewtocol_access& device, mewtocol_registrations& registered)
{
    return std::visit(server{device, registered}, asked);
}

mewtocol7::response serve(const mewtocol7::command& asked, mewtocol_access& device)
{
    return std::visit(server7{device}, asked);
}

std::optional<buffer> reply_to(const mewtocol::reception& r, time_point now, mewtocol::server& station,
                               mewtocol_access& device, mewtocol_registrations& registered)
{
    return reply<mewtocol::server, mewtocol::command>(
        r, now, station, [&](const mewtocol::command& asked) { return serve(asked, device, registered); });
}

std::optional<buffer> reply_to(const mewtocol::reception& r, time_point now, mewtocol7::server& station,
                               mewtocol_access& device)
{
    return reply<mewtocol7::server, mewtocol7::command>(
        r, now, station, [&](const mewtocol7::command& asked) { return serve(asked, device); });
}

}  // namespace plcgw
