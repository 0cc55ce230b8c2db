// When the messages of a general-purpose line are sent: periodically, when a bit of the memory rises, or on request.
#pragma once

#include "protocols/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace plcgw::messages {

// The sources are numbered in the order in which they were added. What was asked for and what is periodic take turns,
// the oldest first.
class send_schedule {
public:
    std::size_t add_periodic(duration period);  // longer than 0; first at start()
    std::size_t add_triggered();                // by trigger(), request() or both

    void start(time_point now);

    // The level of the source's bit; it is sent once when the bit rises. A bit that is on at start has not risen.
    void trigger(std::size_t source, bool level, time_point now);
    void request(std::size_t source, time_point now);

    // The source to send now. It is not given again until finished(), and a request meanwhile sends it once more after.
    std::optional<std::size_t> next(time_point now);
    void finished(std::size_t source);
    time_point wake_at() const;  // when next() has something, if nobody asks before; time_point::max(): never

    // Requests while the source was waiting already: they are one sending with the first.
    std::uint64_t merged(std::size_t source) const { return sources_[source].merged; }
    // Periods that passed while the line was busy: they are not made up for.
    std::uint64_t missed(std::size_t source) const { return sources_[source].missed; }

private:
    struct row {
        duration period{};  // 0: none
        time_point due = time_point::max();
        std::optional<time_point> requested;
        std::optional<bool> level;
        bool under_way = false;
        std::uint64_t merged = 0;
        std::uint64_t missed = 0;
    };

    std::vector<row> sources_;
    bool asked_last_ = false;
};

}  // namespace plcgw::messages
