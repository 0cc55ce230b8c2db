// The server's side of a MEWTOCOL-COM line, without the memory: which frames are for this station, what is wrong with
// them, and the messages in several frames. FP7 serial communication manual 11.2; FP0H Ethernet manual 5.3 (errors).
//
// The checks come in this order: station, length (!27), BCC (!40), mark (!41), a message in several frames under way
// (!43), then those of parse_command(), then the memory's.
#pragma once

#include "protocols/mewtocol/frame.hpp"
#include "protocols/mewtocol/line_framer.hpp"
#include "protocols/mewtocol/response.hpp"

namespace plcgw::mewtocol {

struct server_options {
    station_id own{};         // 1 to 99; none: it hears no frames but those to all
    bool answers_any = true;  // EE: with several stations on a line only one may
    command_set offered = all_commands;
    bool expansion = true;           // knows the header `<`; without, such frames are not answered
    bool several_frames = true;      // `%` responses and commands in several frames; without, they are refused with !43
    duration rest_kept{30'000'000};  // an unfinished message in several frames is forgotten after this
};

class server {
public:
    explicit server(const server_options& options) : options_(options) {}

    // Nothing to do, bytes to send, or a command to execute: then call answer().
    using action = std::variant<std::monostate, buffer, command>;
    action hear(time_point now, const reception& r);

    // The response of the command that hear() returned last, as bytes. Nothing if it is not answered.
    std::optional<buffer> answer(time_point now, const response& r);

    const server_options& options() const { return options_; }

private:
    bool answers(station_id to) const;
    action refuse(const frame& to, error_code why) const;
    action hear_command(time_point now, const frame& f);
    action hear_piece(time_point now, const frame& f);
    action parse(const frame& f, std::string_view text);
    buffer next_piece(time_point now);
    void forget();

    server_options options_;
    frame asked_{};       // header and station of the command being executed, or of the message under way
    command question_{};  // being executed
    std::string rest_;    // what was not sent yet of a response
    std::string begun_;   // the text so far of a command in several frames
    time_point touched_{};
};

}  // namespace plcgw::mewtocol
