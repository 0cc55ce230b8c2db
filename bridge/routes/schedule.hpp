// What a line does next: earliest deadline first within the polls; writes before forwarded requests before polls before
// probes before a scan, each within its share of the line. Knows no protocol: an item is a number.
#pragma once

#include "bridge/routes/health.hpp"
#include "bridge/routes/lane_shares.hpp"
#include "bridge/routes/poll_load.hpp"

#include <algorithm>
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
    explicit schedule(std::size_t stations);

    // All three return the number, counted from 0. A write has no period: it is due when ask() says so.
    std::size_t add_station();
    std::size_t add_poll(std::size_t station, duration period);
    std::size_t add_write(std::size_t station);

    // How late an answer of this station may be; 5 s if nobody says so.
    void set_longest_delay(std::size_t station, duration longest) { stations_[station].longest_delay = longest; }

    // Questions that may be under way at a time, 1 on a serial line: so many times the line can do.
    void set_parallel(unsigned questions) { parallel_ = questions; }

    // Each answer tells whose it is, as transaction ids do: a late one is taken for no other.
    void set_numbered_answers() { numbered_ = true; }

    void start(time_point now);  // spreads the first polls over their periods, at most over a second
    void ask(std::size_t item, time_point not_before = {})
    {
        items_[item].asked = true;
        items_[item].due = not_before;
    }

    // A write that is to be asked, or under way.
    bool is_wanted(std::size_t item) const { return items_[item].asked || items_[item].in_flight; }

    void forget(std::size_t item);  // a write that is not wanted any more

    struct turn {
        std::size_t item{};     // of writes, polls and probes
        bool with_retries{};    // a suspect or silent station gets one attempt
        lane of = lane::poll;   // forward, scan: the forwarded request or the scan's question that waits may go
        bool is_wanted = true;  // false: a write that nobody wants, whose turn is a probe
    };

    // forward_waits: a forwarded request could go now, as forward_at() says.
    std::optional<turn> next(time_point now, bool forward_waits = false);
    time_point wake_at(time_point now) const;  // when next() may have an answer, if nothing is asked before

    // When a forwarded request to this station may go; max() = not before a poll has shown how the station is.
    time_point forward_at(std::size_t station) const;
    // Until then late answers of the station may come.
    time_point quiet_until(std::size_t station) const { return stations_[station].not_before; }
    void keep_quiet(std::size_t station, time_point until)
    {
        stations_[station].not_before = std::max(stations_[station].not_before, until);
    }
    // Nobody would answer it: the station is down, and has not come back as far as is known.
    bool is_given_up(std::size_t station, time_point now) const;

    enum class outcome {
        answered,
        silent,
        not_asked,  // the line was not free: the station is not to blame
    };
    // late: requests of this turn that were not answered; without it a silent turn counts as one.
    void finished(const turn& done, outcome how, duration took, time_point now, unanswered_requests late = {});
    void pass(const turn& done, time_point now);  // a poll that is not needed any more was not asked
    // The same of a forwarded request. pause: so long its answer may come late, if it was silent.
    void forwarded(std::size_t station, outcome how, duration took, time_point now, unanswered_requests late,
                   duration pause);

    // A scan's question waits, and takes so long at most; nothing: none waits. It goes when there is time for it until
    // something else is due, or within its share.
    void set_scan(std::optional<duration> longest) { scan_ = longest; }
    void scanned(duration took, time_point now) { shares_.spent(lane::scan, took / parallel_, now); }
    // What became of somebody else's question to the station, which took no time of ours.
    void overheard(std::size_t station, outcome how, time_point now)
    {
        heard(stations_[station], how, {}, now, {});
        set_asked(station);
    }

    health state_of(std::size_t station) const { return stations_[station].health.state(); }
    time_point probe_at(std::size_t station) const { return stations_[station].health.probe_at(); }

    // Line time per second that the polls want, 1 = all of it; and by how much their periods are stretched to fit.
    double wanted() const { return load_.wanted() / parallel_; }
    double stretch() const { return stretch_; }

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
        std::optional<std::size_t> failed_item;  // asked again before anything else while not healthy
        std::optional<std::size_t> first_poll;   // asked when a forwarded request got no answer
        std::optional<std::size_t> a_write;      // probes a station without polls
        duration longest_delay{5'000'000};
        unsigned owed = 0;          // answers that may still come
        time_point owed_since{};    // when the first request of these went out
        time_point last_silence{};  // when the last one did
        time_point not_before{};    // until then they may come
        time_point failed_at{};     // a question that was under way then says nothing new by its silence
        bool counted = true;        // its polls take line time

        std::optional<std::size_t> probe() const { return first_poll ? first_poll : a_write; }
    };

    std::size_t add_item(std::size_t station, duration period);
    time_point ready_at(std::size_t index) const;
    std::optional<std::size_t> first_probe(time_point now) const;
    std::optional<std::size_t> first_write(time_point now) const;
    std::optional<std::size_t> first_poll(time_point now) const;
    std::optional<std::size_t> first_of(lane which, time_point now) const;
    time_point first_ready() const;
    bool may_scan(time_point now, bool others_wait) const;
    turn take(lane which, std::size_t index);
    void heard(station_state& of, outcome how, duration took, time_point now, unanswered_requests late);
    void remember_unanswered(station_state& of, unanswered_requests late, time_point now);
    void count_time(lane which, duration took, time_point now);
    void set_asked(std::size_t station);
    void advance(item_state& of, time_point now);
    duration period_now(const item_state& of) const;

    std::vector<item_state> items_;
    std::vector<station_state> stations_;
    lane_shares shares_;
    poll_load load_;
    double stretch_ = 1;
    unsigned parallel_ = 1;
    bool numbered_ = false;
    std::size_t last_write_ = 0;  // writes take turns
    std::optional<duration> scan_;
};

}  // namespace plcgw
