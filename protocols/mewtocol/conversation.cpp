#include "protocols/mewtocol/conversation.hpp"

namespace plcgw::mewtocol {
namespace {

// No answer is longer than the words asked for. Of the others MG has the longest.
std::size_t longest_text(const command& question)
{
    constexpr std::size_t others = 1024;
    const auto* read = std::get_if<read_words>(&question);
    return read == nullptr ? others : 3 + 4 * std::size_t{read->count};
}

}  // namespace

conversation::conversation(header head, station_id station, command question)
    : head_(head), station_(station), question_(std::move(question))
{
}

bool conversation::is_expressible() const
{
    // Whoever asks all stations gets no answer: only what is done without one makes sense.
    const bool to_all =
        station_ == station_id::global && (is_write(question_) || std::holds_alternative<abort_transfer>(question_));
    const bool to_somebody = is_server_number(station_) || station_ == station_id::any || to_all;
    return to_somebody && mewtocol::is_expressible(question_) &&
           encode_command(question_).size() + 1 + frame_overhead <= max_frame_size(head_);
}

bool conversation::is_repeatable() const
{
    return !std::holds_alternative<register_contacts>(question_) && !std::holds_alternative<register_data>(question_);
}

buffer conversation::begin()
{
    text_.clear();
    split_ = false;
    refused_ = false;
    return send({.head = head_, .station = station_, .text = "#" + encode_command(question_)});
}

std::optional<buffer> conversation::abort() const
{
    if (!split_ && !refused_)
        return std::nullopt;
    return encode_frame({.head = head_, .station = station_, .text = "#AB"});
}

buffer conversation::send(frame f)
{
    buffer adu = encode_frame(f);
    sent_.assign(adu.begin(), adu.end() - 1);
    return adu;
}

verdict<response> conversation::hear(const reception& r)
{
    if (r.why == errc::incomplete || r.why == errc::overlong)
        return damaged_answer{r.why};
    if (!is_frame(r))
        return not_the_answer{r.why};
    if (r.characters == sent_) {
        echo_seen_ = true;
        return not_the_answer{};
    }
    const auto f = parse_frame(r.characters);
    if (!f)
        return not_the_answer{errc::bad_header};
    const bool ours = f->head == head_ && f->station == station_;
    if (f->checked == check::wrong)
        return ours ? verdict<response>{damaged_answer{errc::bad_checksum}} : not_the_answer{errc::bad_checksum};
    if (!ours)
        return not_the_answer{};
    return hear_text(*f);
}

verdict<response> conversation::hear_text(const frame& f)
{
    if (f.text.starts_with('!') && !f.more) {
        auto refusal = parse_response(question_, f.text);
        if (!refusal)
            return not_the_answer{errc::unexpected_answer};
        const error_code code = std::get<error_code>(*refusal);
        refused_ = code == error_code::procedure;  // an unfinished answer is in the way
        return is_passing(code) ? verdict<response>{not_now<response>{code}} : code;
    }
    const bool named = f.text.starts_with('$') && f.text.substr(1, 2) == to_string(code_of(question_));
    if (!split_ && !named)
        return not_the_answer{errc::unexpected_answer};
    if (split_ && (named || f.text.empty() || text_.size() + f.text.size() > longest_text(question_)))
        return damaged_answer{errc::unexpected_answer};
    text_.append(f.text);
    if (f.more) {
        split_ = true;
        return ask_on{send({.head = head_, .station = station_, .more = true})};
    }
    auto answer = parse_response(question_, text_);
    text_.clear();
    const bool was_split = std::exchange(split_, false);
    if (answer)
        return std::move(*answer);
    // In one frame it may be the late answer to another question, with ours behind it.
    return was_split ? verdict<response>{damaged_answer{errc::unexpected_answer}}
                     : not_the_answer{errc::unexpected_answer};
}

}  // namespace plcgw::mewtocol
