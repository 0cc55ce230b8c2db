#include "protocols/mewtocol/line_framer.hpp"

#include <algorithm>

namespace plcgw::mewtocol {
namespace {

constexpr std::size_t max_size(char header)  // CR included
{
    switch (header) {
    case '%': return 118;
    case '<': return 2048;
    case '>': return 4096;
    default: return 0;
    }
}

constexpr std::size_t kept_of_overlong = 8;  // header, station and frame number: what an answer needs

}  // namespace

void line_framer::feed(time_point now, bytes received)
{
    if (received.empty())
        return;
    heard_ = now;
    for (const std::uint8_t byte : received)
        take(static_cast<char>(byte));
}

void line_framer::take(char c)
{
    if (max_size(c) != 0) {
        drop(errc::restarted);
        state_ = state::frame;
        characters_.assign(1, c);
        size_ = 1;
        return;
    }
    if (state_ == state::idle && (c == '\r' || c == '\n'))
        return;
    ++size_;
    if (state_ != state::frame) {
        if (c == '\r')
            drop({});
        else
            state_ = state::noise;
        return;
    }
    if (c == '\r')
        report(size_ > max_size(characters_[0]) ? errc::overlong : errc{});
    else if (size_ < max_size(characters_[0]))
        characters_.push_back(c);
}

// Ends what has begun without CR. Noise is noise, whatever ended it.
void line_framer::drop(errc why)
{
    if (state_ != state::idle)
        report(state_ == state::noise ? errc::bad_header : why);
}

void line_framer::report(errc why)
{
    if (why == errc::bad_header)
        characters_.clear();
    else if (why != errc{})
        characters_.resize(std::min(characters_.size(), kept_of_overlong));
    events_.push_back({std::move(characters_), why, size_});
    characters_.clear();
    size_ = 0;
    state_ = state::idle;
}

std::optional<reception> line_framer::next(time_point now)
{
    if (events_.empty() && now >= deadline())
        drop(errc::incomplete);
    if (events_.empty())
        return std::nullopt;
    reception first = std::move(events_.front());
    events_.pop_front();
    return first;
}

time_point line_framer::deadline() const { return state_ == state::idle ? time_point::max() : heard_ + max_silence_; }

}  // namespace plcgw::mewtocol
