#include "protocols/mewtocol/mewtocol7_server.hpp"

namespace plcgw::mewtocol7 {
namespace {

using action = server::action;

}  // namespace

action server::hear(time_point now, const mewtocol::reception& r)
{
    if (now - touched_ >= options_.rest_kept) {
        rest_.clear();
        piece_.clear();
    }
    if (r.why == errc::overlong) {
        const auto begin = parse_frame(r.characters.substr(0, 7) + "0000");
        return begin ? refuse(*begin, error_code::frame_too_long) : action{};
    }
    if (!is_frame(r))
        return {};
    const auto f = parse_frame(r.characters);
    if (!f || !answers(f->station))
        return {};
    if (f->checked == check::wrong)
        return refuse(*f, error_code::check);
    if (f->text.empty() && f->more)
        return hear_continuation(now, *f);
    if (f->text.starts_with('!'))
        return {};  // nobody's command; answered, it would go to and fro on a line that returns what is sent
    if (!f->text.starts_with('#'))
        return refuse(*f, error_code::format);
    rest_.clear();  // there is no AB here: a new command says that the rest is not wanted
    piece_.clear();
    if (f->more)
        return refuse(*f, error_code::procedure);  // how a command in several frames goes on is not published
    auto asked = parse_command(std::string_view(f->text).substr(1), options_.dialect);
    if (!asked)
        return refuse(*f, asked.error());
    asked_ = {.station = f->station, .number = f->number};
    question_ = *asked;
    return std::move(*asked);
}

bool server::answers(station_id to) const
{
    return to == station_id::any ? options_.answers_any : to != station_id::none && to == options_.own;
}

action server::refuse(const frame& to, error_code why) const
{
    if (!answers(to.station))
        return {};
    return encode_frame(
        {.station = to.station, .number = to.number, .text = encode_response(command{}, why, options_.dialect)});
}

// Frame numbers are consecutive, so a lost piece can be asked for again.
action server::hear_continuation(time_point now, const frame& f)
{
    if (piece_.empty() || f.station != asked_.station)
        return refuse(f, error_code::procedure);
    if (f.number == asked_.number)
        return piece_;
    if (f.number != static_cast<std::uint8_t>(asked_.number + 1) || rest_.empty())
        return refuse(f, error_code::procedure);
    asked_.number = f.number;
    return send_piece(now, options_.dialect.before_piece);
}

std::optional<buffer> server::answer(time_point now, const response& r)
{
    std::string text = encode_response(question_, r, options_.dialect);
    if (text.empty())
        return std::nullopt;
    if (text.size() + frame_overhead <= max_frame_size)
        return encode_frame({.station = asked_.station, .number = asked_.number, .text = std::move(text)});
    const std::size_t head = 7 + options_.dialect.before_words.size();  // mark and name
    rest_ = text.substr(head);
    text.resize(head);
    return send_piece(now, std::move(text));
}

// What fits behind the text given: whole words, and room for `&`.
buffer server::send_piece(time_point now, std::string text)
{
    const std::size_t room = (max_frame_size - frame_overhead - 1 - text.size()) / 4 * 4;
    text.append(rest_, 0, room);
    rest_.erase(0, room);
    touched_ = now;
    piece_ = encode_frame(
        {.station = asked_.station, .number = asked_.number, .text = std::move(text), .more = !rest_.empty()});
    return piece_;
}

}  // namespace plcgw::mewtocol7
