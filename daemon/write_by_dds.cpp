#include "daemon/write_by_dds.hpp"

#include "bridge/dds/command_client.hpp"
#include "bridge/dds/log.hpp"
#include "bridge/messages/notation.hpp"
#include "daemon/access_values.hpp"
#include "daemon/read_before.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <poll.h>
#include <random>

namespace plcgw {
namespace {

using parsed = boost::system::result<order_content, std::string>;

constexpr int refused = 1;
constexpr int usage = 2;
constexpr int no_answer = 3;
constexpr duration repeat_after = std::chrono::milliseconds(100);

// Nobody else may have it, also on other hosts.
std::string client_name()
{
    std::random_device random;
    const std::uint64_t number = std::uint64_t{random()} << 32 | random();
    return fmt::format("plc-gateway-{:016x}", number);
}

// R is a relay to an FP7 and a word to an FX3: a type says the latter.
bool is_bit_area(const std::string& area)
{
    constexpr std::string_view areas[] = {"coil", "discrete", "X", "Y", "M", "S", "TS", "CS", "R", "L", "T", "C"};
    return std::find(std::begin(areas), std::end(areas), area) != std::end(areas);
}

parsed registers_of_route(const access_options& o, std::size_t slash)
{
    route_order order;
    order.route = o.target.substr(0, slash);
    const std::string where = o.target.substr(slash + 1);
    const std::size_t colon = where.find(':');
    order.area = where.substr(0, colon);
    const std::string digits = colon == std::string::npos ? "" : where.substr(colon + 1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), order.first);
    if (error != std::errc{} || end != digits.data() + digits.size())
        return fmt::format("\"{}\" names no registers of a route: give route/area:first as `plc-gateway watch` shows "
                           "them, for example pump.set/holding:100 or press.set/DT:500",
                           o.target);
    auto values = values_of(o.values, o.type.empty() && is_bit_area(order.area), {o.type, o.order, 0});
    if (!values)
        return values.error().detail;
    order.values = std::move(*values);
    return order_content(std::move(order));
}

parsed content_of(const access_options& o)
{
    if (const std::size_t slash = o.target.rfind('/'); slash != std::string::npos)
        return registers_of_route(o, slash);
    if (o.values.size() != 1)
        return std::string("a point takes one value");
    return order_content(point_order{o.target, o.type == "text" ? text_value(o.values[0]) : typed_value(o.values[0])});
}

// The reply, if it comes in time.
std::optional<order_reply> ask(command_client& client, const order_request& request, time_point until)
{
    for (time_point again = now(); now() < until;) {
        if (now() >= again) {
            client.send(request);
            again = now() + repeat_after;
        }
        const auto wait = std::chrono::ceil<std::chrono::milliseconds>(std::min(again, until) - now());
        ::pollfd ready{client.descriptor(), POLLIN, 0};
        ::poll(&ready, 1, static_cast<int>(std::max<std::int64_t>(wait.count(), 0)));
        for (order_reply& each : client.take())
            if (each.key == request.key)
                return std::move(each);
    }
    return std::nullopt;
}

int show(const access_options& o, const order_reply& reply)
{
    const order_outcome& outcome = reply.outcome;
    const bool ok = outcome.result == order_result::ok;
    if (o.json)
        fmt::print("{}\n", nlohmann::json{{"ok", ok},
                                          {"result", to_string(outcome.result)},
                                          {"code", static_cast<unsigned>(outcome.result)},
                                          {"device_code", outcome.device_code},
                                          {"detail", outcome.detail},
                                          {"member", reply.member},
                                          {"done_ns", static_cast<std::int64_t>(reply.done)}}
                               .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    else
        fmt::print(ok ? stdout : stderr, "{}{}: {}\n", ok ? "" : "plc-gateway: ", to_string(outcome.result),
                   outcome.detail);
    if (ok)
        return 0;
    return outcome.result == order_result::timeout ? no_answer : refused;
}

int silence(const access_options& o, const dds_access_options& how)
{
    const std::string why =
        fmt::format("no gateway \"{}\" answers on domain {}, {} within {} ms: is it running with these DDS settings? "
                    "`plc-gateway watch` shows who is there. What the device has is not known",
                    how.gateway, how.dds.domain,
                    how.dds.interface.empty() ? "any interface" : "interface " + how.dds.interface, how.wait_ms);
    if (o.json)
        fmt::print("{}\n", nlohmann::json{{"ok", false}, {"unreachable", true}, {"error", why}}.dump());
    else
        fmt::print(stderr, "plc-gateway: {}\n", why);
    return no_answer;
}

int carry_out(const access_options& o, const dds_access_options& how, const parsed& content)
{
    if (!content) {
        fmt::print(stderr, "plc-gateway: {}\n", content.error());
        return usage;
    }
    set_dds_log([](dds_log_level level, const std::string& line) {
        if (level != dds_log_level::info)
            fmt::print(stderr, "dds: {}\n", line);
    });
    auto client = command_client::create(how.dds);
    if (!client) {
        fmt::print(stderr, "plc-gateway: {}\n", client.error().text);
        return no_answer;
    }
    const order_request request{{how.client.empty() ? client_name() : how.client, how.request},
                                how.gateway,
                                {*content, wall_now(), std::chrono::milliseconds(o.timeout_ms)},
                                {}};
    if (!client->send(request)) {
        fmt::print(stderr,
                   "plc-gateway: this is more than one request carries: 1024 words, 255 bytes of text, 4096 bytes "
                   "of a message, 128 of a point's name, 64 of other names\n");
        return usage;
    }
    const auto reply = ask(*client, request, now() + std::chrono::milliseconds(how.wait_ms));
    return reply ? show(o, *reply) : silence(o, how);
}

}  // namespace

int write_by_dds(const access_options& o, const dds_access_options& how) { return carry_out(o, how, content_of(o)); }

int send_by_dds(const access_options& o, const dds_access_options& how)
{
    const auto content = messages::parse_bytes(o.values.at(0));
    if (!content)
        return carry_out(o, how, fmt::format("text, character {}: {}", content.error().position, content.error().text));
    return carry_out(o, how, order_content(message_order{o.target, *content}));
}

}  // namespace plcgw
