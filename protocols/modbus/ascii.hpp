// ASCII framing, MODBUS over Serial Line V1.02 section 2.5.2: ':', then unit, PDU and LRC in hexadecimal digits, CR and
// the delimiter.
#pragma once

#include "protocols/framer.hpp"
#include "protocols/modbus/answer_fault.hpp"

namespace plcgw::modbus {

inline constexpr std::uint8_t ascii_delimiter = 0x0A;    // until diagnostics sub-function 03 changes it
inline constexpr std::size_t max_ascii_size = 513;       // characters, from ':' to the delimiter
inline constexpr duration ascii_max_silence{1'000'000};  // between two characters of a frame

std::uint8_t lrc(bytes data);

buffer encode_ascii(const frame& f, std::uint8_t delimiter = ascii_delimiter);

// Cuts frames out of what a line brings, requests and responses alike. Characters before ':' are nobody's.
class ascii_framer {
public:
    using frame_type = frame;

    explicit ascii_framer(std::uint8_t delimiter = ascii_delimiter) : delimiters_{delimiter} {}

    void feed(time_point now, bytes received);

    // A frame, or errc::bad_checksum, incomplete, too_short (8 characters or fewer), overlong, bad_character: once for
    // each frame that is lost. ':' begins a frame anew, wherever it comes.
    std::optional<result<frame>> next(time_point now);
    time_point deadline() const;

    // For characters that next() has not seen: stations of one line may have one each.
    void set_delimiters(buffer any_of) { delimiters_ = std::move(any_of); }
    std::uint8_t delimiter() const { return ended_by_; }  // of the frame that next() gave last

    bool inside() const { return inside_; }  // a frame that is not whole yet
    time_point heard() const { return heard_; }

private:
    using event = std::optional<result<frame>>;

    event take(std::uint8_t character);
    event lose(errc why);
    result<frame> whole() const;

    buffer delimiters_;
    std::uint8_t ended_by_ = ascii_delimiter;
    buffer received_;
    std::size_t seen_ = 0;  // of these
    bool inside_ = false;
    bool ending_ = false;   // CR has come
    std::size_t size_ = 0;  // characters of the frame so far
    buffer digits_;         // their values, without ':'
    time_point heard_{};
};

// Finds the answer in what a line brings after a request: unit, function, length and LRC must all fit.
class ascii_answer {
public:
    ascii_answer(unit_id unit, const request& question, std::uint8_t delimiter);

    std::optional<response> feed(bytes received);

    // To be asked when the line fell silent:
    answer_fault fault() const;
    bool empty() const { return empty_; }
    bool begun() const;  // a damaged frame, or one of this unit and function
    bool whole() const;  // what has begun has ended, although damaged: no other answer is on its way
    bool inside() const { return framer_.inside(); }

private:
    ascii_framer framer_;
    unit_id unit_;
    const request* question_;
    std::optional<answer_fault> last_;
    bool empty_ = true;
};

}  // namespace plcgw::modbus
