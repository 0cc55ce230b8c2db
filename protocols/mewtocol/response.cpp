#include "protocols/mewtocol/response.hpp"

#include "protocols/mewtocol/text.hpp"

#include <algorithm>

namespace plcgw::mewtocol {
namespace {

constexpr std::string_view extended_name = "EX00RT00";  // repeated as a whole
constexpr std::size_t extended_size = 50;               // characters behind its count
constexpr std::size_t extended_rest = 30;

void append_status_errors(std::string& text, const plc_status& s)
{
    append_dec(text, s.capacity, 2);
    append_hex(text, s.mode, 2);
    append_hex(text, s.link, 2);
    append_hex(text, s.error_flags, 2);
    append_words(text, std::span(&s.self_diagnosis, 1));
}

// What follows the name in the text.
struct encoder {
    std::string& text;

    void operator()(const contacts_read& r) const
    {
        for (const bool on : r.values)
            text.push_back(on ? '1' : '0');
    }
    void operator()(const words_read& r) const { append_words(text, r.values); }
    void operator()(const executed&) const {}
    void operator()(const monitored& r) const
    {
        append_hex(text, std::min(r.scans, 10U), 1);
        append_hex(text, static_cast<std::uint32_t>(2 * r.contacts.size()), 2);
        for (const std::uint8_t eight : r.contacts)
            append_hex(text, eight, 2);
        append_hex(text, static_cast<std::uint32_t>(4 * r.words.size()), 2);
        append_words(text, r.words);
    }
    void operator()(const status_read& r) const
    {
        append_hex(text, r.status.model, 2);
        append_hex(text, r.status.version, 2);
        append_status_errors(text, r.status);
    }
    void operator()(const extended_status_read& r) const
    {
        text = "$";
        text.append(extended_name);
        append_hex(text, extended_size, 2);
        append_hex(text, r.status.model, 2);
        text.append("00");
        append_status_errors(text, r.status);
        append_hex(text, r.status.version, 2);
        append_hex(text, r.hardware, 2);
        text.append(r.rest);
    }
    void operator()(error_code) const {}
    void operator()(const no_response&) const {}
};

// Takes fields from the front of a text. One that is missing or has a wrong digit makes it bad for good.
class reader {
public:
    explicit reader(std::string_view text) : rest_(text) {}

    std::string_view characters(std::size_t count)
    {
        good_ = good_ && rest_.size() >= count;
        const std::string_view taken = rest_.substr(0, good_ ? count : 0);
        rest_.remove_prefix(taken.size());
        return taken;
    }
    std::uint8_t hex(std::size_t digits) { return number(read_hex(characters(digits))); }
    std::uint8_t dec(std::size_t digits) { return number(read_dec(characters(digits))); }
    std::vector<std::uint16_t> words(std::size_t count)
    {
        auto taken = words_in(characters(4 * count));
        good_ = good_ && taken && taken->size() == count;
        return good_ ? std::move(*taken) : std::vector<std::uint16_t>(count);
    }
    bool ended() const { return good_ && rest_.empty(); }

private:
    std::uint8_t number(std::optional<std::uint32_t> value)
    {
        good_ = good_ && value;
        return static_cast<std::uint8_t>(value.value_or(0));
    }

    std::string_view rest_;
    bool good_ = true;
};

using parsed = result<response>;

parsed checked(const reader& in, response value)
{
    if (!in.ended())
        return make_error_code(errc::unexpected_answer);
    return value;
}

parsed parse_contacts(std::string_view data, std::size_t count)
{
    if (data.size() != count || data.find_first_not_of("01") != std::string_view::npos)
        return make_error_code(errc::unexpected_answer);
    contacts_read r;
    for (const char each : data)
        r.values.push_back(each == '1');
    return response{std::move(r)};
}

parsed parse_monitored(std::string_view data)
{
    reader in(data);
    monitored r;
    r.scans = in.hex(1);
    const std::size_t contact_characters = in.hex(2);
    for (std::size_t i = 0; i < contact_characters / 2; ++i)
        r.contacts.push_back(in.hex(2));
    const std::size_t data_characters = in.hex(2);
    r.words = in.words(data_characters / 4);
    if (r.scans > 10 || contact_characters % 2 != 0 || data_characters % 4 != 0)
        return make_error_code(errc::unexpected_answer);
    return checked(in, std::move(r));
}

void read_status_errors(reader& in, plc_status& s)
{
    s.capacity = in.dec(2);
    s.mode = in.hex(2);
    s.link = in.hex(2);
    s.error_flags = in.hex(2);
    s.self_diagnosis = in.words(1).front();
}

parsed parse_status(std::string_view data)
{
    reader in(data);
    status_read r;
    r.status.model = in.hex(2);
    r.status.version = in.hex(2);
    read_status_errors(in, r.status);
    return checked(in, r);
}

parsed parse_extended_status(std::string_view data)
{
    reader in(data);
    extended_status_read r;
    const bool head = in.characters(extended_name.size() - 2) == extended_name.substr(2) && in.hex(2) == extended_size;
    r.status.model = in.hex(2);
    const bool zeros = in.characters(2) == "00";
    read_status_errors(in, r.status);
    r.status.version = in.hex(2);
    r.hardware = in.hex(2);
    r.rest = in.characters(extended_rest);
    if (!head || !zeros)
        return make_error_code(errc::unexpected_answer);
    return checked(in, std::move(r));
}

// What follows the two letters, one overload for each command that is answered by more than its name.
struct parser {
    std::string_view data;

    parsed operator()(const read_contact&) const { return parse_contacts(data, 1); }
    parsed operator()(const read_contacts& c) const { return parse_contacts(data, c.at.size()); }
    parsed operator()(const read_words& c) const
    {
        reader in(data);
        if (data.size() != 4 * std::size_t{c.count})
            return make_error_code(errc::unexpected_answer);
        words_read r{in.words(c.count)};
        return checked(in, std::move(r));
    }
    parsed operator()(const monitor&) const { return parse_monitored(data); }
    parsed operator()(const read_status&) const { return parse_status(data); }
    parsed operator()(const read_extended_status&) const { return parse_extended_status(data); }
    template <class Other>
    parsed operator()(const Other&) const
    {
        return checked(reader(data), executed{});
    }
};

}  // namespace

std::string encode_response(const command& question, const response& answer)
{
    if (std::holds_alternative<no_response>(answer))
        return {};
    if (const auto* code = std::get_if<error_code>(&answer)) {
        std::string text = "!";
        append_hex(text, static_cast<std::uint8_t>(*code), 2);
        return text;
    }
    std::string text = "$";
    text.append(to_string(code_of(question)));
    std::visit(encoder{text}, answer);
    return text;
}

parsed parse_response(const command& question, std::string_view text)
{
    if (text.starts_with('!')) {
        const auto code = read_hex(text.substr(1));
        if (text.size() != 3 || !code)
            return make_error_code(errc::unexpected_answer);
        return response{error_code{static_cast<std::uint8_t>(*code)}};
    }
    if (!text.starts_with('$') || text.substr(1, 2) != to_string(code_of(question)))
        return make_error_code(errc::unexpected_answer);
    return std::visit(parser{text.substr(3)}, question);
}

bool expects_answer(station_id station, const command& question)
{
    return station != station_id::global && !std::holds_alternative<abort_transfer>(question);
}

}  // namespace plcgw::mewtocol
