// What the driver of a line does besides when its gateway is a member of a pair: asks before it speaks, listens to what
// others say, and tells the routes what it heard. Without a pair it does nothing and costs nothing.
//
// While silent on a serial port the port is open and listened to. On TCP a silent line is not connected: device servers
// and PLCs have few connections and hang up on those that say nothing, and a connection on which nobody asks does not
// show whether the other end lives.
#pragma once

#include "bridge/routes/client_line.hpp"
#include "bridge/standby/line_listener.hpp"
#include "bridge/standby/line_voice.hpp"
#include "daemon/config/config.hpp"
#include "daemon/read_before.hpp"

#include <boost/asio/io_context.hpp>

namespace plcgw {

class line_ear {
public:
    line_ear(asio::io_context& loop, const line_config& line, client_line& routes);

    void obey(line_voice& voice);

    // At this moment. To be asked before anything is sent.
    bool may_speak() const { return voice_ == nullptr || voice_->may_speak(now()); }

    // The same, and tells the routes when it has changed. To be asked between two questions.
    bool look();

    // TCP: comes back when it may speak, or wake() was called. The port is not open.
    bool is_deaf() const { return voice_ != nullptr && !listener_; }
    asio::awaitable<void> wait();
    void wake() { pause_.cancel(); }

    void opened();
    void closed();
    // False when this process stood still while they waited, and another member may have asked meanwhile: nobody knows
    // how old they are.
    bool heard(bytes received);
    void spoke(bytes ours);
    time_point look_again_at() const;  // while silent: until then bytes may be waited for
    void tell();                       // the routes what was heard by now

private:
    line_listener listener_of(const line_config& line) const;

    const line_config& line_;
    client_line& routes_;
    line_voice* voice_ = nullptr;
    std::optional<line_listener> listener_;  // of a serial port
    bool open_ = false;
    bool speaks_ = true;
    time_point awake_at_{};  // looked, heard or spoke last
    asio::steady_timer pause_;
};

}  // namespace plcgw
