// A channel of a PLC is one port: it has one line, on which the PLC asks or is asked. An FP7's port, COM.0 to COM.2,
// has one protocol and one station number, too, which PMGET shows.
#include "daemon/config/checks/checks.hpp"

#include <map>
#include <utility>

namespace plcgw::config {
namespace {

struct channel_user {
    std::string at;  // pointer
    std::string line;
};

class channel_users {
public:
    explicit channel_users(check_context& c) : c_(c) {}

    // at: of the row with the key "channel".
    void take(const std::string& at, const std::string& plc, unsigned channel, const std::string& line)
    {
        const plc::model* const model = c_.model_of(plc);
        if (model == nullptr || !c_.is_sound(at))
            return;
        const auto [taken, is_new] = users_.try_emplace({plc, channel}, channel_user{at + "/channel", line});
        const channel_user& before = taken->second;
        const bool one_station = model->mewtocol;
        if (is_new || (before.line == line && !one_station && before.at.starts_with("/lines")))
            return;
        c_.complain(at + "/channel", "is " + std::string(one_station ? "COM." : "channel ") + std::to_string(channel) +
                                         " of \"" + plc + "\", which " + before.at + " gives to line \"" + before.line +
                                         "\" already: " +
                                         (one_station ? "a port has one line and one station, give another one"
                                                      : "a channel has one line, give another one"));
    }

private:
    check_context& c_;
    std::map<std::pair<std::string, unsigned>, channel_user> users_;
};

// Its flags are those of one line.
void check_com_lines(check_context& c)
{
    std::map<std::string, std::string> ports;  // by line
    for (std::size_t i = 0; i < c.config.plcs.size(); ++i) {
        const plc_config& p = c.config.plcs[i];
        const plc::model* const model = plc::find_model(p.model);
        if (model == nullptr || !model->mewtocol)
            continue;
        for (std::size_t n = 0; n < p.channels.size(); ++n) {
            const std::string at = item("plcs", i, "channels") + "/" + std::to_string(n);
            const auto [taken, is_new] = ports.try_emplace(p.channels[n].line, at);
            if (!is_new && c.is_sound(at))
                c.complain(at + "/line", "is \"" + p.channels[n].line + "\", which stands for the port of " +
                                             taken->second + " already: a line is one port");
        }
    }
}

}  // namespace

void check_channel_users(check_context& c)
{
    check_com_lines(c);
    channel_users users(c);
    for (std::size_t i = 0; i < c.config.plcs.size(); ++i)
        for (std::size_t n = 0; n < c.config.plcs[i].channels.size(); ++n)
            users.take(item("plcs", i, "channels") + "/" + std::to_string(n), c.config.plcs[i].name,
                       c.config.plcs[i].channels[n].channel, c.config.plcs[i].channels[n].line);
    for (std::size_t i = 0; i < c.config.lines.size(); ++i) {
        const line_config& l = c.config.lines[i];
        if (l.role != line_role::server || l.protocol == line_protocol::general_purpose)
            continue;
        for (std::size_t u = 0; u < l.units.size(); ++u)
            if (l.units[u].line.empty())
                users.take(item("lines", i, "units") + "/" + std::to_string(u), l.units[u].plc, l.units[u].channel,
                           l.name);
    }
}

}  // namespace plcgw::config
