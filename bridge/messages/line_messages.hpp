// The messages of one general-purpose line: what is sent next, and what a received message does to memory and quality.
#pragma once

#include "bridge/dds/log_limiter.hpp"
#include "bridge/messages/line_rows.hpp"
#include "bridge/messages/send_schedule.hpp"
#include "bridge/messages/standing.hpp"
#include "bridge/routes/client_line.hpp"
#include "bridge/serial_message.hpp"

#include <deque>

namespace plcgw::messages {

struct line_options {
    std::string name;
    general_purpose::message_form form;
    general_purpose::exchange_options timing;  // each sending has its own response timeout
    duration longest_silence{1'000'000};       // confirmed values are said again after it
};

// Words of the status area, each an unsigned 16-bit number that wraps.
enum class status_word : std::uint8_t {
    error_code,   // PMGET monitor information, D+2: bits of general_purpose::receive_error
    error_count,  // PMGET monitor information, D+3
    waiting,      // messages in the fullest of the receive buffers, 0 to 8
    received,     // messages, refused ones too
    refused,      // by all patterns
    lost,         // not stored: all eight buffers full, or more bytes than the words hold
    sent,
    unanswered,  // sendings that got no answer, or could not be sent
};
inline constexpr std::size_t status_words = 8;

// What happened of that which the port of an FP7 shows, beside the status: 4.1 and 10.3.2.
struct port_news {
    bool reset = false;           // of the channel, and what follows came behind it
    bool copied = false;          // a message went into devices, as GPRECV does it
    bool bad_send_count = false;  // nothing to send, or too much
};

class line_messages {
public:
    explicit line_messages(line_options options);

    void add(raw_row row);
    void add(message_row row);  // its pattern and fields fit
    void add(send_row row);     // before the messages that are answers to it
    void show_status_in(plc_block where);
    void reset_by(plc_bit bit);  // its rise resets the channel (4.1, Y10)
    void reset_channel();        // empties the buffers, clears the errors
    void start(time_point now) { schedule_.start(now); }

    const general_purpose::message_form& form() const { return options_.form; }
    general_purpose::message_framer& framer() { return in_; }

    struct question {
        std::size_t send{};
        buffer content;
        buffer message;  // with the codes of the line
        general_purpose::expect answer{};
        general_purpose::exchange_options timing;
    };

    // What to send now. Also the time for what readers made room for, and for a channel reset.
    std::optional<question> next(time_point now, wall_time wall);
    time_point wake_at() const;

    // Each question is told sent once it was, and ends in one of the others. attempts: that may be answered late.
    void sent(const question& q, wall_time wall);
    void answered(const question& q, const buffer& answer, time_point now, wall_time wall);
    void failed(const question& q, boost::system::error_code why, time_point now, unsigned attempts);
    void interrupted(const question& q, time_point now)
    {
        schedule_.finished(q.send);
        ordered_ended(q.send, now, "was lost while the message was sent");
    }

    // The channel was reset while it was asked. An answer that may still come gets its time.
    void given_up(const question& q, time_point now, unsigned attempts);

    // A message, without start and end codes, that somebody wants sent beside all this: a number, and the outcome of
    // each number as soon as it is known. Nothing when too many wait.
    std::optional<std::uint64_t> order(buffer content, time_point now);
    bool can_send(bytes content) const;          // it is something, and fits with its codes
    bool has_begun(std::uint64_t number) const;  // it is being sent, or its outcome is known
    void withdraw(std::uint64_t number);         // if it has not begun
    std::vector<client_line::through_outcome> take_ordered() { return std::exchange(order_outcomes_, {}); }

    void received(result<buffer> what, time_point now, wall_time wall);  // what the framer gave, unasked

    void port_opened();
    void port_lost();  // values stay, qualities change

    // Somebody drained this change of a memory. True when next() has something to do.
    bool memory_changed(const plc::simulated_plc& plc, const plc::change& changed, time_point now);

    std::vector<sample> take_samples(time_point now);
    void say_everything();
    std::vector<serial_message> take_messages() { return std::exchange(messages_, {}); }
    std::vector<line_event> take_events() { return std::exchange(events_, {}); }
    port_news take_port_news() { return std::exchange(news_, {}); }

    const std::string& name() const { return options_.name; }
    std::size_t routes_total() const { return raws_.size() + routes_.size(); }
    std::size_t routes_up() const;          // of good quality, and those that may wait for ever and have nothing yet
    std::vector<plc_block> filled() const;  // devices that messages fill, by the names of their samples
    void worsen(sample& of, const plc::simulated_plc& plc, plc::place at, std::size_t bits) const;

    std::uint16_t status(status_word which) const;

private:
    struct raw {
        raw_row row;
        general_purpose::receive_buffers buffers;
        standing stands;
        bool said_full = false;
    };
    struct route {
        message_row row;
        message_reader reader;
        std::optional<std::size_t> brought_by;  // the sending whose answer came last
        standing stands;
    };
    struct sending {
        send_row row;
        bool failing = false;  // and said so
    };

    struct ordered {
        std::uint64_t number{};
        buffer content;
    };

    bool begin_ordered(std::size_t send);
    void ordered_ended(std::size_t send, time_point now, const std::string& failed);
    void lose_ordered();
    void tell(std::uint64_t number, const std::string& failed);
    void take(const buffer& message, std::optional<std::size_t> answer_to, time_point now, wall_time wall);
    bool read(route& by, const buffer& message, std::optional<std::size_t> answer_to, time_point now, wall_time wall);
    void refuse(const buffer& message, const std::string& reason, time_point now);
    void fill(raw& of, time_point now, wall_time wall);
    void look_at_buffers(raw& of);
    result<outgoing> content_of(const send_row& row) const;
    void not_answered(std::size_t send, const std::string& why);
    void show_status();
    void note(line_event::severity level, std::string_view code, std::string subject, std::string text)
    {
        events_.push_back({level, code, std::move(subject), std::move(text)});
    }
    std::string label(const char* what, const std::string& name) const;

    line_options options_;
    general_purpose::message_framer in_;
    general_purpose::receive_buffers port_;  // of errors only
    std::vector<raw> raws_;
    std::vector<route> routes_;
    std::vector<sending> sends_;  // numbered like the schedule's sources
    send_schedule schedule_;
    std::optional<std::size_t> orders_;  // the sending of what is ordered, once something was
    std::deque<ordered> ordered_;        // that wait
    std::optional<std::uint64_t> order_out_;
    std::uint64_t last_order_ = 0;
    std::vector<client_line::through_outcome> order_outcomes_;
    std::vector<serial_message> messages_;
    std::vector<line_event> events_;
    port_news news_;
    log_limiter refusals_{1, std::chrono::seconds(10)};
    log_limiter damages_{1, std::chrono::seconds(10)};
    plc_block status_;
    plc_bit reset_;
    bool reset_level_ = false;
    bool reset_due_ = false;
    bool open_ = false;
    bool work_due_ = false;     // next() has to look at the memory
    bool absent_ = false;       // and said so
    time_point quiet_until_{};  // late answers may come
    std::uint64_t received_ = 0;
    std::uint64_t refused_ = 0;
    std::uint64_t too_long_ = 0;
    std::uint64_t sent_ = 0;
    std::uint64_t unanswered_ = 0;
};

}  // namespace plcgw::messages
