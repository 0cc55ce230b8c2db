// Everything that is said on an RTU line where we are server and others are too. MODBUS over Serial Line V1.02 section
// 2.5.1.
//
// Silence cannot be trusted to separate frames: USB adapters glue and split what they deliver. So the bytes are read:
// the function table tells lengths, the CRC confirms them, and who was asked what tells what comes next.
//
// - After a silence, and behind each whole frame, the next byte begins a frame: the framer is in step. There a request
//   to one of our stations, or to all, is recognised with its last byte.
// - A neighbour's frame is the response to the last request, another response, or a request. Nobody waits for us to say
//   which, and 16 bits of CRC fit by chance now and then: it is decided when the next frame confirms it, or silence.
// - What fits nothing is kept until silence. Then the earliest place counts from which whole frames reach to the
//   silence: noise before a request to us costs the silence as delay, not the request. The request must be the last of
//   them, for its client waits. So one in the data of a neighbour's damaged frame is not taken: a CRC follows it.
// - Meanwhile an exchange of neighbours, a request with the response that fits it, shows where frames begin. But until
//   the next silence no request to us is believed before silence has followed it.
// - A frame of unknown length (unknown function, 08/00 with more than one word, wrong byte count) ends with silence.
// - A frame with our unit id is a request to us, except for exceptions: responses with our unit id are ours to send.
//   What comes behind a request to us is a request again. Where the adapter echoes, put an echo_filter before this.
//
// What the bytes leave open, and how it is settled:
// - 05, 06, 08 and 16: the neighbour's response equals the request. The first of the two is the request.
// - A frame and 00 behind it have a right CRC together. Where both are possible (a response that nobody asked for, a
//   request to all) what follows decides; at last it is the request.
// - A neighbour's frame that is cut off exactly behind a request to us in its own data is taken for that request: the
//   same bytes come when we lost a part of a response and the client went on at once, which is far likelier.
// - Out of step, a request to all that is followed by other frames sooner than by silence is missed. So is a request to
//   us of unknown length directly behind noise.
// - Requests to all that no client sends to all, such as reads, are believed only in step.
#pragma once

#include "protocols/framer.hpp"
#include "protocols/modbus/rtu_bus_parser.hpp"

#include <deque>

namespace plcgw::modbus {

struct bus_event {
    enum class kind : std::uint8_t {
        question,  // a request: to one of our stations, to a neighbour, or to all
        answer,    // a response of a neighbour
        dropped,   // errc::bad_checksum, incomplete, too_short, overlong
    };
    kind what{};
    frame content;       // unless dropped
    errc why{};          // dropped
    std::size_t size{};  // on the wire
    bool operator==(const bus_event&) const = default;
};

class rtu_bus_framer {
public:
    using frame_type = bus_event;

    // max_silence: longer than 3.5 characters, longer than the adapter holds back a part of a frame, and shorter than
    // the client waits for an answer. The first silence is waited for, too.
    rtu_bus_framer(std::vector<unit_id> own, duration max_silence) : parser_(std::move(own)), max_silence_(max_silence)
    {
    }

    void feed(time_point now, bytes received);
    std::optional<bus_event> next(time_point now);
    time_point deadline() const;

    // The last byte came then: the gap before a reply begins there.
    time_point heard() const { return heard_.value_or(time_point{}); }

private:
    void look(time_point now);
    void decide(const bus_verdict& v);
    void find_step();
    void settle(const bus_verdict& v);
    void settle_unknown(const bus_verdict& v);
    std::optional<std::size_t> behind_unknown() const;
    bool cut(std::size_t size, bool quiet, bool incomplete);
    void take(const bus_piece& front);
    void take_unknown(std::size_t size);
    void drop(std::size_t size, errc why);

    rtu_bus_parser parser_;
    duration max_silence_;
    buffer received_;  // begins with a frame when in step
    bool in_step_ = false;
    std::optional<time_point> heard_;  // or begun to listen
    asked_question asked_;             // a neighbour owes the response
    time_point asked_until_{};
    std::deque<bus_event> events_;
};

}  // namespace plcgw::modbus
