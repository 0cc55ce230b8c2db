#include "protocols/general_purpose/message_framer.hpp"

#include <utility>

namespace plcgw::general_purpose {

void message_framer::feed(time_point now, bytes received)
{
    if (received.empty())
        return;
    heard_ = now;
    for (const std::uint8_t each : received)
        take(each);
}

void message_framer::fault(time_point now, errc why)
{
    heard_ = now;
    inside_ = true;
    lose(why);
}

time_point message_framer::deadline() const
{
    if (!inside_)
        return time_point::max();
    if (form_.end == end_code::silence)
        return heard_ + form_.silence;
    return form_.abandon > duration{} ? heard_ + form_.abandon : time_point::max();
}

std::optional<result<buffer>> message_framer::next(time_point now)
{
    if (ready_.empty() && now >= deadline()) {
        if (form_.end != end_code::silence)
            lose(errc::incomplete);
        end();
    }
    if (ready_.empty())
        return std::nullopt;
    std::optional<result<buffer>> first = std::move(ready_.front());
    ready_.pop_front();
    return first;
}

void message_framer::reset()
{
    abandon();
    ready_.clear();
}

void message_framer::abandon()
{
    content_.clear();
    size_ = 0;
    last_ = 0;
    inside_ = skipping_ = false;
}

void message_framer::take(std::uint8_t byte)
{
    if (form_.start == start_code::stx && byte == ascii::stx) {
        if (!content_.empty())
            lose(errc::restarted);
        abandon();
        inside_ = true;
        size_ = 1;
        return;
    }
    inside_ = true;
    if (++size_ > max_message_size)
        lose(errc::overlong);
    if (ends(byte)) {
        if (form_.end == end_code::cr_lf && !skipping_)
            content_.pop_back();
        end();
        return;
    }
    last_ = byte;
    if (!skipping_)
        content_.push_back(byte);
}

bool message_framer::ends(std::uint8_t byte) const
{
    switch (form_.end) {
    case end_code::cr: return byte == ascii::carriage_return;
    case end_code::cr_lf: return byte == ascii::line_feed && last_ == ascii::carriage_return;
    case end_code::etx: return byte == ascii::etx;
    case end_code::silence: break;
    }
    return false;
}

void message_framer::end()
{
    if (!skipping_)
        ready_.emplace_back(std::move(content_));
    abandon();
}

void message_framer::lose(errc why)
{
    if (!skipping_)
        ready_.emplace_back(make_error_code(why));
    skipping_ = true;
    content_.clear();
}

}  // namespace plcgw::general_purpose
