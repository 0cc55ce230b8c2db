// A MODBUS TCP connection as a line: one connection for many units, several requests under way when the server takes
// them.
#pragma once

#include "bridge/routes/client_line.hpp"
#include "daemon/line_driver.hpp"
#include "daemon/line_ear.hpp"
#include "daemon/tcp_connection.hpp"
#include "protocols/modbus/tcp_questions.hpp"

#include <array>
#include <functional>
#include <map>

namespace plcgw {

class tcp_line final : public line_driver {
public:
    // settle: called after answers, to drain what they changed.
    tcp_line(asio::io_context& loop, line_config config, client_line& routes, std::function<void()> settle);

    asio::awaitable<void> run() override;
    void wake() override;
    const port_status& port() const override { return connection_.meter().status(); }
    void obey(line_voice& voice) override { ear_.obey(voice); }

private:
    struct under_way {
        client_line::question question;
        unsigned attempts = 0;
        time_point sent_at{};  // the last of them
    };
    using key = modbus::tcp_questions::key;

    asio::awaitable<boost::system::error_code> serve();  // until the connection fails
    asio::awaitable<boost::system::error_code> listen();
    void ask_what_is_due(buffer& out);
    void ask(key who, buffer& out);
    void ask_again_or_fail(buffer& out);
    bool take_answers(bytes received);  // false when the stream is no MODBUS TCP
    void finish(const modbus::tcp_questions::outcome& outcome);
    void give_up_all();

    line_config config_;
    client_line& routes_;
    std::function<void()> settle_;
    tcp_connection connection_;
    line_ear ear_;
    modbus::mbap_framer in_;
    modbus::tcp_questions open_;
    std::map<key, under_way> questions_;
    std::uint32_t last_key_ = 0;
    std::array<std::uint8_t, 4096> received_{};
    bool idle_ = false;
};

}  // namespace plcgw
