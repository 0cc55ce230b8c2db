#include "bridge/messages/line_messages.hpp"
#include "bridge/messages/message_reader.hpp"
#include "daemon/config/checks/checks.hpp"
#include "daemon/config/fields.hpp"

#include <algorithm>

namespace plcgw::config {
namespace {

constexpr std::size_t bits_of_word = 16;

struct line_checker {
    check_context& c;
    device_check& devices;
    occupied_devices& occupied;
    std::string at;  // "/lines/0/general_purpose"
    const line_config& line;

    // Devices that this line fills.
    void fills(const std::string& plc_at, const std::string& device_at, const std::string& plc,
               const std::string& device, std::size_t bits, const std::string& who)
    {
        const auto place = devices.place_at(plc_at, device_at, plc, device, bits);
        if (!place)
            return;
        devices.check_filled(device_at, plc, *place, bits);
        for (const std::string& other : occupied.take(plc, *place, bits, who))
            c.complain(device_at, "overlaps with the devices of " + other + ": each device has one source");
    }

    // Of the PLC's program, or of this line when it sets it.
    void is_bit(const std::string& plc_at, const std::string& at_bit, const std::string& plc, const std::string& bit,
                bool fills = false)
    {
        const auto place = devices.place_at(plc_at, at_bit, plc, bit, 1);
        if (!place)
            return;
        if (!plc::is_bit_kind(plc::parse_device(bit, c.model_of(plc)->names)->kind))
            c.complain(at_bit, "is " + bit + ", expected a bit such as M0");
        else if (fills)
            devices.check_filled(at_bit, plc, *place, 1);
    }

    void check_received(const std::string& row, const received_config& r)
    {
        if (!c.is_sound(row) || c.plc(r.plc, row + "/plc") == nullptr)
            return;
        fills(row + "/plc", row + "/device", r.plc, r.device, bits_of_word * r.count, "received \"" + r.name + "\"");
        if (!r.ready.empty())
            is_bit(row + "/plc", row + "/ready", r.plc, r.ready, true);
        if (r.ready.empty() && r.when_full == when_full::stop)
            c.complain(row + "/when_full", "is stop, but without \"ready\" the buffers never fill: give the bit",
                       mistake::weight::warning);
    }

    void check_field(const std::string& message_at, const std::string& row, const message_config& m,
                     const messages::pattern* pattern, const field_config& f)
    {
        if (!c.is_sound(row))
            return;
        const messages::field field{f.name, f.type, static_cast<int>(f.decimals), f.characters, f.order};
        const bool sized = f.type != value_type::text || f.characters > 0;
        if (pattern != nullptr) {
            for (const std::string& each : messages::mistakes_of(*pattern, {field}))
                c.complain(row, "does not fit its pattern: " + each);
        }
        else if (!sized)
            c.complain(row, "is text without \"characters\": give it room");
        if (f.type != value_type::text && f.characters > 0)
            c.complain(row + "/characters", "stands at a number: only text has a size");
        const std::string name = m.name + "." + f.name;
        if (name.size() > name_rule.most)
            c.complain(row + "/name", "makes \"" + name + "\", more than the " + std::to_string(name_rule.most) +
                                          " bytes of a DDS name: shorten it");
        if (sized && c.plcs.find(m.plc) != nullptr)
            fills(message_at + "/plc", row + "/device", m.plc, f.device, bits_of_word * messages::registers_of(field),
                  "field \"" + name + "\"");
    }

    void check_message(const std::string& row, const message_config& m)
    {
        const auto pattern = messages::pattern::parse(m.pattern);
        if (!pattern && !m.pattern.empty())
            c.complain(row + "/pattern", "is wrong at character " + std::to_string(pattern.error().position) + ": " +
                                             pattern.error().text);
        c.plc(m.plc, row + "/plc");
        const bool sound = c.is_sound(row);
        std::set<std::string> names;
        for (std::size_t i = 0; i < m.fields.size(); ++i) {
            const std::string at_field = row + "/fields/" + std::to_string(i);
            check_field(row, at_field, m, pattern && sound ? &*pattern : nullptr, m.fields[i]);
            if (!m.fields[i].name.empty() && !names.insert(m.fields[i].name).second)
                c.complain(at_field + "/name", "stands twice: a field has one place");
        }
        if (m.answer_to.empty() || !sound || !c.is_sound(at + "/sends"))
            return;
        const auto& sends = line.messages.sends;
        const auto to =
            std::find_if(sends.begin(), sends.end(), [&](const send_config& each) { return each.name == m.answer_to; });
        if (to == sends.end())
            c.complain(row + "/answer_to", "names the send \"" + m.answer_to + "\", which this line does not have");
        else if (!to->answer)
            c.complain(row + "/answer_to", "names the send \"" + m.answer_to + "\", which expects no \"answer\"");
    }

