#include "bridge/standby/memory_mirror.hpp"

#include <algorithm>

namespace plcgw {

std::size_t memory_mirror::registers_in(const plc::simulated_plc& plc, std::size_t area)
{
    return (plc.memory().bits_from({area, 0}) + 15) / 16;
}

bool memory_mirror::is_special(const plc::simulated_plc& plc, std::size_t area)
{
    const plc::area& of = plc.model().areas[area];
    return of.first != 0 && (of.kind == plc::device_kind::m || of.kind == plc::device_kind::d);
}

void memory_mirror::memory_changed(const plc::simulated_plc& plc, const plc::change& changed)
{
    const auto found = std::find(plcs_.begin(), plcs_.end(), &plc);
    if (found == plcs_.end() || is_special(plc, changed.area))
        return;
    const auto number = static_cast<std::size_t>(found - plcs_.begin());
    const std::size_t last = chunk_of(changed.first_bit + changed.count - 1);
    for (std::size_t chunk = chunk_of(changed.first_bit); chunk <= last; ++chunk) {
        changed_.insert({number, changed.area, chunk});
        used_.insert({number, changed.area, chunk});
    }
}

void memory_mirror::say_everything() { changed_ = used_; }

std::optional<memory_chunk> memory_mirror::next()
{
    if (changed_.empty())
        return std::nullopt;
    const key first = *changed_.begin();
    changed_.erase(changed_.begin());
    return read(first);
}

memory_chunk memory_mirror::read(const key& where) const
{
    const plc::simulated_plc& plc = *plcs_[where.plc];
    memory_chunk out;
    out.plc = plc.name();
    out.area = static_cast<std::uint32_t>(where.area);
    out.first = static_cast<std::uint32_t>(where.chunk * memory_chunk::size);
    out.words.resize(std::min(memory_chunk::size, registers_in(plc, where.area) - out.first));
    for (std::size_t i = 0; i < out.words.size(); ++i)
        out.words[i] = plc.memory().word({where.area, 16 * (out.first + i)});
    return out;
}

bool memory_mirror::apply(const memory_chunk& chunk, const own_bits& own)
{
    const auto found =
        std::find_if(plcs_.begin(), plcs_.end(), [&](const auto* each) { return each->name() == chunk.plc; });
    if (found == plcs_.end() || chunk.area >= (*found)->model().areas.size() ||
        chunk.first + chunk.words.size() > registers_in(**found, chunk.area))
        return false;
    plc::memory& memory = (*found)->memory();
    for (std::size_t i = 0; i < chunk.words.size(); ++i) {
        const plc::place at{chunk.area, 16 * (chunk.first + i)};
        const unsigned kept = i < own.size() ? own[i] : 0U;
        memory.show_word(at, static_cast<std::uint16_t>((memory.word(at) & kept) | (chunk.words[i] & ~kept)));
    }
    return true;
}

}  // namespace plcgw
