// Blocks of words longer than one frame are cut into several commands, and what SEND and RECV say when it is over. FP7
// serial communication manual 7.3.2, 7.4.2: 507 words written, 509 read with the header `<`.
#pragma once

#include "protocols/mewtocol/areas.hpp"
#include "protocols/mewtocol/response.hpp"

namespace plcgw::mewtocol {

// The most words in one frame.
constexpr std::uint32_t max_words_read(header h)
{
    return static_cast<std::uint32_t>((max_frame_size(h) - 9) / 4);  // %01$RD and BCC, CR
}
constexpr std::uint32_t max_words_written(header h, word_area to)
{
    const word_area_row& row = row_of(to);
    return static_cast<std::uint32_t>((max_frame_size(h) - 7 - row.write.size() - range_size(row)) / 4);
}

static_assert(max_words_read(header::expansion) == 509 && max_words_read(header::normal) == 27);
static_assert(max_words_written(header::expansion, word_area::dt) == 507);
static_assert(max_words_written(header::normal, word_area::dt) == 24);

enum class long_reads : std::uint8_t {
    cut,          // several commands, each answered in one frame: any server can do it
    many_frames,  // one command: `%` servers that split their responses answer with the values of one moment
};

// The commands in their order. A block that needs several is cut behind an even number of words, so that no value of 32
// bits is torn. Nothing if the area has no such command or the numbers do not fit into its fields.
std::optional<std::vector<command>> plan_read(const read_words& block, header h, long_reads how = long_reads::cut);
std::optional<std::vector<command>> plan_write(const write_words& block, header h);

// What SEND and RECV store (7.3.2 note 4). 1 to 3 are the line's: who uses the port, and for how many.
enum class result_code : std::uint16_t {
    good = 0,
    port_used_by_master = 1,
    port_used_by_slave = 2,
    too_many_masters = 3,
    send_timeout = 4,
    response_timeout = 5,
    bad_response = 6,
};

inline constexpr unsigned max_masters = 16;  // on all ports together (1.3.3)

result_code result_of(errc why);

template <class Answer>
result_code result_of(const result<Answer>& outcome)
{
    if (!outcome)
        return outcome.error().category() == protocol_category() ? result_of(errc{outcome.error().value()})
                                                                 : result_code::send_timeout;
    return std::holds_alternative<error_code>(*outcome) ? result_code::bad_response : result_code::good;
}

}  // namespace plcgw::mewtocol
