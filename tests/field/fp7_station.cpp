#include "tests/field/fp7_station.hpp"

#include "tests/field/fp7_commands.hpp"

namespace plcgw::field {

namespace {
constexpr std::size_t piece_size = 108;  // `%01$RD`, 27 words, check, `&` and CR are 118 characters
constexpr std::string_view wrong_check = "!40", wrong_format = "!41", wrong_procedure = "!43", too_long = "!27";
}  // namespace

fp7_station::fp7_station(unsigned number, fp7_memory& memory)
    : number_{static_cast<char>('0' + number / 10), static_cast<char>('0' + number % 10)}, memory_(memory)
{
}

std::string fp7_station::hear(const heard_frame& frame)
{
    const std::string to = frame.text.size() < 3 ? "" : frame.text.substr(1, 2);
    if (to != number_ && to != "EE" && to != "FF")
        return {};
    more_ = false;
    std::string answer = judge(frame);
    if (answer.empty() || to == "FF")
        return {};
    answer.insert(0, frame.text.substr(0, 3));
    return answer + block_check(answer) + (more_ ? "&\r" : "\r");
}

std::string fp7_station::judge(const heard_frame& frame)
{
    if (frame.too_long)
        return std::string(too_long);
    std::string_view text = frame.text;
    const bool delimiter = text.ends_with('&');
    if (delimiter)
        text.remove_suffix(1);
    if (text.size() < 5 ||
        (!text.ends_with("**") && block_check(text.substr(0, text.size() - 2)) != text.substr(text.size() - 2)))
        return std::string(wrong_check);
    text = text.substr(3, text.size() - 5);
    if (delimiter && text.empty() && !rest_.empty())
        return next_piece();
    if (delimiter)  // nothing waits; or a command in several frames, which it does not take
        return std::string(wrong_procedure);
    if (!text.starts_with('#'))
        return std::string(wrong_format);
    return obey(frame.text.front(), text.substr(1));
}

std::string fp7_station::obey(char header, std::string_view command)
{
    const bool waiting = !rest_.empty();
    rest_.clear();
    if (command == "AB")
        return {};
    if (waiting)
        return std::string(wrong_procedure);
    try {
        std::string answer = "$" + execute(memory_, command);
        constexpr std::size_t name_size = 3;
        if (header == '<')
            return answer.size() + 6 > longest_frame('<') ? std::string(wrong_procedure) : answer;
        if (answer.size() > name_size + piece_size) {
            rest_ = answer.substr(name_size + piece_size);
            answer.resize(name_size + piece_size);
            more_ = true;
        }
        return answer;
    }
    catch (const refusal& why) {
        return "!" + std::string(why.code);
    }
}

std::string fp7_station::next_piece()
{
    const std::string piece = rest_.substr(0, piece_size);
    rest_.erase(0, piece_size);
    more_ = !rest_.empty();
    return piece;
}

}  // namespace plcgw::field
