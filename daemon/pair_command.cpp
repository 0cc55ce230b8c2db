#include "daemon/pair_command.hpp"

#include "daemon/control_client.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace plcgw {

using nlohmann::json;

namespace {

json shown(const pair_beat& beat)
{
    json lines = json::array();
    for (const pair_line_report& each : beat.lines)
        lines.push_back({{"line", each.line}, {"state", to_string(each.state)}, {"speaks", each.speaks}});
    return {{"member", beat.member},     {"role", to_string(beat.role)}, {"term", beat.term},
            {"priority", beat.priority}, {"kept", beat.keeps},           {"lines", std::move(lines)}};
}

void print(const json& member, const char* who)
{
    fmt::print("{} ({}): {}, term {}, priority {}{}\n", member.value("member", ""), who, member.value("role", ""),
               member.value("term", 0ULL), member.value("priority", 0U),
               member.value("kept", false) ? ", kept by command" : "");
    for (const json& each : member["lines"])
        fmt::print("  line {:<16} {:<10} {}\n", each.value("line", ""),
                   each.value("speaks", false) ? "asks" : "listens", each.value("state", ""));
}

}  // namespace

json standby_member::report() const
{
    json own = shown(pair_.beat());
    own["why"] = pair_.why();
    json reply{{"ok", true}, {"here", std::move(own)}, {"dds", port_.has_value()}};
    if (const auto& other = pair_.other()) {
        reply["there"] = shown(*other);
        reply["there"]["heard"] = pair_.other_lives();
    }
    return reply;
}

json pair_command(standby_member* member, const json& what)
{
    if (member == nullptr)
        return {{"ok", false}, {"error", "this gateway has no pair: \"standby\" of the configuration makes one"}};
    const std::string action = what.value("action", "show");
    if (action == "show")
        return member->report();
    if (action != "switch")
        return {{"ok", false}, {"error", "pair knows show and switch, not \"" + action + "\""}};
    if (const auto refused = member->switch_over())
        return {{"ok", false}, {"error", *refused}};
    return {{"ok", true}};
}

int pair_client(const std::string& socket, const std::string& action)
{
    const json reply = ask_gateway(socket, {{"command", "pair"}, {"action", action}});
    if (!reply.value("ok", false)) {
        fmt::print(stderr, "plc-gateway: {}\n", reply.value("error", "the gateway did not understand"));
        return 1;
    }
    if (!reply.contains("here")) {
        fmt::print("the other member is asked to change roles: `plc-gateway pair` shows it\n");
        return 0;
    }
    print(reply["here"], "here");
    fmt::print("  because: {}\n", reply["here"].value("why", ""));
    if (!reply.value("dds", false))
        fmt::print("DDS does not work yet: the log says why\n");
    if (!reply.contains("there")) {
        fmt::print("no other member was heard yet\n");
        return 0;
    }
    print(reply["there"], reply["there"].value("heard", false) ? "heard now" : "not heard any more");
    return 0;
}

}  // namespace plcgw
