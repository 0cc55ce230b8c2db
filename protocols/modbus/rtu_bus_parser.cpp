#include "protocols/modbus/rtu_bus_parser.hpp"

#include "protocols/modbus/crc.hpp"
#include "protocols/modbus/function_table.hpp"
#include "protocols/modbus/rtu.hpp"

#include <algorithm>
#include <utility>

namespace plcgw::modbus {
namespace {

using kind = bus_piece::kind;
using length = std::optional<std::size_t>;

constexpr std::size_t longest_glitch = 3;  // within an exchange: transceivers that turn round
constexpr std::uint8_t exception_bit = 0x80;

// Finds where frames end, from `from` on. A place from which it cannot be done is tried once.
bool split(bytes adus, std::size_t from, std::vector<std::size_t>& ends, std::vector<bool>& tried)
{
    if (from == adus.size())
        return true;
    if (tried[from])
        return false;
    tried[from] = true;
    std::uint16_t crc = 0xFFFF;
    for (std::size_t to = from; to < adus.size() && to - from < max_rtu_size;) {
        crc = crc16(adus.subspan(to++, 1), crc);
        if (crc != 0 || to - from < shortest_adu)
            continue;
        ends.push_back(to);
        if (split(adus, to, ends, tried))
            return true;
        ends.pop_back();
    }
    return false;
}

// Two frames begin with the same bytes. The longer one is likelier, unless it adds nothing but zeros: whatever frame
// these follow, the CRC still fits.
void compare(bytes rest, bus_verdict& v)
{
    const auto [shorter, longer] = std::minmax({v.fits->size, v.or_else->size});
    const bytes more = rest.subspan(shorter, longer - shorter);
    v.only_zeros = std::all_of(more.begin(), more.end(), [](std::uint8_t each) { return each == 0; });
    if (!v.only_zeros && !v.fits->awaited && v.or_else->size > v.fits->size)
        std::swap(v.fits, v.or_else);
    const bool sure = v.fits->awaited && (!v.only_zeros || v.or_else->size < v.fits->size);
    if (shorter == longer || sure)
        v.or_else.reset();
}

// Functions that a client sends to all: writes, and the commands among the diagnostics (V1.02 section 2.1, FX3
// manual 7.1).
bool is_for_all(bytes adu)
{
    constexpr std::uint8_t writes[] = {0x05, 0x06, 0x0F, 0x10, 0x15, 0x16};
    constexpr std::uint8_t commands[] = {0x01, 0x03, 0x04, 0x0A};
    const auto is_one_of = [](const auto& codes, std::uint8_t code) {
        return std::find(std::begin(codes), std::end(codes), code) != std::end(codes);
    };
    if (adu[1] == static_cast<std::uint8_t>(function::diagnostics))
        return adu.size() > 3 && adu[2] == 0 && is_one_of(commands, adu[3]);
    return is_one_of(writes, adu[1]);
}

}  // namespace

bool is_frame(bytes adu) { return adu.size() >= shortest_adu && adu.size() <= max_rtu_size && crc_fits(adu); }

std::vector<std::size_t> frame_ends(bytes adus)
{
    std::vector<std::size_t> ends;
    std::vector<bool> tried(adus.size());
    if (is_frame(adus))
        ends.push_back(adus.size());
    else
        split(adus, 0, ends, tried);
    return ends;
}

length bus_question::response_in(bytes rest) const
{
    if (unit_id{rest[0]} != unit || (rest[1] & ~exception_bit) != function)
        return 0;
    const length told = response_length(rest.subspan(1));
    if (!response_size || (rest[1] & exception_bit) != 0)
        return told;
    const bool told_by_question_alone = function == static_cast<std::uint8_t>(modbus::function::diagnostics);
    const bool contradicts = told && *told != *response_size && !told_by_question_alone;
    return contradicts ? 0 : response_size;
}

// Responses are sent by us and not to us, and no request has an exception's function code.
bool rtu_bus_parser::is_ours(bytes adu) const
{
    const unit_id unit{adu[0]};
    const bool addressed = unit == unit_id::broadcast || std::find(own_.begin(), own_.end(), unit) != own_.end();
    return addressed && (adu[1] & exception_bit) == 0;
}

bus_verdict rtu_bus_parser::judge(bytes rest, const asked_question& asked) const
{
    bus_verdict v;
    if (rest.size() < 2) {
        v.open = true;
        return v;
    }
    const auto consider = [&](kind what, length pdu_size, bool awaited) {
        const std::size_t size = pdu_size.value_or(rest.size() - 2) + rtu_overhead;  // one more at least
        if (pdu_size == 0U || size > max_rtu_size)
            return;
        if (rest.size() < size)
            v.open = true;
        else if (crc_fits(rest.first(size)))
            (v.fits ? v.or_else : v.fits) = bus_piece{what, size, awaited};
    };
    if (asked)
        consider(kind::response_adu, asked->response_in(rest), true);
    const bool awaited = v.fits.has_value();
    consider(kind::request_adu, request_length(rest.subspan(1)), false);
    if (!is_ours(rest) && !awaited)
        consider(kind::response_adu, response_length(rest.subspan(1)), false);
    if (v.or_else)
        compare(rest, v);
    v.open = v.open && !awaited;
    return v;
}

asked_question rtu_bus_parser::question_in(bytes adu) const
{
    if (is_ours(adu))
        return std::nullopt;
    bus_question q{unit_id{adu[0]}, adu[1], {}};
    if (const auto parsed = parse_request(adu.subspan(1, adu.size() - rtu_overhead)))
        q.response_size = response_size(*parsed, {});
    return q;
}

rtu_bus_parser::answer rtu_bus_parser::answer_behind(bytes rest, const bus_piece& front) const
{
    const auto q = front.what == kind::request_adu ? question_in(rest.first(front.size)) : std::nullopt;
    for (std::size_t at = front.size; q && at < rest.size() && at <= front.size + longest_glitch; ++at) {
        const bytes behind = rest.subspan(at);
        const auto second = judge(behind, q).fits;
        if (second && second->awaited)
            return answer::whole;
        const length size = behind.size() < 2 ? length{} : q->response_in(behind);
        if (at == front.size && size != 0U && behind.size() < (size ? *size + rtu_overhead : max_rtu_size))
            return answer::begun;
    }
    return answer::none;
}

bool rtu_bus_parser::is_followed(bytes rest, const bus_piece& front) const
{
    if (front.size >= rest.size())
        return false;
    const bytes behind = rest.subspan(front.size);
    const auto next = judge(behind, std::nullopt).fits;
    return next && !nothing_may_follow(behind, *next);
}

// Zeros are frequent: out of step, not every function is believed to be a broadcast.
bool rtu_bus_parser::is_plausible(bytes rest) const
{
    return unit_id{rest[0]} != unit_id::broadcast || !is_ours(rest) || is_for_all(rest);
}

// A client that asked us waits: what other bytes come behind, those were not a request to us.
bool rtu_bus_parser::nothing_may_follow(bytes rest, const bus_piece& front) const
{
    return is_to_us(rest) && front.size < rest.size();
}

bool rtu_bus_parser::is_filled(bytes rest, const asked_question& asked) const
{
    if (rest.empty())
        return true;
    const bus_verdict v = judge(rest, asked);
    if (!v.fits || nothing_may_follow(rest, *v.fits) || !is_plausible(rest))
        return false;
    return is_filled(rest.subspan(v.fits->size), asked) ||
           (v.or_else && is_filled(rest.subspan(v.or_else->size), asked));
}

length rtu_bus_parser::filled_from(bytes all, const asked_question& asked) const
{
    const bool glitch = all.back() == 0x00 || all.back() == 0xFF;
    for (const std::size_t end : {all.size(), all.size() - (glitch ? 1U : 0U)})
        for (std::size_t from = 0; from + shortest_adu <= end; ++from)
            if (is_filled(all.subspan(from, end - from), asked))
                return from;
    return std::nullopt;
}

length rtu_bus_parser::talk_from(bytes all, std::size_t first, const asked_question& asked) const
{
    for (std::size_t from = first; from + shortest_adu <= all.size(); ++from) {
        const bytes rest = all.subspan(from);
        const auto found = judge(rest, asked).fits;
        if (found && (found->awaited || is_answered(rest, *found)))
            return from;
    }
    return std::nullopt;
}

bool rtu_bus_parser::ends_with_ours(bytes all) const
{
    for (std::size_t from = 1; from + shortest_adu <= all.size(); ++from) {
        const bytes rest = all.subspan(from);
        const auto found = is_ours(rest) && is_plausible(rest) ? judge(rest, std::nullopt).fits : std::nullopt;
        if (found && found->size == rest.size())
            return true;
    }
    return false;
}

}  // namespace plcgw::modbus
