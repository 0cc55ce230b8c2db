#include "protocols/mewtocol/mewtocol7_conversation.hpp"

#include <utility>

namespace plcgw::mewtocol7 {
namespace {

using mewtocol::damaged_answer;
using mewtocol::not_the_answer;
using verdict = mewtocol::verdict<response>;

std::size_t longest_text(const command& question, const dialect& d)
{
    constexpr std::size_t others = 1024;
    const auto* read = std::get_if<read_words>(&question);
    return others + d.before_words.size() + (read == nullptr ? 0 : 4 * std::size_t{read->count});
}

}  // namespace

conversation::conversation(station_id station, command question, std::uint8_t number, dialect d)
    : station_(station), question_(std::move(question)), dialect_(std::move(d)), number_(number)
{
}

bool conversation::is_expressible() const
{
    return (is_server_number(station_) || station_ == station_id::any) &&
           mewtocol7::is_expressible(question_, dialect_);
}

buffer conversation::begin()
{
    text_.clear();
    split_ = false;
    return send({.station = station_, .text = "#" + encode_command(question_, dialect_)});
}

buffer conversation::send(frame f)
{
    f.number = awaited_ = number_++;
    buffer adu = encode_frame(f);
    sent_.assign(adu.begin(), adu.end() - 1);
    return adu;
}

verdict conversation::hear(const mewtocol::reception& r)
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
    const bool ours = f->station == station_ && f->number == awaited_;
    if (f->checked == check::wrong)
        return ours ? verdict{damaged_answer{errc::bad_checksum}} : not_the_answer{errc::bad_checksum};
    if (!ours)
        return not_the_answer{f->station == station_ ? errc::unexpected_answer : errc{}};
    return hear_text(*f);
}

verdict conversation::hear_text(const frame& f)
{
    const bool marked = f.text.starts_with('$');
    if (f.text.starts_with('!') && !f.more) {
        auto refusal = parse_response(question_, f.text, dialect_);
        if (!refusal)
            return damaged_answer{errc::unexpected_answer};
        const error_code code = std::get<error_code>(*refusal);
        return is_passing(code) ? verdict{mewtocol::not_now<response>{code}} : code;
    }
    // The number is that of our last frame: what does not fit now is no late answer, but a wrong one.
    const std::string_view piece = f.text;
    if (marked == split_ || (split_ && !piece.starts_with(dialect_.before_piece)) ||
        text_.size() + piece.size() > longest_text(question_, dialect_))
        return damaged_answer{errc::unexpected_answer};
    text_.append(split_ ? piece.substr(dialect_.before_piece.size()) : piece);
    if (f.more) {
        split_ = true;
        return mewtocol::ask_on{send({.station = station_, .more = true})};
    }
    split_ = false;
    auto answer = parse_response(question_, std::exchange(text_, {}), dialect_);
    return answer ? verdict{std::move(*answer)} : damaged_answer{errc::unexpected_answer};
}

}  // namespace plcgw::mewtocol7
