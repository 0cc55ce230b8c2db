// Drives a line on which one question is under way at a time: asks what the line's routes and others want. What a
// question is on the wire is the protocol's.
#pragma once

#include "bridge/routes/client_line.hpp"
#include "daemon/fp7_line_ports.hpp"
#include "daemon/line_connection.hpp"
#include "daemon/line_driver.hpp"
#include "daemon/line_ear.hpp"

#include <array>
#include <functional>

namespace plcgw {

class polling_line : public line_driver {
public:
    // settle: called after each exchange, to drain what it changed.
    polling_line(asio::io_context& loop, line_config config, client_line& routes, std::function<void()> settle);

    asio::awaitable<void> run() override;
    void wake() override;
    const port_status& port() const override { return connection_->meter().status(); }
    void obey(line_voice& voice) override { ear_.obey(voice); }
    fp7_line_ports* com_ports() override { return &ports_; }
    void reset_channel() override;

protected:
    // Asks it, and tells the routes how it ended unless the port failed: that is said here.
    virtual asio::awaitable<boost::system::error_code> exchange(client_line::question question) = 0;

    // Does what a transaction says until it is done, or nobody wants to know any more: then it has no outcome but
    // errc::timed_out. Fails with the port, and with may_not_speak when another member of the pair is to ask now, or
    // the channel was reset.
    template <class Transaction>
    asio::awaitable<boost::system::error_code> carry_out(Transaction& transaction,
                                                         const client_line::question& question);

    // What every exchange leaves behind.
    template <class Transaction>
    unanswered_requests take_leave(const Transaction& transaction);

    void show_ended(bool failed);  // in the ports of FP7s

    const line_config config_;
    client_line& routes_;
    bool echoes_ = false;  // found out: the adapter returns what it sends
    time_point line_free_from_{};

private:
    asio::awaitable<boost::system::error_code> serve();  // until the port fails
    asio::awaitable<boost::system::error_code> ask(client_line::question question);
    asio::awaitable<boost::system::error_code> listen_until(time_point deadline);
    void note_echo();

    void show_begun();  // an exchange, in the ports of FP7s

    static const modbus::answer_fault& as_fault(const modbus::answer_fault& f) { return f; }
    static modbus::answer_fault as_fault(errc why) { return {why, {}}; }

    // In the middle of it, since another member may ask now.
    template <class Transaction>
    boost::system::error_code left(const Transaction& transaction)
    {
        line_free_from_ = std::max({line_free_from_, transaction.line_free_from(), now() + gap_});
        return may_not_speak;
    }

    // The answer that may still come is not taken for that to the next question.
    template <class Transaction>
    boost::system::error_code left_by_reset(const Transaction& transaction, const client_line::question& question)
    {
        left(transaction);
        line_free_from_ = std::max(line_free_from_, now() + question.timing.response_timeout);
        return may_not_speak;
    }

    static constexpr auto may_not_speak = asio::error::no_permission;

    std::function<void()> settle_;
    std::unique_ptr<line_connection> connection_;
    line_ear ear_;
    std::array<std::uint8_t, 4096> received_{};
    duration gap_;
    bool idle_ = false;     // waiting until something is due
    bool reading_ = false;  // an answer
    fp7_line_ports ports_;
    bool shown_ = false;  // by the ports: an exchange is under way
    unsigned resets_ = 0;
};

template <class Transaction>
asio::awaitable<boost::system::error_code> polling_line::carry_out(Transaction& transaction,
                                                                   const client_line::question& question)
{
    const bool is_answered = question.unit != station_number(modbus::unit_id::broadcast);
    bool waits = false;  // for the answer to what was sent
    const unsigned resets = resets_;
    for (std::size_t told = 0;;) {
        const auto action = transaction.next(now());
        const bool again = told < transaction.faults().size();
        for (std::size_t fault = told; fault < transaction.faults().size(); ++fault)
            if (const errc why = as_fault(transaction.faults()[fault]).why; why != errc::timed_out)
                connection_->meter().fault(why);
        if (waits && !again && !std::holds_alternative<typename Transaction::wait>(action))
            connection_->meter().frames_received();
        waits = waits && !again;
        for (; told < transaction.faults().size(); ++told)
            if (routes_.attempt_failed(question, as_fault(transaction.faults()[told])))
                settle_();  // a PLC's program shows its retries as they happen
        if (std::holds_alternative<typename Transaction::done>(action))
            co_return boost::system::error_code{};
        if (resets != resets_)
            co_return left_by_reset(transaction, question);
        boost::system::error_code ec;
        if (const auto* to_send = std::get_if<typename Transaction::send>(&action)) {
            if (again && !routes_.is_wanted(question))
                co_return boost::system::error_code{};
            if (!ear_.may_speak())
                co_return left(transaction);
            show_begun();
            const time_point started = now();
            ec = co_await connection_->write(to_send->adu);
            transaction.sent(started);
            connection_->meter().frames_sent();
            waits = is_answered;
            ear_.spoke(to_send->adu);
        }
        else {
            const time_point until = std::get<typename Transaction::wait>(action).until;
            reading_ = true;
            const auto size = co_await connection_->read(until, asio::buffer(received_));
            reading_ = false;
            if (size && !ear_.heard(bytes(received_).first(*size)))
                co_return left(transaction);
            if (size)
                transaction.feed(now(), bytes(received_).first(*size));
            else if (size.error() != asio::error::timed_out)
                ec = size.error();
        }
        if (ec)
            co_return ec;
    }
}

template <class Transaction>
unanswered_requests polling_line::take_leave(const Transaction& transaction)
{
    line_free_from_ = transaction.line_free_from();
    if (transaction.echo_seen())
        note_echo();
    for (unsigned i = 0; i < transaction.unanswered(); ++i)
        connection_->missed_answer();
    return {transaction.unanswered(), transaction.unanswered_since()};
}

}  // namespace plcgw
