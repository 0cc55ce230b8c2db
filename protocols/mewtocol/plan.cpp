#include "protocols/mewtocol/plan.hpp"

#include <algorithm>

namespace plcgw::mewtocol {
namespace {

std::uint32_t piece_size(std::uint32_t count, std::uint32_t most) { return count <= most ? count : most & ~1U; }

}  // namespace

std::optional<std::vector<command>> plan_read(const read_words& block, header h, long_reads how)
{
    if (!is_expressible(block))
        return std::nullopt;
    if (how == long_reads::many_frames && h == header::normal)
        return std::vector<command>{block};
    const std::uint32_t piece = piece_size(block.count, max_words_read(h));
    std::vector<command> commands;
    for (std::uint32_t done = 0; done < block.count; done += piece)
        commands.emplace_back(read_words{block.from, block.first + done, std::min(piece, block.count - done)});
    return commands;
}

std::optional<std::vector<command>> plan_write(const write_words& block, header h)
{
    if (!is_expressible(block))
        return std::nullopt;
    const auto count = static_cast<std::uint32_t>(block.values.size());
    const std::uint32_t piece = piece_size(count, max_words_written(h, block.to));
    std::vector<command> commands;
    for (std::uint32_t done = 0; done < count; done += piece) {
        const auto begin = block.values.begin() + done;
        commands.emplace_back(
            write_words{block.to, block.first + done, {begin, begin + std::min(piece, count - done)}});
    }
    return commands;
}

result_code result_of(errc why)
{
    switch (why) {
    case errc::timed_out: return result_code::response_timeout;
    case errc::line_not_quiet:
    case errc::collision:
    case errc::port_absent:
    case errc::not_expressible: return result_code::send_timeout;
    default: return result_code::bad_response;
    }
}

}  // namespace plcgw::mewtocol
