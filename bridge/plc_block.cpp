#include "bridge/plc_block.hpp"

namespace plcgw {
namespace {

bool is_bits(const plc_block& b) { return plc::is_bit_kind(b.head.kind); }

}  // namespace

std::size_t bits_of(const plc_block& b) { return is_bits(b) ? b.count : std::size_t{16} * b.count; }

bool touches(const plc_block& b, const plc::simulated_plc& plc, const plc::change& changed)
{
    return b.plc == &plc && plc::overlaps(changed, b.at, bits_of(b));
}

sample sample_of(const plc_block& b, wall_time now)
{
    std::vector<std::uint16_t> words((bits_of(b) + 15) / 16);
    for (std::size_t i = 0; i < bits_of(b); ++i)
        if (b.plc->memory().bit({b.at.area, b.at.bit + i}))
            words[i / 16] = static_cast<std::uint16_t>(words[i / 16] | 1U << (i % 16));
    return {.route = b.name,
            .area = std::string(plc::to_string(b.head.kind, b.plc->model().names)),
            .first = b.head.number,
            .format = is_bits(b) ? sample_format::bits : sample_format::words,
            .count = b.count,
            .words = std::move(words),
            .state = quality::good,
            .source = now};
}

}  // namespace plcgw
