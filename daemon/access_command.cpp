#include "daemon/access_command.hpp"

#include "bridge/messages/notation.hpp"
#include "daemon/access_values.hpp"
#include "daemon/station_access.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plcgw {
namespace {

using nlohmann::json;

json reply_of(const order_outcome& outcome)
{
    const bool ok = outcome.result == order_result::ok;
    json reply{{"ok", ok},
               {"result", to_string(outcome.result)},
               {"code", static_cast<unsigned>(outcome.result)},
               {"device_code", outcome.device_code},
               {"detail", outcome.detail}};
    if (!ok)
        reply["error"] = fmt::format("{}: {}", to_string(outcome.result), outcome.detail);
    return reply;
}

// Its line is the other member's, and so is its memory: what was written here would be lost.
const order_outcome standby_refuses{order_result::standby, 0,
                                    "this gateway is the standby of a pair: give it to the active member, `plc-gateway "
                                    "pair` says which that is"};

json rejected(std::string why) { return reply_of({order_result::rejected, 0, std::move(why)}); }

value_form form_in(const json& what)
{
    return {what.value("type", ""), what.value("order", ""), what.value("characters", 0U)};
}

std::vector<std::string> texts_in(const json& what)
{
    std::vector<std::string> texts;
    for (const json& each : what.value("values", json::array()))
        texts.push_back(each.is_string() ? each.get<std::string>() : each.dump());
    return texts;
}

json value_row(std::string name, json value) { return {{"name", std::move(name)}, {"value", std::move(value)}}; }

// Names of values that begin every so many registers or bits.
template <class Name>
json rows(const std::vector<json>& values, std::size_t step, const Name& name)
{
    json all = json::array();
    for (std::size_t i = 0; i < values.size(); ++i)
        all.push_back(value_row(name(static_cast<std::uint32_t>(i * step)), values[i]));
    return all;
}

std::string place_name(const station_place& first, std::uint32_t skip)
{
    const station_place at = moved_to(first, number(first) + skip);
    if (const auto* const device = std::get_if<mewtocol::device>(&at))
        return mewtocol::to_string(*device);
    return fmt::format("{}:{}", area_name(at), number(at));
}

}  // namespace

bool access_commands::knows(const json& what)
{
    const std::string command = what.value("command", "");
    return command == "read" || command == "write" || command == "send";
}

asio::awaitable<json> access_commands::answer(json what)
try {
    if (what.value("command", "") == "read") {
        json reply = co_await read(std::move(what));
        co_return reply;
    }
    if (!is_active_())
        co_return reply_of(standby_refuses);
    auto content = order_of(what);
    if (!content)
        co_return reply_of(content.error());
    order given;
    given.what = std::move(*content);
    given.timeout = milliseconds(what.value("timeout_ms", 0U));
    auto work = writes_.carry_out(std::move(given), order_origin::local);
    const auto outcome = co_await std::move(work);
    co_return reply_of(outcome);
}
catch (const json::exception& wrong) {
    co_return rejected(fmt::format("the command cannot be understood: {}", wrong.what()));
}

access_commands::made_order access_commands::order_of(const json& what) const
{
    if (what.value("command", "") == "write")
        return write_order(what);
    const auto content = messages::parse_bytes(what.value("text", ""));
    if (!content)
        return order_outcome{order_result::rejected, 0,
                             fmt::format("text, character {}: {}", content.error().position, content.error().text)};
    return order_content(message_order{what.value("line", ""), *content});
}

access_commands::made_order access_commands::write_order(const json& what) const
{
    const auto target = parse_target(what.value("target", ""), config_);
    const std::vector<std::string> texts = texts_in(what);
    if (!target)
        return target.error();
    if (const auto* const point = std::get_if<point_target>(&*target)) {
        if (texts.size() != 1)
            return order_outcome{order_result::rejected, 0, "a point takes one value"};
        const auto index = points_.table().find(point->name);
        const bool is_text = index && points_.table().at(*index).form.type == value_type::text;
        return order_content(point_order{point->name, is_text ? text_value(texts[0]) : typed_value(texts[0])});
    }
    const auto* const device = std::get_if<device_target>(&*target);
    const auto* const station = std::get_if<station_target>(&*target);
    bool bits = station != nullptr && is_bits(station->first);
    for (const auto& plc : plcs_)
        if (device != nullptr && plc->name() == device->plc)
            if (const auto head = plc::parse_device(device->device, plc->model().names))
                bits = plc::is_bit_kind(head->kind);
    auto values = values_of(texts, bits, form_in(what));
    if (!values)
        return values.error();
    if (device != nullptr)
        return order_content(device_order{device->plc, device->device, std::move(*values)});
    return order_content(station_order{station->line, station->unit, station->first, std::move(*values)});
}

