// The routes of one line on which the gateway asks: which question goes out next, and what its answer does to memory
// and quality.
#pragma once

#include "bridge/routes/forward_queue.hpp"
#include "bridge/routes/line_polls.hpp"
#include "bridge/routes/route.hpp"
#include "protocols/modbus/serial_transaction.hpp"

#include <map>

namespace plcgw {

struct station {
    std::string name;
    station_number unit;
    modbus::serial_options timing;
    reading reads{};
};

// For the log: a station or a route that changed its state.
struct line_event {
    enum class severity : std::uint8_t { info, warning } level{};
    std::string text;
};

class client_line {
public:
    // timing: of requests to units that are no station of this line.
    client_line(std::string name, std::vector<station> stations, duration longest_silence,
                const modbus::serial_options& timing = {});

    void add_route(route r, std::size_t station, duration period);  // before anything else
    void remember(std::size_t station, station_limits limits) { polls_.remember(station, std::move(limits)); }
    void start(time_point now)
    {
        plan();
        schedule_.start(now);
    }

    // A request beside the routes; its answer comes from take_forwarded(), at once if the port is absent or the station
    // is known to be down. Nothing when too many wait.
    std::optional<forward_ticket> forward(station_number unit, modbus::request request,
                                          std::optional<modbus::serial_options> timing = {});
    std::vector<forward_answer> take_forwarded() { return forwards_.take_answers(); }
    std::vector<forward_fault> take_forward_faults()
    {
        return forwards_.take_faults();
    }  // to be told before the answers

    // The asker has left: its request does not use the line any more, as far as that can be helped.
    void cancel(forward_ticket ticket) { forwards_.cancel(ticket); }

    struct question {
        std::variant<schedule::turn, forward_ticket> origin;
        station_number unit;
        station_question asked;
        modbus::serial_options timing;
        time_point asked_at{};
        line_polls::item item{};  // whose turn it is: its routes are served

        const modbus::request& request() const { return std::get<modbus::request>(asked); }  // of a MODBUS line
    };

    std::optional<question> next(time_point now);
    time_point wake_at(time_point now) const { return forwards_.empty() ? schedule_.wake_at(now) : now; }

    // False when its asker has left: what was sent cannot be called back, but it is not worth a repetition.
    bool is_wanted(const question& q) const
    {
        const auto* const forwarded = std::get_if<forward_ticket>(&q.origin);
        return forwarded == nullptr || forwards_.is_wanted(*forwarded);
    }

    // What came, or did not, to one attempt of a question that is still out. True when somebody waits to hear of it:
    // the PLC's program shows retries as they happen.
    bool attempt_failed(const question& q, const modbus::answer_fault& why);

    // Each question ends in one of these. `wall` is when the answer came, `late` the attempts that were not answered.
    void answered(const question& q, const station_answer& answer, time_point now, wall_time wall,
                  unanswered_requests late = {});
    void failed(const question& q, boost::system::error_code why, time_point now, unanswered_requests late = {});
    void interrupted(const question& q);  // the port went away: the station is not to blame
    // Of a MODBUS question: from the end of the request to the end of its answer, measured.
    void responded(const question& q, duration after);

    // What the stations refused to read in one request, numbered as they were given.
    const station_limits& limits_of(std::size_t station) const { return polls_.limits_of(station); }
    bool take_learned() { return polls_.take_learned(); }  // since the last call

    void port_opened() { port_open_ = true; }
    void port_lost(const std::string& why);  // values stay, qualities change

    // Somebody drained this change of a memory. True when a route is due to write it to its station.
    bool memory_changed(const plc::simulated_plc& plc, const plc::change& changed);

    // Routes whose words or quality changed since the last call, and those not said for the longest silence.
    std::vector<sample> take_samples(time_point now);
    void say_everything();  // the next take_samples() gives all routes: whoever got them is new
    std::vector<line_event> take_events() { return std::exchange(events_, {}); }

    const std::string& name() const { return name_; }
    std::size_t routes_total() const { return routes_.size(); }
    std::size_t routes_up() const;  // of good quality, and those that had nothing to write yet

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
    };

    void plan();
    void served(const question& q, const station_answer& answer, time_point now, wall_time wall);
    void refused(const question& q, const station_refusal& why, time_point now, wall_time wall);
    void set_quality(row& of, quality state, const std::string& reason);
    std::optional<question> next_poll(time_point now);
    std::optional<question> next_forward(time_point now);
    const station* find(station_number unit) const;
    std::uint8_t delimiter_of(station_number unit, std::uint8_t of_a_stranger) const;
    void learn_delimiter(const question& q, const station_answer& answer);
    void doubt_delimiter(station_number unit);
    void lose(row& of, const std::string& why);
    void age(row& of, time_point now);
    void station_down(std::size_t index, const std::string& reason);
    void note(line_event::severity level, std::string text) { events_.push_back({level, std::move(text)}); }
    std::string label(const station& of) const;

    std::string name_;
    std::vector<station> stations_;
    std::vector<row> routes_;
    line_polls polls_;  // numbered like the schedule's items
    schedule schedule_;
    bool planned_ = false;
    forward_queue forwards_;
    bool forwarded_last_ = false;
    bool port_open_ = false;
    modbus::serial_options timing_;
    // ASCII: stations that were told to end their frames with another character. They forget it when their power fails,
    // so that one that does not answer is asked in both ways by turns.
    struct told_delimiter {
        std::uint8_t character;
        bool in_force = true;
    };
    std::map<station_number, told_delimiter> delimiters_;
    duration longest_silence_;
    std::vector<line_event> events_;
};

}  // namespace plcgw
