// The server's side of a MEWTOCOL7-COM line, without the memory. FP7 serial communication manual 11.3. The checks come
// in the order of MEWTOCOL-COM (server.hpp); an FP7 speaks both on one port, and the header tells which.
#pragma once

#include "protocols/mewtocol/line_framer.hpp"
#include "protocols/mewtocol/mewtocol7_message.hpp"

namespace plcgw::mewtocol7 {

struct server_options {
    station_id own{};         // 1 to 999
    bool answers_any = true;  // EEE: with several stations on a line only one may
    mewtocol7::dialect dialect{};
    duration rest_kept{30'000'000};  // the rest of a response in several frames is forgotten after this
};

class server {
public:
    explicit server(server_options options) : options_(std::move(options)) {}

    // Nothing to do, bytes to send, or a command to execute: then call answer().
    using action = std::variant<std::monostate, buffer, command>;
    action hear(time_point now, const mewtocol::reception& r);
    std::optional<buffer> answer(time_point now, const response& r);

    const server_options& options() const { return options_; }

private:
    bool answers(station_id to) const;
    action refuse(const frame& to, error_code why) const;
    action hear_continuation(time_point now, const frame& f);
    buffer send_piece(time_point now, std::string text);

    server_options options_;
    frame asked_{};       // station and frame number of what was answered last, or is being executed
    command question_{};  // being executed
    std::string rest_;    // what was not sent yet of a response
    buffer piece_;        // the last frame sent of one in several: sent again when its number is asked again
    time_point touched_{};
};

}  // namespace plcgw::mewtocol7
