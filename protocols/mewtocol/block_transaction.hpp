// Blocks asked of one station, one transaction for each of their commands: whoever drives the line does what next()
// says, as with a single transaction.
#pragma once

#include "protocols/mewtocol/client.hpp"
#include "protocols/mewtocol/transaction.hpp"

namespace plcgw::mewtocol {

template <class Client>
class block_transaction {
public:
    using single = transaction<typename Client::conversation_type>;
    using send = typename single::send;
    using wait = typename single::wait;
    using done = typename single::done;
    using action = typename single::action;

    // Nothing is sent unless all of it can be: errc::not_expressible.
    block_transaction(Client client, std::vector<block> blocks, const line_options& timing, time_point line_free_from,
                      time_point now);

    action next(time_point now);
    void sent(time_point now) { now_asking_->sent(now); }
    void feed(time_point now, bytes received)
    {
        if (now_asking_)
            now_asking_->feed(now, received);
    }

    // After done: an answer for each block. An error code is the last one: what follows was not asked.
    const result<std::vector<response>>& outcome() const { return outcome_; }
    unsigned unanswered() const { return unanswered_; }
    time_point unanswered_since() const { return unanswered_since_; }
    const std::vector<errc>& faults() const { return faults_; }  // of each attempt that failed
    duration response_time() const { return response_time_; }    // the longest of the commands that were answered
    bool echo_seen() const { return echo_seen_; }
    time_point line_free_from() const { return line_free_from_; }

private:
    void begin(time_point now);  // the next command
    void note_faults();
    bool finish(time_point now);  // true when another command follows

    Client client_;
    std::vector<block> blocks_;
    std::vector<std::vector<typename Client::step>> steps_;  // of each block
    line_options timing_;
    std::optional<single> now_asking_;
    std::size_t block_ = 0;
    std::size_t step_ = 0;
    std::vector<response> parts_;    // of this block so far
    std::vector<response> answers_;  // of the blocks before it
    time_point line_free_from_;
    std::size_t noted_ = 0;  // faults of this command
    std::vector<errc> faults_;
    unsigned unanswered_ = 0;
    time_point unanswered_since_{};
    duration response_time_{};
    bool echo_seen_ = false;
    result<std::vector<response>> outcome_ = make_error_code(errc::not_expressible);
};

extern template class block_transaction<com_client>;
extern template class block_transaction<com7_client>;

}  // namespace plcgw::mewtocol
