// Of those who answer or act by themselves: only the active member of a pair does. Without a pair it is always open.
#pragma once

#include "bridge/standby/line_voice.hpp"
#include "daemon/read_before.hpp"

#include <boost/asio/io_context.hpp>

namespace plcgw {

class answer_gate {
public:
    explicit answer_gate(asio::io_context& loop) : timer_(loop) {}

    void obey(const line_voice& voice) { voice_ = &voice; }
    bool is_open() const { return voice_ == nullptr || voice_->may_speak(now()); }

    bool is_ever_closed() const { return voice_ != nullptr; }

    asio::awaitable<void> wait()  // until it is open
    {
        constexpr duration round = std::chrono::milliseconds(100);
        while (!is_open()) {
            timer_.expires_after(round);
            co_await timer_.async_wait(no_throw);
        }
    }
    void wake() { timer_.cancel(); }

private:
    const line_voice* voice_ = nullptr;
    asio::steady_timer timer_;
};

// What an operation ends with that only the active member may finish.
inline constexpr auto not_active = asio::error::no_permission;

}  // namespace plcgw
