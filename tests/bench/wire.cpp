#include "tests/bench/wire.hpp"

#include <algorithm>
#include <utility>

namespace plcgw::bench {
namespace {

constexpr std::size_t fifo_trigger = 8;   // of 16: what Linux sets for a 16550A
constexpr std::int64_t fifo_timeout = 4;  // characters without a new one
constexpr std::size_t nonsense = 300;     // bytes that no request has

// The first register that the response to a read shows.
std::optional<unsigned> value_of(byte_span response)
{
    constexpr std::size_t shortest = 7;
    if (response.size() < shortest || (response[1] != 3 && response[1] != 4))
        return std::nullopt;
    return static_cast<unsigned>(response[3]) << 8 | response[4];
}

}  // namespace

void wire::heard(nanoseconds now, byte_span bytes)
{
    for (const std::uint8_t each : bytes) {
        if (now > sent_until_ || burst_size_ == 0) {
            burst_start_ = std::max(now, sent_until_);
            burst_size_ = 0;
        }
        const nanoseconds start = std::max(sent_until_, burst_start_);
        if (request_.empty())
            begin_request(start);
        else if (start - sent_until_ > 3 * format_.characters(1) / 2)
            ++window_.torn_requests;
        sent_until_ = burst_start_ + format_.characters(++burst_size_);
        busy_until_ = std::max(busy_until_, sent_until_);
        request_.push_back(each);
        const auto size = request_size(request_);
        if (!size || request_.size() > nonsense) {
            ++window_.bad_requests;
            request_.clear();
        }
        else if (request_.size() == *size) {
            end_request(sent_until_);
        }
    }
}

void wire::begin_request(nanoseconds start)
{
    if (response_) {
        if (start >= response_end()) {  // it is through, and only our clock is late
            finish_response();
        }
        else {  // whoever sends into a response destroys it
            ++window_.collisions;
            response_.reset();
            answered_last_ = false;
        }
    }
    if (busy_until_ == 0)
        return;
    window_.note_silence(start - busy_until_, format_.rule(), answered_last_);
    answered_last_ = false;
}

void wire::end_request(nanoseconds end)
{
    const byte_vector adu = std::exchange(request_, {});
    ++window_.requests;
    auto answer = stations_.ask(adu);
    const unsigned first = static_cast<unsigned>(adu[2]) << 8 | adu[3];
    if (adu[1] == 6 || adu[1] == 16) {
        const std::size_t value_at = adu[1] == 6 ? 4 : 7;
        window_.note_write({adu[0], first, static_cast<unsigned>(adu[value_at]) << 8 | adu[value_at + 1], end});
    }
    if (!answer) {
        ++window_.unanswered;
        return;
    }
    response_on_wire& sent = response_.emplace();
    sent.start = end + answer->turnaround;
    sent.bytes = std::move(answer->response);
    sent.unit = adu[0];
    sent.function = adu[1];
    sent.first = first;
    sent.ideal = format_.rule() + format_.characters(static_cast<std::int64_t>(adu.size())) + answer->turnaround +
                 format_.characters(static_cast<std::int64_t>(sent.bytes.size()));
    busy_until_ = response_end();
}

nanoseconds wire::response_end() const
{
    return response_->start + format_.characters(static_cast<std::int64_t>(response_->bytes.size()));
}

std::size_t wire::next_chunk() const
{
    const std::size_t size = response_->bytes.size();
    switch (format_.how) {
    case delivery::byte: return std::min(size, response_->handed_over + 1);
    case delivery::fifo: return std::min(size, response_->handed_over + fifo_trigger);
    case delivery::frame: break;
    }
    return size;
}

nanoseconds wire::handed_over_at(std::size_t count) const
{
    const bool timed_out = format_.how == delivery::fifo && count - response_->handed_over < fifo_trigger;
    return response_->start + format_.characters(static_cast<std::int64_t>(count) + (timed_out ? fifo_timeout : 0));
}

nanoseconds wire::deadline() const { return response_ ? handed_over_at(next_chunk()) : never(); }

byte_vector wire::due(nanoseconds now)
{
    byte_vector chunk;
    while (response_) {
        const std::size_t until = next_chunk();
        if (handed_over_at(until) > now)
            break;
        const auto begin = response_->bytes.begin();
        chunk.insert(chunk.end(), begin + static_cast<std::ptrdiff_t>(response_->handed_over),
                     begin + static_cast<std::ptrdiff_t>(until));
        response_->handed_over = until;
        if (until == response_->bytes.size())
            finish_response();
    }
    return chunk;
}

void wire::finish_response()
{
    window_.note_answer({response_->unit, response_->function, response_->first, response_->ideal, response_end(),
                         value_of(response_->bytes)});
    answered_last_ = true;
    response_.reset();
}

}  // namespace plcgw::bench
