#include "daemon/blocks.hpp"

namespace plcgw {

void published_blocks::add(const block_config& from, plc::simulated_plc& plc)
{
    plc_block block;
    block.plc = &plc;
    block.head = *plc::parse_device(from.device, plc.model().names);
    block.at = *plc.memory().find(block.head);
    block.count = from.count;
    block.name = from.plc + "." + plc::to_string(block.head, plc.model().names);
    rows_.push_back({std::move(block), from.writable});
}

void published_blocks::memory_changed(const plc::simulated_plc& plc, const plc::change& changed)
{
    for (row& block : rows_)
        block.changed = block.changed || touches(block.content, plc, changed);
}

published_blocks::found published_blocks::find(const std::string& name) const
{
    for (const row& each : rows_)
        if (each.content.name == name)
            return {&each.content, each.writable};
    return {};
}

void published_blocks::qualities_changed()
{
    for (row& block : rows_)
        block.changed = block.changed || sample_now(block).state != block.said;
}

void published_blocks::say_everything()
{
    for (row& block : rows_)
        block.changed = true;
}

void published_blocks::keep_silences(time_point now, duration longest)
{
    for (row& block : rows_)
        block.changed = block.changed || now - block.said_at >= longest;
}

void published_blocks::publish()
{
    if (!dds_.is_open())
        return;
    for (row& block : rows_) {
        if (!std::exchange(block.changed, false))
            continue;
        const sample now_in_it = sample_now(block);
        block.said = now_in_it.state;
        block.said_at = now();
        dds_.publish(now_in_it);
    }
}

sample published_blocks::sample_now(const row& block) const
{
    sample made = sample_of(block.content, wall_now());
    for (const auto& line : lines_)
        line->routes.worsen(made, *block.content.plc, block.content.at, bits_of(block.content));
    for (const auto& line : messages_)
        line->content.worsen(made, *block.content.plc, block.content.at, bits_of(block.content));
    return made;
}

}  // namespace plcgw
