#include "protocols/mewtocol/server.hpp"

namespace plcgw::mewtocol {
namespace {

// Data characters in one frame of several: with `%01$RD`, BCC, `&` and CR the longest frame, and 27 whole words.
constexpr std::size_t piece_size = 108;

// A command in several frames may hold no more: twice the largest area of any FP.
constexpr std::size_t longest_command = 4 * 131'072;

}  // namespace

server::action server::hear(time_point now, const reception& r)
{
    if (now - touched_ >= options_.rest_kept)
        forget();
    if (r.why == errc::overlong) {
        // Its beginning is kept; whatever follows the station makes it a frame for the parser.
        const auto begin = parse_frame(r.characters.substr(0, 3) + "00");
        return begin ? refuse(*begin, error_code::frame_too_long) : action{};
    }
    if (!is_frame(r))
        return {};
    const auto f = parse_frame(r.characters);
    if (!f || (f->head == header::expansion && !options_.expansion))
        return {};
    if (!answers(f->station) && f->station != station_id::global)
        return {};
    if (f->checked == check::wrong) {
        begun_.clear();
        return refuse(*f, error_code::check);
    }
    return f->text.starts_with('#') ? hear_command(now, *f) : hear_piece(now, *f);
}

bool server::answers(station_id to) const
{
    return to == station_id::any ? options_.answers_any : to != station_id::none && to == options_.own;
}

server::action server::refuse(const frame& to, error_code why) const
{
    if (!answers(to.station))
        return {};
    if (to.head == header::expansion && !options_.expansion)
        return {};
    return encode_frame({.head = to.head, .station = to.station, .text = encode_response(command{}, why)});
}

server::action server::hear_command(time_point now, const frame& f)
{
    const std::string_view text = std::string_view(f.text).substr(1);
    begun_.clear();  // whoever says the beginning again was not understood
    if (!rest_.empty()) {
        rest_.clear();
        if (text != "AB" && f.station != station_id::global)
            return refuse(f, error_code::procedure);
    }
    if (!f.more)
        return parse(f, text);
    if (f.head != header::normal || !options_.several_frames)
        return refuse(f, error_code::procedure);
    if (f.station == station_id::global)
        return {};  // nobody would say "go on"
    begun_ = text;
    asked_ = f;
    touched_ = now;
    return encode_frame({.head = f.head, .station = f.station, .more = true});
}

// A frame without `#`: a request for the next frame, or one more of a command. Error responses are nobody's command:
// answered, they would go to and fro on a line that returns what is sent.
server::action server::hear_piece(time_point now, const frame& f)
{
    if (f.text.starts_with('!'))
        return {};
    const bool same = f.head == asked_.head && f.station == asked_.station;
    if (f.more && f.text.empty()) {
        if (!begun_.empty())
            return {};
        return rest_.empty() || !same ? refuse(f, error_code::procedure) : action{next_piece(now)};
    }
    if (begun_.empty() || !same)
        return refuse(f, error_code::format);
    if (begun_.size() + f.text.size() > longest_command) {
        begun_.clear();
        return refuse(f, error_code::frame_too_long);
    }
    begun_.append(f.text);
    touched_ = now;
    if (f.more)
        return encode_frame({.head = f.head, .station = f.station, .more = true});
    const std::string whole = std::move(begun_);
    begun_.clear();
    return parse(f, whole);
}

server::action server::parse(const frame& f, std::string_view text)
{
    auto asked = parse_command(text, options_.offered);
    if (!asked)
        return refuse(f, asked.error());
    if (std::holds_alternative<abort_transfer>(*asked))
        return {};
    asked_ = {.head = f.head, .station = f.station};
    question_ = *asked;
    return std::move(*asked);
}

std::optional<buffer> server::answer(time_point now, const response& r)
{
    if (!expects_answer(asked_.station, question_) || std::holds_alternative<no_response>(r))
        return std::nullopt;
    frame f{.head = asked_.head, .station = asked_.station, .text = encode_response(question_, r)};
    if (f.text.size() + frame_overhead <= max_frame_size(f.head))
        return encode_frame(f);
    if (f.head != header::normal || !options_.several_frames) {
        f.text = encode_response(question_, error_code::procedure);
        return encode_frame(f);
    }
    constexpr std::size_t name_size = 3;
    rest_ = f.text.substr(name_size + piece_size);
    touched_ = now;
    f.text.resize(name_size + piece_size);
    f.more = true;
    return encode_frame(f);
}

buffer server::next_piece(time_point now)
{
    const frame f{.head = asked_.head,
                  .station = asked_.station,
                  .text = rest_.substr(0, piece_size),
                  .more = rest_.size() > piece_size};
    rest_.erase(0, piece_size);
    touched_ = now;
    return encode_frame(f);
}

void server::forget()
{
    rest_.clear();
    begun_.clear();
}

}  // namespace plcgw::mewtocol
