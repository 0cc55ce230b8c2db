// The routes of one line on which the gateway asks: which question goes out next, and what its answer does to memory
// and quality.
#pragma once

#include "bridge/line_event.hpp"
#include "bridge/routes/forward_queue.hpp"
#include "bridge/routes/line_polls.hpp"
#include "bridge/routes/response_times.hpp"
#include "bridge/routes/route.hpp"
#include "bridge/routes/station_statistics.hpp"
#include "bridge/scan/station_scan.hpp"
#include "protocols/modbus/serial_transaction.hpp"

#include <algorithm>
#include <map>

namespace plcgw {

struct route_record;

struct station {
    std::string name;
    station_number unit;
    modbus::serial_options timing;
    read_settings reads{};
    std::optional<duration> shortest_timeout{};  // the response timeout is learned: at least this, at most timing's
};

// What belongs to the line as a whole.
struct line_options {
    duration longest_silence{};       // of a sample: then it is said again
    modbus::serial_options timing{};  // of requests to units that are no station of this line
    duration cache_age{};             // forwarded reads are answered with values that are not older; 0: never
    unsigned parallel = 1;            // questions under way at a time
    bool numbered_answers = false;    // as those of MODBUS TCP
};

class client_line {
public:
    client_line(std::string name, std::vector<station> stations, const line_options& options);

    // Before anything else. The row's number. A route that reads and writes has the next one, too, for its writing
    // half.
    std::size_t add_route(route r, std::size_t station, duration period);
    void remember(std::size_t station, station_limits limits) { polls_.remember(station, std::move(limits)); }
    void start(time_point now)
    {
        plan();
        schedule_.start(now);
    }

    // A request beside the routes; its answer comes from take_forwarded(), at once if the port is absent. Nothing when
    // too many wait, of this asker or of all.
    std::optional<forward_ticket> forward(station_number unit, modbus::request request,
                                          std::optional<modbus::serial_options> timing = {},
                                          forward_asker asker = forward_asker::nobody);
    // Answers those that need no line: the station is down, or its values are known.
    void look_at_forwarded(time_point now);
    std::vector<forward_answer> take_forwarded() { return forwards_.take_answers(); }
    std::vector<forward_fault> take_forward_faults()
    {
        return forwards_.take_faults();
    }  // to be told before the answers

    bool is_asked(forward_ticket ticket) const { return forwards_.is_wanted(ticket); }  // its question is out

    // The asker has left: its request does not use the line any more, as far as that can be helped.
    void cancel(forward_ticket ticket)
    {
        forwards_.cancel(ticket);
        forwards_came_ = forwards_came_ && !forwards_.empty();
    }

    // A search for stations beside all this: client_line_scan.cpp. Units of the line's own stations are left out. It
    // ends when nobody has looked at it for a while; what it found stays until the next one.
    void begin_scan(scan_language language, std::vector<station_number> units, std::optional<duration> timeout,
                    time_point now);
    const station_scan* look_at_scan(time_point now);  // null: there was none
    void end_scan() { scan_goes_ = false; }
    bool is_scanning() const { return scan_goes_; }
    duration scan_timeout() const;  // if none is given: from what the line has taught
    bool is_port_open() const { return port_open_; }

    enum class scan_ticket : std::uint64_t {};  // which scan asks

    struct question {
        std::variant<schedule::turn, forward_ticket, scan_ticket> origin;
        station_number unit;
        station_question asked;
        modbus::serial_options timing;
        time_point asked_at{};
        line_polls::item item{};  // whose turn it is: its routes are served

        const modbus::request& request() const { return std::get<modbus::request>(asked); }  // of a MODBUS line
    };

    std::optional<question> next(time_point now);
    time_point wake_at(time_point now) const
    {
        return forwards_came_ ? now : std::min(schedule_.wake_at(now), std::max(now, forwards_wake_));
    }

    // False when its asker has left: what was sent cannot be called back, but it is not worth a repetition.
    bool is_wanted(const question& q) const
    {
        const auto* const forwarded = std::get_if<forward_ticket>(&q.origin);
        return forwarded == nullptr || forwards_.is_wanted(*forwarded);
    }

    // What came, or did not, to one attempt of a question that is still out. True when somebody waits to hear of it:
    // the PLC's program shows retries as they happen.
    bool attempt_failed(const question& q, const modbus::answer_fault& why);

    // Each question ends in one of these. `wall` is when the answer came, `late` the attempts that were not answered,
    // `response_time` that of the first attempt.
    void answered(const question& q, const station_answer& answer, time_point now, wall_time wall,
                  unanswered_requests late = {}, std::optional<duration> response_time = {});
    void failed(const question& q, boost::system::error_code why, time_point now, unanswered_requests late = {});
    void interrupted(const question& q);  // the port went away: the station is not to blame
    // From the end of a request to the end of its answer, measured on a serial line.
    void responded(const question& q, duration after);

