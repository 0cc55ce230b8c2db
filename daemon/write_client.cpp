#include "daemon/write_client.hpp"

#include "daemon/control_client.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace plcgw {
namespace {

using nlohmann::json;

constexpr int refused = 1;
constexpr int no_answer = 3;

json with_form(json command, const access_options& o)
{
    command["target"] = o.target;
    command["type"] = o.type;
    command["order"] = o.order;
    command["timeout_ms"] = o.timeout_ms;
    return command;
}

void print_values(const json& values)
{
    for (const json& each : values) {
        const json& value = each.at("value");
        std::string line = fmt::format("{}  {}", each.value("name", ""),
                                       value.is_null()     ? std::string("no value")
                                       : value.is_string() ? value.get<std::string>()
                                                           : value.dump());
        if (each.contains("unit"))
            line += " " + each.value("unit", "");
        if (each.value("quality", "good") != "good")
            line += "  (" + each.value("quality", "") + ")";
        fmt::print("{}\n", line);
    }
}

int ask(const access_options& o, const json& command)
{
    const json reply = ask_gateway(o.socket, command);
    const bool ok = reply.is_object() && reply.value("ok", false);
    const bool silent =
        !reply.is_object() || reply.value("unreachable", false) || reply.value("result", "") == "TIMEOUT";
    if (o.json)
        fmt::print("{}\n", reply.dump(-1, ' ', false, json::error_handler_t::replace));
    else if (!ok)
        fmt::print(stderr, "plc-gateway: {}\n",
                   reply.is_object() ? reply.value("error", "refused") : std::string("the gateway did not answer"));
    else if (reply.contains("values"))
        print_values(reply["values"]);
    else
        fmt::print("{}: {}\n", reply.value("result", ""), reply.value("detail", ""));
    if (ok)
        return 0;
    return silent ? no_answer : refused;
}

}  // namespace

int read_over_socket(const access_options& o)
{
    json command = with_form({{"command", "read"}, {"count", o.count}}, o);
    if (o.type == "text") {
        command["count"] = 1;
        command["characters"] = o.count;
    }
    return ask(o, command);
}

int write_over_socket(const access_options& o)
{
    return ask(o, with_form({{"command", "write"}, {"values", o.values}}, o));
}

int send_over_socket(const access_options& o)
{
    return ask(o, {{"command", "send"}, {"line", o.target}, {"text", o.values.at(0)}, {"timeout_ms", o.timeout_ms}});
}

}  // namespace plcgw
