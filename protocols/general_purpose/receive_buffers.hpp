// The eight receive buffers of a port, which GPRECV empties: FP7 serial communication manual 9.4.1, 9.4.4 and 10.3.2.
#pragma once

#include "protocols/bytes.hpp"
#include "protocols/errc.hpp"

#include <deque>
#include <optional>

namespace plcgw::general_purpose {

// Bits of the receive error code (PMGET, D+2). The low byte is what a character can suffer, the high byte a message.
namespace receive_error {
inline constexpr std::uint16_t overrun = 1U << 0;
inline constexpr std::uint16_t stop_bit = 1U << 1;
inline constexpr std::uint16_t parity = 1U << 2;
inline constexpr std::uint16_t buffer_overflow = 1U << 8;  // a message longer than a buffer
inline constexpr std::uint16_t buffers_full = 1U << 9;     // a message came while all eight were full
}  // namespace receive_error

enum class when_full : std::uint8_t {
    stop,  // as the PLC: nothing is received any more until the channel is reset (10.2.3)
    drop,  // the newest message is lost, and reception goes on when a buffer is free
};

struct receive_counters {
    std::uint64_t received = 0;   // messages that went into a buffer
    std::uint64_t lost = 0;       // whole messages, because no buffer was free or reception had stopped
    std::uint64_t damaged = 0;    // characters at fault, or too long
    std::uint64_t restarted = 0;  // begun anew by a start code, or abandoned without an end code
};

class receive_buffers {
public:
    static constexpr std::size_t size = 8;

    explicit receive_buffers(when_full policy = when_full::stop) : policy_(policy) {}

    void add(result<buffer> received);  // what message_framer::next() gave
    std::optional<buffer> take();       // the oldest message; also those that came before reception stopped
    void reset();                       // channel reset (4.1, Y10): empties the buffers, clears the errors

    std::size_t waiting() const { return messages_.size(); }  // reception done flag X0 = waiting() > 0
    bool stopped() const { return stopped_; }
    std::uint16_t error_code() const { return errors_; }        // bits of receive_error, until reset()
    std::uint16_t error_count() const { return error_count_; }  // of the low byte, wraps; one for each message (D+3)
    const receive_counters& counters() const { return counters_; }  // since the start

private:
    void note(errc why);

    when_full policy_;
    std::deque<buffer> messages_;
    bool stopped_ = false;
    std::uint16_t errors_ = 0;
    std::uint16_t error_count_ = 0;
    receive_counters counters_;
};

}  // namespace plcgw::general_purpose
