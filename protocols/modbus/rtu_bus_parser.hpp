// What bytes of an RTU line can be, for rtu_bus_framer: requests to us, neighbours' requests and responses, by length
// and CRC. Looks at bytes only; time and decisions are the framer's.
#pragma once

#include "protocols/modbus/types.hpp"

#include <optional>

namespace plcgw::modbus {

inline constexpr std::size_t shortest_adu = 4;

// What a neighbour was asked.
struct bus_question {
    unit_id unit{};
    std::uint8_t function{};
    std::optional<std::size_t> response_size;  // of the PDU, where the request tells it

    // Size of the PDU if these bytes begin the response; nothing while they do not tell, 0 if they do not.
    std::optional<std::size_t> response_in(bytes rest) const;
};

struct bus_piece {
    enum class kind : std::uint8_t { request_adu, response_adu } what{};
    std::size_t size{};
    bool awaited = false;  // the response to the question
};

// The whole frames that bytes can begin with: none, one, or two of different size. The first is the likelier one.
struct bus_verdict {
    std::optional<bus_piece> fits;
    std::optional<bus_piece> or_else;
    bool only_zeros = false;  // make the difference
    bool open = false;        // it may still become another, longer one
};

using asked_question = std::optional<bus_question>;

class rtu_bus_parser {
public:
    explicit rtu_bus_parser(std::vector<unit_id> own) : own_(std::move(own)) {}

    // Whether these bytes, if they are a frame, are a request that concerns us.
    bool is_ours(bytes adu) const;
    bool is_to_us(bytes adu) const { return is_ours(adu) && unit_id{adu[0]} != unit_id::broadcast; }

    bus_verdict judge(bytes rest, const asked_question& asked) const;

    // The question that a neighbour's request is; nothing if it concerns us.
    asked_question question_in(bytes adu) const;

    // Whether the response to a neighbour's request comes behind it.
    enum class answer : std::uint8_t { none, begun, whole };
    answer answer_behind(bytes rest, const bus_piece& front) const;
    bool is_answered(bytes rest, const bus_piece& front) const { return answer_behind(rest, front) == answer::whole; }

    // Any frame of known length comes behind the piece at the front.
    bool is_followed(bytes rest, const bus_piece& front) const;

    // Frames of known length fill these bytes.
    bool is_filled(bytes rest, const asked_question& asked) const;

    // The earliest place from which frames of known length fill the rest, perhaps but for the glitch of a transceiver.
    std::optional<std::size_t> filled_from(bytes all, const asked_question& asked) const;

    // The earliest place, not before `first`, that neighbours' talk proves to be the beginning of a frame: an exchange,
    // or the response that is owed.
    std::optional<std::size_t> talk_from(bytes all, std::size_t first, const asked_question& asked) const;

    bool ends_with_ours(bytes all) const;

private:
    bool is_plausible(bytes rest) const;
    bool nothing_may_follow(bytes rest, const bus_piece& front) const;

    std::vector<unit_id> own_;
};

// A right CRC, whatever the length.
bool is_frame(bytes adu);

// Where frames of any length that follow each other end. Empty if these bytes are not such frames.
std::vector<std::size_t> frame_ends(bytes adus);

}  // namespace plcgw::modbus
