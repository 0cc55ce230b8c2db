#include "protocols/mewtocol/block_transaction.hpp"

#include <algorithm>

namespace plcgw::mewtocol {
namespace {

constexpr duration slack = std::chrono::milliseconds(100);  // time on the wire and jitter of a late answer

}  // namespace

template <class Client>
block_transaction<Client>::block_transaction(Client client, std::vector<block> blocks, const line_options& timing,
                                             time_point line_free_from, time_point now)
    : client_(std::move(client)), blocks_(std::move(blocks)), timing_(timing), line_free_from_(line_free_from)
{
    for (const block& each : blocks_) {
        auto steps = client_.plan(each);
        if (!steps)
            return;
        steps_.push_back(std::move(*steps));
    }
    if (!steps_.empty())
        begin(now);
}

template <class Client>
void block_transaction<Client>::begin(time_point now)
{
    noted_ = 0;
    now_asking_.emplace(client_.begin(steps_[block_][step_]), timing_, line_free_from_, now);
}

template <class Client>
typename block_transaction<Client>::action block_transaction<Client>::next(time_point now)
{
    while (now_asking_) {
        auto what = now_asking_->next(now);
        note_faults();
        if (!std::holds_alternative<done>(what))
            return what;
        if (!finish(now))
            now_asking_.reset();
        else
            begin(now);
    }
    return done{};
}

template <class Client>
void block_transaction<Client>::note_faults()
{
    const std::vector<errc>& all = now_asking_->faults();
    faults_.insert(faults_.end(), all.begin() + static_cast<std::ptrdiff_t>(noted_), all.end());
    noted_ = all.size();
}

template <class Client>
bool block_transaction<Client>::finish(time_point now)
{
    const single& asked = *now_asking_;
    client_.ended(asked.conversation());
    echo_seen_ = echo_seen_ || asked.echo_seen();
    if (asked.unanswered() != 0 && unanswered_ == 0)
        unanswered_since_ = asked.unanswered_since();
    unanswered_ += asked.unanswered();
    line_free_from_ = asked.line_free_from();
    if (!asked.outcome()) {
        outcome_ = asked.outcome().error();
        return false;
    }
    response_time_ = std::max(response_time_, asked.response_time());
    response answer = Client::as_response(*asked.outcome());
    const bool refused = std::holds_alternative<error_code>(answer);
    parts_.push_back(std::move(answer));
    if (refused || ++step_ == steps_[block_].size()) {
        answers_.push_back(refused ? parts_.back() : join(blocks_[block_], parts_));
        parts_.clear();
        step_ = 0;
        ++block_;
    }
    if (refused || block_ == blocks_.size()) {
        outcome_ = std::move(answers_);
        return false;
    }
    // The answers to the attempts in vain may still come. They must not meet another command of the same form.
    if (!Client::tells_late_answers && asked.unanswered() != 0)
        line_free_from_ = now + asked.unanswered() * (now - asked.unanswered_since()) + slack;
    return true;
}

template class block_transaction<com_client>;
template class block_transaction<com7_client>;

}  // namespace plcgw::mewtocol
