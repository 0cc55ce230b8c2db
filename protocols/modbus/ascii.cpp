#include "protocols/modbus/ascii.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace plcgw::modbus {
namespace {

constexpr std::uint8_t start = ':';
constexpr std::uint8_t carriage_return = 0x0D;
constexpr std::size_t longest_fragment = 8;  // characters, of what cannot be a frame

void append_hex(buffer& to, std::uint8_t value)
{
    constexpr const char* digits = "0123456789ABCDEF";
    to.push_back(static_cast<std::uint8_t>(digits[value >> 4]));
    to.push_back(static_cast<std::uint8_t>(digits[value & 0xF]));
}

std::optional<std::uint8_t> digit(std::uint8_t c)
{
    if (c >= '0' && c <= '9')
        return static_cast<std::uint8_t>(c - '0');
    if (c >= 'A' && c <= 'F')
        return static_cast<std::uint8_t>(c - 'A' + 10);
    if (c >= 'a' && c <= 'f')
        return static_cast<std::uint8_t>(c - 'a' + 10);
    return std::nullopt;
}

}  // namespace

std::uint8_t lrc(bytes data) { return static_cast<std::uint8_t>(0 - std::accumulate(data.begin(), data.end(), 0U)); }

buffer encode_ascii(const frame& f, std::uint8_t delimiter)
{
    buffer content{static_cast<std::uint8_t>(f.unit)};
    content.insert(content.end(), f.pdu.begin(), f.pdu.end());
    content.push_back(lrc(content));

    buffer adu{start};
    for (const std::uint8_t each : content)
        append_hex(adu, each);
    adu.push_back(carriage_return);
    adu.push_back(delimiter);
    return adu;
}

void ascii_framer::feed(time_point now, bytes received)
{
    heard_ = now;
    received_.erase(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(std::exchange(seen_, 0)));
    received_.insert(received_.end(), received.begin(), received.end());
}

time_point ascii_framer::deadline() const { return inside_ ? heard_ + ascii_max_silence : time_point::max(); }

std::optional<result<frame>> ascii_framer::next(time_point now)
{
    while (seen_ < received_.size())
        if (auto happened = take(received_[seen_++]))
            return happened;
    return inside_ && now >= deadline() ? lose(errc::incomplete) : std::nullopt;
}

ascii_framer::event ascii_framer::take(std::uint8_t character)
{
    if (inside_ && ending_ && std::find(delimiters_.begin(), delimiters_.end(), character) != delimiters_.end()) {
        inside_ = false;
        ended_by_ = character;
        return ++size_ > max_ascii_size ? make_error_code(errc::overlong) : whole();
    }
    if (character == start) {
        const bool restarts = std::exchange(inside_, true);
        ending_ = false;
        size_ = 1;
        digits_.clear();
        return restarts ? event(make_error_code(errc::incomplete)) : std::nullopt;
    }
    if (!inside_)
        return std::nullopt;
    if (++size_ > max_ascii_size)
        return lose(errc::overlong);
    const auto value = digit(character);
    if (ending_ || (!value && character != carriage_return))
        return lose(errc::bad_character);
    ending_ = character == carriage_return;
    if (value)
        digits_.push_back(*value);
    return std::nullopt;
}

ascii_framer::event ascii_framer::lose(errc why)
{
    inside_ = false;
    return make_error_code(why);
}

result<frame> ascii_framer::whole() const
{
    if (size_ <= longest_fragment)
        return make_error_code(errc::too_short);
    if (digits_.size() % 2 != 0)
        return make_error_code(errc::bad_checksum);
    buffer content;
    for (std::size_t i = 0; i < digits_.size(); i += 2)
        content.push_back(static_cast<std::uint8_t>(digits_[i] << 4 | digits_[i + 1]));
    if (lrc(content) != 0)  // over data and its own LRC the sum is zero
        return make_error_code(errc::bad_checksum);
    return frame{unit_id{content.front()}, buffer(content.begin() + 1, content.end() - 1)};
}

ascii_answer::ascii_answer(unit_id unit, const request& question, std::uint8_t delimiter)
    : framer_(delimiter), unit_(unit), question_(&question)
{
}

std::optional<response> ascii_answer::feed(bytes received)
{
    constexpr time_point now{};  // silence is the caller's business
    empty_ = empty_ && received.empty();
    framer_.feed(now, received);
    while (auto each = framer_.next(now)) {
        if (!*each) {
            last_ = answer_fault{static_cast<errc>(each->error().value()), {}};
            continue;
        }
        if (each->value().unit == unit_)
            if (auto answer = parse_response(*question_, each->value().pdu))
                return std::move(*answer);
        last_ = answer_fault{errc::unexpected_answer, std::move(**each)};
    }
    return std::nullopt;
}

answer_fault ascii_answer::fault() const
{
    if (framer_.inside())
        return {errc::incomplete, {}};
    return last_.value_or(answer_fault{errc::timed_out, {}});
}

bool ascii_answer::begun() const
{
    if (framer_.inside() || !last_)
        return framer_.inside();
    return !last_->received || mismatch_of(unit_, *question_, *last_->received) > mismatch::function;
}

bool ascii_answer::whole() const { return begun() && !framer_.inside(); }

}  // namespace plcgw::modbus
