#include "protocols/mewtocol/mewtocol7_fields.hpp"

namespace plcgw::mewtocol7 {
namespace {

using mewtocol::append_hex;
using mewtocol::read_hex;

void append_state(std::string& text, const state_read& s)
{
    text.append(state_argument);
    append_hex(text, s.series, 2);
    append_hex(text, s.model, 2);
    append_hex(text, s.special_order, 4);
    append_hex(text, s.newest_version, 4);
    append_hex(text, s.communication_version, 4);
    append_hex(text, s.operation_version, 4);
    append_hex(text, s.mode, 2);
    append_hex(text, s.error_flags, 2);
    append_hex(text, s.self_diagnosis, 4);
    append_hex(text, s.card, 2);
    text.append(s.rest);
}

// Digits from `at` on; something else makes the answer unexpected.
std::uint16_t hex_at(std::string_view text, std::size_t at, std::size_t digits, bool& good)
{
    const auto value = read_hex(text.substr(at, digits));
    good = good && value;
    return static_cast<std::uint16_t>(value.value_or(0));
}

result<response> parse_state(std::string_view text)
{
    constexpr std::size_t size = 38;
    if (text.size() != size || !text.starts_with(state_argument))
        return make_error_code(errc::unexpected_answer);
    bool good = true;
    const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(hex_at(text, at, 2, good)); };
    const auto word = [&](std::size_t at) { return hex_at(text, at, 4, good); };
    state_read s{byte(2),
                 byte(4),
                 word(6),
                 word(10),
                 word(14),
                 word(18),
                 byte(22),
                 byte(24),
                 word(26),
                 byte(30),
                 std::string(text.substr(32))};
    if (!good)
        return make_error_code(errc::unexpected_answer);
    return response{std::move(s)};
}

}  // namespace

std::string encode_response(const command& question, const response& answer, const dialect& d)
{
    if (std::holds_alternative<no_response>(answer))
        return {};
    if (const auto* code = std::get_if<error_code>(&answer)) {
        std::string text = "!" + d.before_error;
        append_hex(text, static_cast<std::uint8_t>(*code), 2);
        return text;
    }
    std::string text = "$";
    text.append(name_of(question));
    if (const auto* read = std::get_if<words_read>(&answer)) {
        text.append(d.before_words);
        append_data(text, read->values, d);
    }
    else if (const auto* state = std::get_if<state_read>(&answer)) {
        append_state(text, *state);
    }
    return text;
}

result<response> parse_response(const command& question, std::string_view text, const dialect& d)
{
    const auto unexpected = make_error_code(errc::unexpected_answer);
    if (text.starts_with('!')) {
        const std::string_view behind = text.substr(1);
        if (!behind.starts_with(d.before_error) || behind.size() != d.before_error.size() + 2)
            return unexpected;
        const auto code = read_hex(behind.substr(d.before_error.size()));
        if (!code)
            return unexpected;
        return response{error_code{static_cast<std::uint8_t>(*code)}};
    }
    if (!text.starts_with('$') || text.substr(1, name_size) != name_of(question))
        return unexpected;
    std::string_view data = text.substr(1 + name_size);
    if (std::holds_alternative<read_status>(question))
        return parse_state(data);
    if (std::holds_alternative<write_words>(question))
        return data.empty() ? result<response>{response{executed{}}} : unexpected;
    if (!data.starts_with(d.before_words))
        return unexpected;
    data.remove_prefix(d.before_words.size());
    auto values =
        data.size() == 4 * std::size_t{std::get<read_words>(question).count} ? read_data(data, d) : std::nullopt;
    if (!values)
        return unexpected;
    return response{words_read{std::move(*values)}};
}

}  // namespace plcgw::mewtocol7
