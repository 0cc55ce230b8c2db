#include "bridge/plc/memory.hpp"

#include <algorithm>
#include <utility>

namespace plcgw::plc {
namespace {

void append(std::vector<change>& changes, const change& next)
{
    if (!changes.empty() && changes.back().area == next.area &&
        changes.back().first_bit + changes.back().count == next.first_bit)
        changes.back().count += next.count;
    else
        changes.push_back(next);
}

}  // namespace

bool overlaps(const change& changed, place first, std::size_t bits)
{
    return changed.area == first.area && changed.first_bit < first.bit + bits &&
           first.bit < changed.first_bit + changed.count;
}

memory::memory(const plc::model& m) : model_(&m)
{
    for (const area& a : m.areas) {
        image& made = images_.emplace_back();
        const std::size_t bits = std::size_t{a.count} * a.bits_per_device;
        made.registers.resize((bits + 15) / 16);
        made.dirty.resize(made.registers.size());
        made.writable.assign(made.registers.size(), 0xFFFF);
        close(made, 0, std::size_t{a.absent} * a.bits_per_device);
        close(made, bits, 16 * made.registers.size() - bits);
    }
}

void memory::close(image& of, std::size_t first_bit, std::size_t count)
{
    for (std::size_t bit = first_bit; bit < first_bit + count; ++bit)
        of.writable[bit / 16] = static_cast<std::uint16_t>(of.writable[bit / 16] & ~(1U << bit % 16));
}

std::optional<place> memory::find(device d) const
{
    for (std::size_t i = 0; i < model_->areas.size(); ++i)
        if (const auto bit = first_bit(model_->areas[i], d))
            return place{i, *bit};
    return std::nullopt;
}

std::size_t memory::bits_from(place p) const
{
    const area& a = model_->areas[p.area];
    return std::size_t{a.count} * a.bits_per_device - p.bit;
}

bool memory::bit(place p) const { return (images_[p.area].registers[p.bit / 16] >> (p.bit % 16) & 1U) != 0; }

std::uint16_t memory::word(place p) const
{
    const auto& registers = images_[p.area].registers;
    const std::size_t index = p.bit / 16;
    const std::size_t shift = p.bit % 16;
    std::uint32_t pair = registers[index];
    if (shift != 0)  // a run of bits that begins inside a register
        pair |= std::uint32_t{registers[index + 1]} << 16;
    return static_cast<std::uint16_t>(pair >> shift);
}

void memory::read(place p, std::span<std::uint16_t> words) const
{
    for (std::uint16_t& value : words) {
        value = word(p);
        p.bit += 16;
    }
}

void memory::set_bit(place p, bool value)
{
    note_write(p, 1);
    put_bit(p, value);
}

void memory::set_word(place p, std::uint16_t value)
{
    note_write(p, 16);
    put_word(p, value);
}

memory::watch memory::watch_writes(place p, std::size_t bits)
{
    image& of = images_[p.area];
    of.watched.resize(of.registers.size());
    if (ended_watches_.empty()) {
        ended_watches_.push_back(watches_.size());
        watches_.emplace_back();
    }
    const watch made = ended_watches_.back();
    ended_watches_.pop_back();
    watches_[made] = {p, bits};
    for (std::size_t index = p.bit / 16; index <= (p.bit + bits - 1) / 16; ++index)
        of.watched[index].push_back(made);
    return made;
}

void memory::end_watch(watch w)
{
    const watched_run& run = watches_[w];
    image& of = images_[run.first.area];
    for (std::size_t index = run.first.bit / 16; index <= (run.first.bit + run.bits - 1) / 16; ++index)
        std::erase(of.watched[index], w);
    ended_watches_.push_back(w);
}

bool memory::take_written(watch w) { return std::exchange(watches_[w].written, false); }

void memory::note_write(place p, std::size_t bits)
{
    const image& of = images_[p.area];
    if (of.watched.empty())
        return;
    for (std::size_t index = p.bit / 16; index <= (p.bit + bits - 1) / 16; ++index)
        for (const watch each : of.watched[index]) {
            watched_run& run = watches_[each];
            run.written = run.written || overlaps({p.area, p.bit, bits}, run.first, run.bits);
            written_ = written_ || run.written;
        }
}

void memory::put_bit(place p, bool value)
{
    image& of = images_[p.area];
    const std::uint16_t before = of.registers[p.bit / 16];
    const unsigned mask = 1U << p.bit % 16 & of.writable[p.bit / 16];
    store(of, p.bit / 16, static_cast<std::uint16_t>(value ? before | mask : before & ~mask));
}

void memory::put_word(place p, std::uint16_t value)
{
    image& of = images_[p.area];
    const std::size_t index = p.bit / 16;
    const std::size_t shift = p.bit % 16;
    const std::uint32_t mask = 0xFFFFU << shift;
    const std::uint32_t moved = std::uint32_t{value} << shift;
    const auto put = [&of, this](std::size_t at, std::uint32_t bits, std::uint32_t values) {
        const std::uint32_t open = bits & of.writable[at];
        store(of, at, static_cast<std::uint16_t>((of.registers[at] & ~open) | (values & open)));
    };
    put(index, mask, moved);
    if (shift != 0)
        put(index + 1, mask >> 16, moved >> 16);
}

void memory::set_protected(place p, std::size_t bits, bool on)
{
    image& of = images_[p.area];
    if (on)
        close(of, p.bit, bits);
    for (std::size_t bit = p.bit; !on && bit < p.bit + bits; ++bit)
        of.writable[bit / 16] = static_cast<std::uint16_t>(of.writable[bit / 16] | 1U << bit % 16);
}

bool memory::is_open(place p, std::size_t bits) const
{
    const image& of = images_[p.area];
    for (std::size_t bit = p.bit; bit < p.bit + bits; ++bit)
        if ((of.writable[bit / 16] >> bit % 16 & 1U) == 0)
            return false;
    return true;
}

void memory::show_bit(place p, bool value)
{
    image& of = images_[p.area];
    const std::uint16_t before = of.registers[p.bit / 16];
    const unsigned mask = 1U << p.bit % 16;
    store(of, p.bit / 16, static_cast<std::uint16_t>(value ? before | mask : before & ~mask));
}

void memory::show_word(place p, std::uint16_t value) { store(images_[p.area], p.bit / 16, value); }

void memory::store(image& of, std::size_t index, std::uint16_t value)
{
    if (of.registers[index] == value)
        return;
    of.dirty[index] = static_cast<std::uint16_t>(of.dirty[index] | (of.registers[index] ^ value));
    of.registers[index] = value;
    if (of.dirty_begin == of.dirty_end) {
        of.dirty_begin = index;
        of.dirty_end = index;
    }
    of.dirty_begin = std::min(of.dirty_begin, index);
    of.dirty_end = std::max(of.dirty_end, index + 1);
    changed_ = true;
}

std::vector<change> memory::take_changes()
{
    std::vector<change> changes;
    if (!changed_)
        return changes;
    for (std::size_t i = 0; i < images_.size(); ++i) {
        image& of = images_[i];
        const bool bit_devices = model_->areas[i].bits_per_device == 1;
        for (std::size_t at = of.dirty_begin; at < of.dirty_end; ++at) {
            const unsigned dirty = std::exchange(of.dirty[at], std::uint16_t{0});
            if (dirty != 0 && !bit_devices)
                append(changes, {i, 16 * at, 16});
            for (std::size_t bit = 0; bit_devices && bit < 16; ++bit)
                if ((dirty >> bit & 1U) != 0)
                    append(changes, {i, 16 * at + bit, 1});
        }
        of.dirty_begin = of.dirty_end = 0;
    }
    changed_ = false;
    return changes;
}

}  // namespace plcgw::plc
