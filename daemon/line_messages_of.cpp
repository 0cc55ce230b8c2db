#include "daemon/line_messages_of.hpp"

#include "daemon/line_connection.hpp"

namespace plcgw {
namespace {

using general_purpose::expect;
using general_purpose::hundredths;

plc_block block_of(const std::string& name, plc::simulated_plc& plc, const std::string& device, std::size_t words)
{
    plc_block block;
    block.name = name;
    block.plc = &plc;
    block.head = *plc::parse_device(device, plc.model().names);
    block.at = *plc.memory().find(block.head);
    block.count = static_cast<std::uint32_t>(plc::is_bit_kind(block.head.kind) ? 16 * words : words);
    return block;
}

messages::plc_bit bit_of(plc::simulated_plc& plc, const std::string& device)
{
    if (device.empty())
        return {};
    return {&plc, *plc.memory().find(*plc::parse_device(device, plc.model().names))};
}

general_purpose::message_form form_of(const line_config& line)
{
    const general_purpose_config& g = line.messages;
    const hundredths setting{static_cast<std::uint32_t>(g.end_silence.count() / 10)};
    return {g.start, g.end, general_purpose::end_silence(setting, format_of(line)), g.abandon};
}

general_purpose::exchange_options timing_of_messages(const line_config& line)
{
    return {.format = format_of(line),
            .response_timeout = line.response_timeout,
            .retries = line.retries,
            .send_wait = line.messages.send_wait,
            .gap = line.gap,
            .silence = line.silence,
            .echo = echo_of(line)};
}

messages::message_row row_of(const message_config& from, plc::simulated_plc& plc)
{
    messages::message_row row;
    row.name = from.name;
    row.form = *messages::pattern::parse(from.pattern);
    row.longest_silence = from.longest_silence;
    row.answer_to = from.answer_to;
    for (const field_config& each : from.fields) {
        const messages::field& f = row.fields.emplace_back(
            messages::field{each.name, each.type, static_cast<int>(each.decimals), each.characters, each.order});
        row.into.push_back(block_of(from.name + "." + each.name, plc, each.device, messages::registers_of(f)));
    }
    return row;
}

messages::send_row row_of(const send_config& from, const line_config& line, const find_plc& plc)
{
    messages::send_row row;
    row.name = from.name;
    row.text = *messages::parse_bytes(from.text);
    if (!from.device.empty())
        row.words = block_of(from.name, plc(from.plc), from.device, from.count);
    if (!from.trigger.empty())
        row.trigger = bit_of(plc(from.plc), from.trigger);
    row.period = from.period;
    row.answer = from.answer ? expect::message : expect::nothing;
    row.response_timeout = from.response_timeout.value_or(line.response_timeout);
    return row;
}

}  // namespace

messages::line_messages line_messages_of(const line_config& line, milliseconds longest_silence, const find_plc& plc)
{
    const general_purpose_config& g = line.messages;
    messages::line_messages made({line.name, form_of(line), timing_of_messages(line), longest_silence});
    for (const received_config& each : g.received)
        made.add(messages::raw_row{block_of(each.name, plc(each.plc), each.device, each.count),
                                   bit_of(plc(each.plc), each.ready), each.when_full});
    for (const send_config& each : g.sends)
        made.add(row_of(each, line, plc));
    for (const message_config& each : g.messages)
        made.add(row_of(each, plc(each.plc)));
    if (!g.status.device.empty())
        made.show_status_in(block_of(line.name, plc(g.status.plc), g.status.device, messages::status_words));
    if (!g.status.reset.empty())
        made.reset_by(bit_of(plc(g.status.plc), g.status.reset));
    return made;
}

}  // namespace plcgw
