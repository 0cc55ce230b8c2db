#include "daemon/watch_filter.hpp"

#include <algorithm>
#include <cctype>

namespace plcgw {
namespace {

// What an event is about. Without a name it is a gateway itself.
struct subject {
    dds_topic topic{};
    const std::string* gateway{};
    const std::string* name{};
};

subject subject_of(const received_block& e) { return {dds_topic::register_block, &e.gateway, &e.value.route}; }
subject subject_of(const received_point& e) { return {dds_topic::point, &e.gateway, &e.name}; }
subject subject_of(const received_status& e) { return {dds_topic::gateway_status, &e.who.gateway, nullptr}; }
subject subject_of(const received_port& e) { return {dds_topic::port_status, &e.gateway, &e.status.port}; }
subject subject_of(const received_device& e) { return {dds_topic::device_status, &e.gateway, &e.status.device}; }
subject subject_of(const received_message& e) { return {dds_topic::serial_message, &e.gateway, &e.value.line}; }
subject subject_of(const received_event& e) { return {dds_topic::event, &e.gateway, &e.subject}; }
subject subject_of(const gone_block& e) { return {dds_topic::register_block, &e.gateway, &e.route}; }
subject subject_of(const gone_point& e) { return {dds_topic::point, &e.gateway, &e.name}; }
subject subject_of(const gone_port& e) { return {dds_topic::port_status, &e.gateway, &e.port}; }
subject subject_of(const gone_device& e) { return {dds_topic::device_status, &e.gateway, &e.device}; }
subject subject_of(const gone_gateway& e) { return {dds_topic::gateway_status, &e.gateway, nullptr}; }

bool covers(const watch_filter& filter, const std::string& block, const std::string& area, std::uint32_t first,
            std::uint32_t count)
{
    return !filter.area.empty() && area == filter.area && block.starts_with(filter.block_prefix) &&
           filter.number >= first && filter.number - first < count;
}

bool is_over_device(const watch_filter& filter, const dds_event& event, const subject& of)
{
    if (const auto* const block = std::get_if<received_block>(&event))
        if (covers(filter, block->value.route, block->value.area, block->value.first, block->value.count))
            return true;
    if (const auto* const gone = std::get_if<gone_block>(&event))
        if (covers(filter, gone->route, gone->area, gone->first, 1))
            return true;
    const bool has_values = of.topic == dds_topic::register_block || of.topic == dds_topic::point;
    return has_values && filter.over_device.contains(*of.name);
}

std::string plain(std::string_view text)
{
    std::string out;
    for (const char c : text)
        if (c != '_' && c != '-')
            out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

}  // namespace

std::optional<dds_topic> topic_from(const std::string& text)
{
    for (std::size_t i = 0; i < dds_topics; ++i)
        if (plain(to_string(static_cast<dds_topic>(i))) == plain(text))
            return static_cast<dds_topic>(i);
    return std::nullopt;
}

bool fits(const watch_filter& filter, const dds_event& event)
{
    const subject of = std::visit([](const auto& e) { return subject_of(e); }, event);
    const auto is_one = [](const auto& all, const auto& value) {
        return all.empty() || std::ranges::find(all, value) != all.end();
    };
    if (!is_one(filter.gateways, *of.gateway) || !is_one(filter.topics, of.topic))
        return false;
    if (of.name == nullptr)
        return true;
    const bool named = filter.names.empty() || std::ranges::any_of(filter.names, [&](const std::string& beginning) {
                           return of.name->starts_with(beginning);
                       });
    return named && (!filter.by_device || is_over_device(filter, event, of));
}

bool is_counted(const watch_filter& filter, const dds_event& event)
{
    const bool is_value =
        std::holds_alternative<received_block>(event) || std::holds_alternative<received_point>(event);
    const bool is_gone = std::holds_alternative<gone_block>(event) || std::holds_alternative<gone_point>(event) ||
                         std::holds_alternative<gone_port>(event) || std::holds_alternative<gone_device>(event) ||
                         std::holds_alternative<gone_gateway>(event);
    return filter.topics.empty() ? is_value : !is_gone;
}

}  // namespace plcgw
