// What a line does next: earliest deadline first, writes between the polls, and probes for silent stations that
// together take at most a twentieth of the line. Knows no protocol: an item is a number.
#pragma once

#include "bridge/routes/health.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace plcgw {

// Their answers may still come.
struct unanswered_requests {
    unsigned count = 0;
    time_point since{};  // when the first of them went out
};

class schedule {
public:
    explicit schedule(std::size_t stations) : stations_(stations) {}

    // Both return the item's number, counted from 0. A write has no period: it is due when ask() says so.
    std::size_t add_poll(std::size_t station, duration period);
    std::size_t add_write(std::size_t station);

    // How late an answer of this station may be; 5 s if nobody says so.
    void set_longest_delay(std::size_t station, duration longest) { stations_[station].longest_delay = longest; }

    void start(time_point now);  // spreads the first polls over their periods, at most over a second
    void ask(std::size_t item, time_point not_before = {})
    {
        items_[item].asked = true;
        items_[item].due = not_before;
    }

    // A write that is to be asked, or under way.
    bool is_wanted(std::size_t item) const { return items_[item].asked || items_[item].in_flight; }

    struct turn {
        std::size_t item{};
        bool with_retries{};  // a suspect or silent station gets one attempt
    };

    std::optional<turn> next(time_point now);
    time_point wake_at(time_point now) const;  // when next() may have an answer, if nothing is asked before

    enum class outcome {
        answered,
        silent,
        not_asked,  // the line was not free: the station is not to blame
    };
    // late: requests of this turn that were not answered; without it a silent turn counts as one.
    void finished(const turn& done, outcome how, duration took, time_point now, unanswered_requests late = {});

    health state_of(std::size_t station) const { return stations_[station].health.state(); }

private:
    struct item_state {
        std::size_t station{};
        duration period{};       // 0: a write
        time_point due{};        // of a poll
        bool asked = false;      // of a write
        bool in_flight = false;  // taken by next(), not finished: a TCP line asks several at a time
    };
    struct station_state {
        station_health health;
        std::size_t failed_item = 0;  // asked again before anything else while not healthy
        duration longest_delay{5'000'000};
        unsigned owed = 0;          // answers that may still come
        time_point owed_since{};    // when the first request of these went out
        time_point last_silence{};  // when the last one did
        time_point not_before{};    // until then they may come
    };

    time_point ready_at(std::size_t index) const;
    std::optional<std::size_t> first_probe(time_point now) const;
    std::optional<std::size_t> first_write(time_point now) const;
    std::optional<std::size_t> first_poll(time_point now) const;
    void remember_unanswered(station_state& of, unanswered_requests late, time_point now);
    void advance(item_state& of, time_point now);

    std::vector<item_state> items_;
    std::vector<station_state> stations_;
    time_point probe_not_before_{};
    std::size_t last_write_ = 0;  // writes take turns
    bool wrote_last_ = false;
};

}  // namespace plcgw