asio::awaitable<json> access_commands::read(json what)
{
    const auto target = parse_target(what.value("target", ""), config_);
    if (!target)
        co_return reply_of(target.error());
    if (const auto* const point = std::get_if<point_target>(&*target))
        co_return read_point(point->name);
    const auto form = form_of(form_in(what));
    if (!form)
        co_return reply_of(form.error());
    const std::uint32_t count = what.value("count", 1U);
    if (const auto* const device = std::get_if<device_target>(&*target))
        co_return read_devices(*device, count, *form);
    if (!is_active_())
        co_return reply_of(standby_refuses);

    const auto& station = std::get<station_target>(*target);
    const auto line =
        std::find_if(lines_.begin(), lines_.end(), [&](const auto& each) { return each->config.name == station.line; });
    const bool bits = is_bits(station.first);
    const std::size_t each = bits ? 1 : registers_of(form->type, form->characters);
    if (line == lines_.end() || count > modbus::max_read_bits)
        co_return rejected(line == lines_.end() ? "the line does not run" : "that is more than one request reads");
    const duration within = milliseconds(what.value("timeout_ms", 0U));
    const order asked{station_order{}, {}, within};
    auto work = read_station(**line, station.unit, station.first, static_cast<std::uint32_t>(count * each),
                             begin_by(asked, now(), wall_now()));
    const auto got = co_await std::move(work);
    json reply = reply_of(got.outcome);
    if (got.outcome.result == order_result::ok)
        reply["values"] =
            rows(json_of(got.values, *form), each, [&](std::uint32_t skip) { return place_name(station.first, skip); });
    co_return reply;
}

json access_commands::read_point(const std::string& name) const
{
    const point_table& table = points_.table();
    const point& p = table.at(*table.find(name));
    std::vector<std::uint16_t> words(registers_of(p.form.type, p.form.characters));
    if (p.form.type == value_type::boolean)
        words = {static_cast<std::uint16_t>(p.plc->memory().bit(p.at) ? 1 : 0)};
    else
        p.plc->memory().read(p.at, words);
    const point_sources& sources = points_.table().sources();
    const source_state state = sources.of(sources.find({p.plc, p.at, bits_of(p)}));
    json row = value_row(p.name, json_of(decode(p.form, words)));
    row["quality"] = to_string(state.state);
    if (!p.unit.empty())
        row["unit"] = p.unit;
    json reply = reply_of({});
    reply["values"] = json::array({std::move(row)});
    return reply;
}

json access_commands::read_devices(const device_target& from, std::uint32_t count, const point_form& f) const
{
    const auto found = std::find_if(plcs_.begin(), plcs_.end(), [&](const auto& p) { return p->name() == from.plc; });
    if (found == plcs_.end())
        return reply_of({order_result::not_found, 0, fmt::format("there is no PLC \"{}\"", from.plc)});
    const plc::simulated_plc& plc = **found;
    const auto head = plc::parse_device(from.device, plc.model().names);
    const auto at = head ? plc.memory().find(*head) : std::nullopt;
    if (!at)
        return reply_of({order_result::not_found, 0,
                         fmt::format("PLC \"{}\" has no device \"{}\": give one such as {}", from.plc, from.device,
                                     plc.model().examples)});
    const bool bits = plc::is_bit_kind(head->kind);
    const std::size_t step = bits ? 1 : registers_of(f.type, f.characters);
    const std::size_t wanted = step * count * (bits ? 1 : 16);
    if (count == 0 || wanted > plc.memory().bits_from(*at))
        return rejected(fmt::format("there are not {} from {} on", count, from.device));
    order_values values{bits, static_cast<std::uint32_t>(step * count), std::vector<std::uint16_t>((wanted + 15) / 16)};
    for (std::size_t i = 0; i < wanted; ++i)
        if (plc.memory().bit({at->area, at->bit + i}))
            values.words[i / 16] = static_cast<std::uint16_t>(values.words[i / 16] | 1U << i % 16);
    json reply = reply_of({});
    reply["values"] = rows(json_of(values, f), step, [&](std::uint32_t skip) {
        return plc::to_string({head->kind, head->number + skip}, plc.model().names);
    });
    return reply;
}

}  // namespace plcgw