    // On a line of a pair. While somebody else speaks, nothing waits for the line: forwarded requests and clients that
    // wait for a write fail at once. Whoever begins to speak spreads its polls as at the start.
    void fall_silent();
    void begin_to_speak(time_point now);
    // What somebody else asked, and what the station said; nothing: nobody answered.
    void overheard(station_number unit, const station_question& asked, const std::optional<station_answer>& answer,
                   time_point now, wall_time wall);

    // What the stations refused to read in one request, numbered as they were given.
    const station_limits& limits_of(std::size_t station) const { return polls_.limits_of(station); }
    bool take_learned() { return polls_.take_learned(); }  // since the last call

    void port_opened()
    {
        port_open_ = true;
        statistics_.port_opened();
    }
    void port_lost(const std::string& why);  // values stay, qualities change

    // Somebody drained this change of a memory. True when a route is due to write it to its station.
    bool memory_changed(const plc::simulated_plc& plc, const plc::change& changed);

    // A client has just written into this PLC: a number for each write-through route that this touched, and the outcome
    // of each number as soon as it is known. Nothing: done; else memory is again as the station has it.
    std::vector<std::uint64_t> write_through(const plc::simulated_plc& plc);
    struct through_outcome {
        std::uint64_t number{};
        std::optional<modbus::exception_code> failed;
        std::uint16_t device_code = 0;  // what the station refused with, in its own protocol; 0: it did not answer
        std::string reason{};           // who did not do it, and why
        bool goes_on = false;           // the route will write it again without being asked
    };
    std::vector<through_outcome> take_through() { return std::exchange(through_outcomes_, {}); }

    // The same for whoever wants to hear of every route that writes these devices, which he has just written: each asks
    // its station, although nothing may have changed. What a write-through route could not write is taken back.
    std::vector<std::uint64_t> order(const plc::simulated_plc& plc, const plc::change& written);
    bool has_begun(std::uint64_t number) const;  // its question is out, or its outcome is known
    // Nobody waits for these any more, and memory is as it was before: what is not out yet is not written.
    void withdraw(const std::vector<std::uint64_t>& numbers);

    // Somebody wrote devices that are watched, though nothing may have changed: periodic writes begin. As above.
    bool memory_written();

    // Routes whose words or quality changed since the last call, and those not said for the longest silence.
    std::vector<sample> take_samples(time_point now);
    void say_everything();  // the next take_samples() gives all routes: whoever got them is new
    std::vector<line_event> take_events() { return std::exchange(events_, {}); }

    const std::string& name() const { return name_; }
    const std::vector<station>& stations() const { return stations_; }  // behind those of the routes any that was asked
    std::size_t routes_total() const { return routes_.size() - halves_; }
    std::size_t routes_up() const;  // of good quality, and those that had nothing to write yet

    // By row, as add_route() numbered them.
    std::size_t rows() const { return routes_.size(); }
    const route& route_at(std::size_t number) const { return routes_[number].content; }
    std::size_t station_at(std::size_t number) const { return routes_[number].station; }
    bool is_half(std::size_t number) const { return routes_[number].half; }  // the writing half of a route
    bool is_up(std::size_t number) const;
    health health_of(std::size_t station) const { return schedule_.state_of(station); }

    // Of the stations of the configuration, numbered as they were given; all but `since`.
    std::size_t stations_total() const { return statistics_.size(); }
    device_status device_of(std::size_t station) const;
    link_state device_state(std::size_t station) const { return statistics_.state_of(station); }
    bool take_device_changes() { return statistics_.take_changed(); }  // of a state, since the last call
    // Of a standby whose stations cannot be heard: what the active member says of a row. And before it asks: what it
    // would write again is forgotten.
    void adopt(std::size_t number, const route_record& record, time_point now, wall_time wall);
    void forget_written();

    // The worst quality and the oldest source among the read routes that fill these devices; good when there are none.
    void worsen(sample& of, const plc::simulated_plc& plc, plc::place at, std::size_t bits) const;

private:
    struct row {
        route content;
        std::size_t station{};
        duration period{};
        time_point good_at{};   // last good answer
        bool answered = false;  // since the last sample
        bool changed = true;    // since the last sample: the first one says "never read"
        time_point said_at{};

        // Of a route that reads and writes: its other half, and whether this is the one that writes.
        std::optional<std::size_t> partner{};
        bool half = false;
        std::vector<std::uint16_t> agreed{};  // of the reading half: what memory and station both had last
        time_point written_at{};              // of the reading half: an answer to an older question is old

        std::optional<plc::memory::watch> first_write{};  // of a periodic write that did not begin yet
        time_point next_write{};

        // Of a write-through route, whose `agreed` is what the station has.
        std::optional<plc::memory::watch> through{};

        std::vector<std::uint16_t> heard_written{};  // what somebody else wrote to the station, since we did