    void check_send(const std::string& row, const send_config& s)
    {
        if (!c.is_sound(row))
            return;
        if (s.text.empty() == s.device.empty())
            c.complain(row, s.text.empty() ? "sends nothing: give \"text\", or \"device\" and \"count\""
                                           : "sends two things: give \"text\" or \"device\"");
        if (const auto text = messages::parse_bytes(s.text); !text)
            c.complain(row + "/text",
                       "is wrong at character " + std::to_string(text.error().position) + ": " + text.error().text);
        if (s.trigger.empty() && s.period.count() == 0)
            c.complain(row, "is never sent: give \"period_ms\" or \"trigger\"");
        if (s.period.count() > 0 && s.period.count() < 10)
            c.complain(row + "/period_ms", "is " + std::to_string(s.period.count()) + ", expected 10 or more, or 0");
        if (!s.trigger.empty() || !s.device.empty())
            check_send_devices(row, s);
        else if (!s.plc.empty())
            c.plc(s.plc, row + "/plc");
        if (s.device.empty() && s.count > 0)
            c.complain(row + "/count", "stands without \"device\": words of a PLC need both");
    }

    void check_send_devices(const std::string& row, const send_config& s)
    {
        if (s.plc.empty()) {
            c.complain(row, "lacks \"plc\": whose devices are these?");
            return;
        }
        if (c.plc(s.plc, row + "/plc") == nullptr)
            return;
        if (!s.trigger.empty())
            is_bit(row + "/plc", row + "/trigger", s.plc, s.trigger);
        if (s.device.empty())
            return;
        if (s.count < 2)
            c.complain(row + "/count", "is " + std::to_string(s.count) +
                                           ", expected 2 or more: the word of the count and those of the bytes");
        else
            devices.place_at(row + "/plc", row + "/device", s.plc, s.device, bits_of_word * s.count);
    }

    void check_status(const std::string& row, const message_status_config& s)
    {
        if (!c.is_sound(row) || (s.device.empty() && s.reset.empty()))
            return;
        if (s.plc.empty()) {
            c.complain(row, "lacks \"plc\": whose devices are these?");
            return;
        }
        if (c.plc(s.plc, row + "/plc") == nullptr)
            return;
        if (!s.device.empty())
            fills(row + "/plc", row + "/device", s.plc, s.device, bits_of_word * messages::status_words,
                  "the status of line \"" + line.name + "\"");
        if (!s.reset.empty())
            is_bit(row + "/plc", row + "/reset", s.plc, s.reset);
    }
};

// Names are keys in DDS, and stand in logs.
template <class Row>
void unique_names(check_context& c, const std::string& list, const std::vector<Row>& rows, std::set<std::string>& seen)
{
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (!rows[i].name.empty() && !seen.insert(rows[i].name).second)
            c.complain(list + "/" + std::to_string(i) + "/name",
                       "\"" + rows[i].name + "\" stands twice: give each its own name");
}

}  // namespace

void check_messages(check_context& c, device_check& devices, occupied_devices& occupied)
{
    std::set<std::string> received;
    std::set<std::string> messages;
    for (std::size_t i = 0; i < c.config.lines.size(); ++i) {
        const line_config& line = c.config.lines[i];
        const general_purpose_config& g = line.messages;
        const std::string at = item("lines", i, "general_purpose");
        line_checker checker{c, devices, occupied, at, line};
        std::set<std::string> sends;
        unique_names(c, at + "/received", g.received, received);
        unique_names(c, at + "/messages", g.messages, messages);
        unique_names(c, at + "/sends", g.sends, sends);
        for (std::size_t n = 0; n < g.received.size(); ++n)
            checker.check_received(at + "/received/" + std::to_string(n), g.received[n]);
        for (std::size_t n = 0; n < g.messages.size(); ++n)
            checker.check_message(at + "/messages/" + std::to_string(n), g.messages[n]);
        for (std::size_t n = 0; n < g.sends.size(); ++n)
            checker.check_send(at + "/sends/" + std::to_string(n), g.sends[n]);
        checker.check_status(at + "/status", g.status);
    }
}

}  // namespace plcgw::config
