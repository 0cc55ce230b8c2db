// Drives one general-purpose line: hears its messages, and sends what is due.
#pragma once

#include "daemon/answer_gate.hpp"
#include "daemon/fp7_line_ports.hpp"
#include "daemon/line_connection.hpp"
#include "daemon/line_driver.hpp"
#include "daemon/line_messages_of.hpp"
#include "protocols/echo_filter.hpp"
#include "protocols/general_purpose/marked_characters.hpp"

#include <array>
#include <functional>

namespace plcgw {

class message_line final : public line_driver {
public:
    // settle: called after what was received or sent, to drain what it changed.
    message_line(asio::io_context& loop, line_config config, messages::line_messages content,
                 std::function<void()> settle);

    void obey(line_voice& voice) override { gate_.obey(voice); }  // of a pair: the standby listens
    asio::awaitable<void> run() override;
    void wake() override;
    const port_status& port() const override { return connection_->meter().status(); }
    fp7_line_ports* com_ports() override { return &ports_; }
    void reset_channel() override;

    bool allows_dds() const { return config_.messages.dds_sends; }

    messages::line_messages content;

private:
    asio::awaitable<boost::system::error_code> serve();  // until the port fails
    asio::awaitable<boost::system::error_code> listen();
    asio::awaitable<boost::system::error_code> exchange(messages::line_messages::question question);
    void take_messages();
    template <class Receiver>
    void look_for_overruns(Receiver& into);
    void take(result<buffer> message);
    void say_what_is_not_seen();
    asio::awaitable<boost::system::result<std::size_t>> read(time_point until);
    asio::awaitable<boost::system::error_code> send(bytes message);
    void show_in_ports();
    void settle();

    template <class Receiver>
    void feed(Receiver& into, bytes received);

    line_config config_;
    std::function<void()> settle_;
    std::unique_ptr<line_connection> connection_;
    general_purpose::marked_characters marks_;
    echo_filter echo_;  // of messages without an answer
    std::array<std::uint8_t, 4096> received_{};
    std::optional<std::uint64_t> overruns_;
    bool said_overruns_ = false;
    time_point line_free_from_{};
    bool idle_ = false;
    bool reading_ = false;
    answer_gate gate_;
    fp7_line_ports ports_;
    com_state shown_;  // by the ports
    unsigned resets_ = 0;
};

}  // namespace plcgw