        // Those who wait for a write, by number.
        std::vector<std::uint64_t> waiting{};                    // for the next question
        std::vector<std::uint64_t> on_its_way;                   // for the answer to the last one
        std::optional<std::vector<std::uint16_t>> taken_back{};  // what memory and station had before: no news to it
    };
    struct write_failure {
        modbus::exception_code shown{};
        std::uint16_t device_code = 0;
        std::string reason;
        bool goes_on = false;
    };

    void set_quality(row& of, quality state, const std::string& reason, std::uint16_t code = 0);
    // The only places that know which item of the schedule a row is.
    std::size_t write_item(const row& of) const { return polls_.item_of_write(index_of(of)); }
    void ask_write(const row& of, time_point not_before = {}) { schedule_.ask(write_item(of), not_before); }
    void read_soon(const row& of, time_point now);
    bool is_write_due(const row& of) const { return schedule_.is_wanted(write_item(of)); }
    std::size_t index_of(const row& of) const { return static_cast<std::size_t>(&of - routes_.data()); }

    row& reading_row(row& of) { return of.half ? routes_[*of.partner] : of; }
    bool is_to_be_written(const row& of) const;
    bool is_outdated(const row& of, const question& q) const;
    void was_stored(row& of, const question& q, time_point now);
    void was_refused(row& of, const question& q, time_point now, bool may_pass);
    void plan_next_write(row& of, const question& q, time_point now, bool is_due);
    question question_of_turn(const schedule::turn& turn, time_point now) const;
    void plan();
    void served(const question& q, const station_answer& answer, time_point now, wall_time wall);
    void bring(row& of, const question& q, const station_answer& answer, time_point now, wall_time wall);
    void refused(const question& q, const station_refusal& why, time_point now, wall_time wall);
    bool is_idle(const schedule::turn& turn) const;
    void offer_scan(time_point now);
    std::optional<question> next_scan(time_point now);
    station_scan* scan_of(const question& q, time_point now);
    std::optional<question> next_forward(time_point now);
    forward_queue::verdict verdict_of(const forward_request& r, time_point now);
    std::size_t station_of(station_number unit);  // one that has no route is made known
    modbus::serial_options timing_of(std::size_t station) const;
    void note_health(std::size_t station, health before, const std::string& reason, std::uint16_t code = 0);
    void note_load(time_point now);
    static station_question write_or_probe(const row& of, bool is_wanted);
    std::uint64_t wait_for(row& of);
    void through_ended(row& of, const std::optional<write_failure>& failed);
    void through_refused(row& of, const question& q, const station_refusal& why);
    void through_unanswered(row& of, const std::string& reason);
    void through_lost(row& of);
    bool is_as_station_has(const row& of);
    bool goes_on(const row& of) const { return !of.through; }
    std::uint8_t delimiter_of(station_number unit, std::uint8_t of_a_stranger) const;
    void heard_silence(std::size_t station, const station_question& asked, time_point now);
    void heard_refusal(std::size_t station, const station_question& asked, const station_refusal& why);
    void heard_read(std::size_t station, const question& q, const station_answer& answer, time_point now,
                    wall_time wall);
    void heard_write(row& of, std::vector<std::uint16_t> words, time_point now, wall_time wall);
    bool was_heard_written(row& of);
    void learn_delimiter(const question& q, const station_answer& answer);
    void doubt_delimiter(station_number unit);
    void lose(row& of, const std::string& why, std::uint16_t code);
    void age(row& of, time_point now);
    void note(line_event::severity level, std::string_view code, std::string subject, std::string text)
    {
        events_.push_back({level, code, std::move(subject), std::move(text)});
    }
    std::string subject_of(const station& of) const;
    std::string label(const station& of) const;

    std::string name_;
    line_options options_;
    std::vector<station> stations_;  // numbered like the schedule's; behind those of the routes any that was asked
    std::vector<response_times> times_;
    station_statistics statistics_;
    std::vector<row> routes_;
    line_polls polls_;  // numbered like the schedule's items
    schedule schedule_;
    bool planned_ = false;
    forward_queue forwards_;
    bool forwards_came_ = false;  // since they were looked at
    time_point forwards_wake_ = time_point::max();
    std::size_t halves_ = 0;
    std::map<std::size_t, unsigned> unanswered_;  // questions of somebody else in a row, of stations
    std::uint64_t last_through_ = 0;
    std::vector<through_outcome> through_outcomes_;
    bool port_open_ = false;
    bool overloaded_ = false;
    time_point load_looked_at_{};
    std::optional<station_scan> scan_;
    scan_ticket scan_number_{};
    bool scan_goes_ = false;
    time_point scan_looked_at_{};
    modbus::serial_options scan_timing_{};
    // ASCII: stations that were told to end their frames with another character. They forget it when their power fails,
    // so that one that does not answer is asked in both ways by turns.
    struct told_delimiter {
        std::uint8_t character;
        bool in_force = true;
    };
    std::map<station_number, told_delimiter> delimiters_;
    std::vector<line_event> events_;
};

}  // namespace plcgw
