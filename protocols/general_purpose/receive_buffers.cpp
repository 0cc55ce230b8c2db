#include "protocols/general_purpose/receive_buffers.hpp"

#include <utility>

namespace plcgw::general_purpose {
namespace {

std::uint16_t error_bit(errc why)
{
    switch (why) {
    case errc::overrun: return receive_error::overrun;
    case errc::bad_stop_bit: return receive_error::stop_bit;
    case errc::bad_parity: return receive_error::parity;
    case errc::overlong: return receive_error::buffer_overflow;
    default: return 0;
    }
}

}  // namespace

void receive_buffers::add(result<buffer> received)
{
    if (!received) {
        note(static_cast<errc>(received.error().value()));
        return;
    }
    if (stopped_ || messages_.size() == size) {
        ++counters_.lost;
        errors_ |= receive_error::buffers_full;
        stopped_ = policy_ == when_full::stop;
        return;
    }
    ++counters_.received;
    messages_.push_back(std::move(*received));
}

std::optional<buffer> receive_buffers::take()
{
    if (messages_.empty())
        return std::nullopt;
    std::optional<buffer> first = std::move(messages_.front());
    messages_.pop_front();
    return first;
}

void receive_buffers::reset()
{
    messages_.clear();
    stopped_ = false;
    errors_ = 0;
}

void receive_buffers::note(errc why)
{
    constexpr std::uint16_t of_characters = 0x00FF;
    const std::uint16_t bit = error_bit(why);
    errors_ |= bit;
    if ((bit & of_characters) != 0)
        ++error_count_;
    ++(bit != 0 ? counters_.damaged : counters_.restarted);
}

}  // namespace plcgw::general_purpose
