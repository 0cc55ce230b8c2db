// Everything that is said on an RTU line where we are server and others are too. MODBUS over Serial Line V1.02
// section 2.5.1.
//
// Silence cannot be trusted to separate frames: USB adapters glue and split what they deliver. So the bytes themselves
// are read: who was asked what is remembered, and tells what the next frame can be.
//
// - After a silence, and after each whole frame, the next byte begins a frame (the framer is "in step"). There a
// request
//   to one of our stations is recognised with its last byte. A neighbour's frame may be the response to the last
//   request, another response, or a request; it is decided when its CRC fits at the length of one, and no longer one
//   can come.
// - A frame with our unit id is never a response: we send those ourselves. (Where the adapter echoes what we send, put
//   an echo_filter before this.) So 05, 06, 08 and 16 cannot be confused: the echo of a neighbour is the neighbour's.
// - What fits nothing is kept until the line falls silent. All of it together is then a frame of unknown length, or
// else
//   the earliest place counts from which whole frames reach to the silence: noise before a request costs the silence as
//   delay, not the request. A request to us cannot be anywhere else, since the client waits for us after it; one that
//   lies in the data of a neighbour's damaged frame is followed at least by that frame's CRC.
// - Meanwhile an exchange of neighbours (a request and the response that fits it) brings the framer back without
// silence;
//   but until the next silence it then believes in no request to us before silence has followed it.
//
// What remains open, and how it is settled:
// - a neighbour's frame that is cut off exactly behind a request to us in its own data: it is taken for that request.
// The
//   same bytes come when our receiver lost a part of a response and the client went on at once, which is far likelier.
// - a broadcast, out of step, that is followed by other frames sooner than by silence: it is missed.
// - a request to us of unknown length (unknown function, 08/00 with more than one word) directly behind noise: missed.
// - a neighbour's request and the response to it have the same bytes and length (05, 06 ...): the first after another
//   request or response is the request, the second the response.
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
    // the client waits for an answer.
    rtu_bus_framer(std::vector<unit_id> own, duration max_silence) : parser_(std::move(own)), max_silence_(max_silence)
    {
    }

    void feed(time_point now, bytes received);
    std::optional<bus_event> next(time_point now);
    time_point deadline() const;

    time_point heard() const
    {
        return heard_.value_or(time_point{});
    }  // last byte: the gap before a reply begins there

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
