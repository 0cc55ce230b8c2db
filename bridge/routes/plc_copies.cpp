#include "bridge/routes/plc_copies.hpp"

#include <algorithm>

namespace plcgw {
namespace {

// Whole registers of the source in one piece, so that long values arrive whole; the bits of a run one by one.
void carry(const plc_copy& c, std::size_t offset, std::size_t bits)
{
    const plc::memory& from = c.from->memory();
    plc::memory& to = c.to->memory();
    for (; bits >= 16; offset += 16, bits -= 16)
        to.set_word({c.at.area, c.at.bit + offset}, from.word({c.first.area, c.first.bit + offset}));
    for (; bits > 0; ++offset, --bits)
        to.set_bit({c.at.area, c.at.bit + offset}, from.bit({c.first.area, c.first.bit + offset}));
}

}  // namespace

void plc_copies::add(plc_copy copy)
{
    starts& of = areas_[{copy.from, copy.first.area}];
    of.by_first.emplace(copy.first.bit, copies_.size());
    of.longest = std::max(of.longest, copy.bits);
    copies_.push_back(std::move(copy));
}

void plc_copies::memory_changed(const plc::simulated_plc& plc, const plc::change& changed) const
{
    const auto area = areas_.find({&plc, changed.area});
    if (area == areas_.end())
        return;
    const std::size_t end = changed.first_bit + changed.count;
    const std::size_t begin = changed.first_bit - std::min(changed.first_bit, area->second.longest);
    const auto& by_first = area->second.by_first;
    for (auto each = by_first.lower_bound(begin); each != by_first.end() && each->first < end; ++each) {
        const plc_copy& c = copies_[each->second];
        const std::size_t first = std::max(c.first.bit, changed.first_bit);
        const std::size_t last = std::min(c.first.bit + c.bits, end);
        if (first < last)
            carry(c, first - c.first.bit, last - first);
    }
}

}  // namespace plcgw
