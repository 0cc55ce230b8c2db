#include "daemon/plc_link_command.hpp"

#include "daemon/control_client.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace plcgw {
namespace {

using nlohmann::json;

constexpr const char* state_names[] = {"active", "refused", "gone"};

// "WL10-WL14, LD10-LD13": as the PLC numbers its own devices.
std::string words_of(const plc_link_settings& own, const plc_link_settings& sent)
{
    std::string text;
    const auto add = [&](const char* name, unsigned block, unsigned first, unsigned count) {
        if (count == 0)
            return;
        text += fmt::format("{}{}{}", text.empty() ? "" : ", ", name, block + first);
        if (count > 1)
            text += fmt::format("-{}{}", name, block + first + count - 1);
    };
    add("WL", own.block * link_block_relay_words, sent.relay_first, sent.relay_count);
    add("LD", own.block * link_block_registers, sent.register_first, sent.register_count);
    return text.empty() ? "nothing" : text;
}

json shown(const plc_link_seen& each, const plc_link_settings& own, time_point now)
{
    const auto ms = [&](time_point since) {
        return std::chrono::duration_cast<std::chrono::milliseconds>(now - since).count();
    };
    json row{{"station", each.station.station},
             {"gateway", each.gateway},
             {"member", each.member},
             {"sends", words_of(own, each.station.settings)},
             {"state", state_names[static_cast<std::size_t>(each.state)]},
             {"since_ms", ms(each.since)},
             {"heard_ms", ms(each.heard)}};
    if (!each.reason.empty())
        row["reason"] = each.reason;
    return row;
}

json shown(const plc_link_exchange& link, time_point now)
{
    const plc_link_settings& own = link.own().settings;
    json stations = json::array();
    for (const plc_link_seen& each : link.seen(now))
        stations.push_back(shown(each, own, now));
    return {{"name", link.link()},           {"plc", link.plc().name()},
            {"station", link.own().station}, {"max_station", effective_max_station(own)},
            {"sends", words_of(own, own)},   {"stations", std::move(stations)}};
}

std::string age(std::int64_t ms)
{
    if (ms < 10'000)
        return fmt::format("{:.1f} s", static_cast<double>(ms) / 1000);
    if (ms < 600'000)
        return fmt::format("{} s", ms / 1000);
    return ms < 36'000'000 ? fmt::format("{} min", ms / 60'000) : fmt::format("{} h", ms / 3'600'000);
}

void print(const json& link)
{
    fmt::print("{}: {} is station {} of {}, sends {}\n", link.value("name", ""), link.value("plc", ""),
               link.value("station", 0U), link.value("max_station", 0U), link.value("sends", ""));
    for (const json& each : link["stations"]) {
        const std::string who = fmt::format("{} ({})", each.value("gateway", ""), each.value("member", ""));
        const std::string state = each.value("state", "");
        const bool is_gone = state == "gone";
        fmt::print("  {:>2}  {:<24} {:<24} {} for {}", each.value("station", 0U), who, each.value("sends", ""), state,
                   age(each.value("since_ms", std::int64_t{})));
        if (!is_gone)
            fmt::print(", heard {} ago", age(each.value("heard_ms", std::int64_t{})));
        if (each.contains("reason"))
            fmt::print(": {}", each.value("reason", ""));
        fmt::print("\n");
    }
    if (link["stations"].empty())
        fmt::print("  no other station was heard\n");
}

}  // namespace

json plc_link_command(const plc_links* links, time_point now)
{
    json rows = json::array();
    if (links != nullptr)
        for (const plc_link_exchange& each : links->all())
            rows.push_back(shown(each, now));
    return {{"ok", true}, {"runs", links == nullptr || links->runs()}, {"links", std::move(rows)}};
}

int plc_link_client(const std::string& socket)
{
    const json reply = ask_gateway(socket, {{"command", "plc-link"}});
    if (!reply.value("ok", false)) {
        fmt::print(stderr, "plc-gateway: {}\n", reply.value("error", "the gateway did not understand"));
        return 1;
    }
    if (!reply.value("runs", true))
        fmt::print("DDS does not work yet, nothing is sent: the log says why\n");
    if (reply["links"].empty())
        fmt::print("no PLC link: \"plc_links\" of the configuration names them\n");
    for (const json& link : reply["links"])
        print(link);
    return 0;
}

}  // namespace plcgw
