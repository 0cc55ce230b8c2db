#include "protocols/modbus/rtu_bus.hpp"

#include "protocols/modbus/rtu.hpp"

#include <utility>

namespace plcgw::modbus {
namespace {

constexpr std::size_t most_kept = 2 * max_rtu_size + shortest_adu;  // an exchange of the longest frames
constexpr duration question_lifetime{5'000'000};
constexpr std::uint8_t exception_bit = 0x80;

bytes behind(bytes all, const bus_piece& front) { return all.subspan(front.size); }

}  // namespace

void rtu_bus_framer::feed(time_point now, bytes received)
{
    heard_ = now;
    received_.insert(received_.end(), received.begin(), received.end());
}

time_point rtu_bus_framer::deadline() const
{
    if (!heard_)
        return time_point{};
    return received_.empty() && in_step_ ? time_point::max() : *heard_ + max_silence_;
}

std::optional<bus_event> rtu_bus_framer::next(time_point now)
{
    if (!heard_)
        heard_ = now;
    if (events_.empty())
        look(now);
    if (events_.empty())
        return std::nullopt;
    bus_event first = std::move(events_.front());
    events_.pop_front();
    return first;
}

void rtu_bus_framer::look(time_point now)
{
    const bool quiet = now >= *heard_ + max_silence_;
    if (now >= asked_until_)
        asked_.reset();
    if (received_.empty()) {
        in_step_ = in_step_ || quiet;
        return;
    }
    const bus_verdict v = parser_.judge(received_, asked_);
    const bool ours = v.fits && parser_.is_ours(received_);
    if (ours && in_step_)
        take(*v.fits);
    else if (quiet && v.fits && !ours)
        settle(v);
    else if (quiet)
        settle_unknown(v);
    else if (v.fits && !ours)
        decide(v);
    else if (ours || !v.open)
        find_step();
}

// A neighbour's frame, or either of two. A CRC of 16 bits fits by chance now and then: what follows confirms it.
void rtu_bus_framer::decide(const bus_verdict& v)
{
    using answer = rtu_bus_parser::answer;
    const bytes all = received_;
    const answer first = parser_.answer_behind(all, *v.fits);
    const answer second = v.or_else ? parser_.answer_behind(all, *v.or_else) : answer::none;
    if (first == answer::whole)
        take(*v.fits);
    else if (second == answer::whole)
        take(*v.or_else);
    else if (v.open || first == answer::begun || second == answer::begun)
        return;
    else if (parser_.is_followed(all, *v.fits))
        take(*v.fits);
    else if (v.or_else && v.only_zeros && parser_.is_followed(all, *v.or_else))
        take(*v.or_else);
    else if (!parser_.judge(behind(all, *v.fits), std::nullopt).open &&
             (all.size() > most_kept || parser_.talk_from(all, v.fits->size, std::nullopt)))
        take(*v.fits);
}

// No frame of known length is at the front, and no silence in sight.
void rtu_bus_framer::find_step()
{
    auto at = parser_.talk_from(received_, 1, asked_);
    if (!at)
        at = behind_unknown();
    if (at) {
        const bool whole = cut(*at, false, false);
        in_step_ = in_step_ && whole;
    }
    else if (received_.size() > most_kept) {
        drop(max_rtu_size, errc::overlong);
        in_step_ = false;
    }
}

// In step, where frames of unknown functions end and a neighbour's request begins.
std::optional<std::size_t> rtu_bus_framer::behind_unknown() const
{
    const bytes all = received_;
    for (std::size_t at = shortest_adu; in_step_ && at + shortest_adu <= all.size(); ++at) {
        const auto found = parser_.judge(all.subspan(at), std::nullopt).fits;
        const bool asks = found && found->what == bus_piece::kind::request_adu && !parser_.is_ours(all.subspan(at));
        if (asks && !frame_ends(all.first(at)).empty())
            return at;
    }
    return std::nullopt;
}

// The line fell silent behind a neighbour's frame and whatever follows.
void rtu_bus_framer::settle(const bus_verdict& v)
{
    const bytes all = received_;
    for (const auto& each : {v.fits, v.or_else})
        if (each && parser_.is_filled(behind(all, *each), std::nullopt))
            return take(*each);
    if (v.or_else && is_frame(behind(all, *v.or_else)))
        return take(*v.or_else);
    // Noise and the beginning of a request to us look like a frame by chance, or a lost byte was taken from the
    // request.
    const auto whole = parser_.ends_with_ours(all) ? parser_.filled_from(all, asked_) : std::nullopt;
    if (!whole || *whole == 0 || *whole >= v.fits->size)
        return take(*v.fits);
    cut(*whole, true, false);
    in_step_ = true;
}

// The line fell silent, and the bytes do not begin with a frame of known length, or with one that is not believed.
void rtu_bus_framer::settle_unknown(const bus_verdict& v)
{
    const bool one =
        in_step_ && is_frame(received_) && (parser_.is_ours(received_) || !parser_.ends_with_ours(received_));
    const auto whole = one ? std::nullopt : parser_.filled_from(received_, asked_);
    if (whole == 0U)
        take(*v.fits);
    else
        cut(whole.value_or(received_.size()), true, v.open);
    in_step_ = true;
}

// Drops the front, unless frames of unknown functions fill it. In step, they may concern us: a broadcast, or a request
// to us with the silence behind it. True when nothing was dropped.
bool rtu_bus_framer::cut(std::size_t size, bool quiet, bool incomplete)
{
    const bytes front = bytes(received_).first(size);
    const std::vector<std::size_t> ends = frame_ends(front);
    std::size_t from = 0;
    bool believed = !ends.empty();
    for (const std::size_t end : ends) {
        const bytes adu = front.subspan(std::exchange(from, end));
        const bool asks_us_now = quiet && end == received_.size();
        believed = believed && (!parser_.is_ours(adu) || (in_step_ && (asks_us_now || !parser_.is_to_us(adu))));
    }
    if (!believed) {
        drop(size, size < shortest_adu   ? errc::too_short
                   : size > max_rtu_size ? errc::overlong
                   : incomplete          ? errc::incomplete
                                         : errc::bad_checksum);
        return false;
    }
    from = 0;
    for (const std::size_t end : ends)
        take_unknown(end - std::exchange(from, end));
    return true;
}

// A frame that only its CRC shows.
void rtu_bus_framer::take_unknown(std::size_t size)
{
    const bool exception = (received_[1] & exception_bit) != 0;
    const bool answers = asked_ && asked_->unit == unit_id{received_[0]} && asked_->function == received_[1];
    take({exception || answers ? bus_piece::kind::response_adu : bus_piece::kind::request_adu, size});
}

void rtu_bus_framer::take(const bus_piece& front)
{
    const bool asks = front.what == bus_piece::kind::request_adu;
    const bytes adu = bytes(received_).first(front.size);
    const bytes pdu = adu.subspan(1, front.size - rtu_overhead);
    events_.push_back({asks ? bus_event::kind::question : bus_event::kind::answer,
                       {unit_id{adu[0]}, buffer(pdu.begin(), pdu.end())},
                       {},
                       front.size});
    asked_ = asks ? parser_.question_in(adu) : std::nullopt;
    asked_until_ = *heard_ + question_lifetime;
    received_.erase(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(front.size));
}

void rtu_bus_framer::drop(std::size_t size, errc why)
{
    events_.push_back({bus_event::kind::dropped, {}, why, size});
    received_.erase(received_.begin(), received_.begin() + static_cast<std::ptrdiff_t>(size));
}

}  // namespace plcgw::modbus
