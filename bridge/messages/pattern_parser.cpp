#include "bridge/messages/pattern.hpp"

#include <algorithm>
#include <charconv>

namespace plcgw::messages {
namespace {

constexpr std::size_t most_picture_digits = 18;  // always fit into 64 bits
constexpr std::size_t most_hex_digits = 16;
constexpr std::size_t most_characters = 4096;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_name(std::string_view text)
{
    const auto fits = [](char c) {
        return is_digit(c) || c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    };
    return !text.empty() && std::all_of(text.begin(), text.end(), fits);
}

// "text(5)" -> 5 for "text"; nothing when it is something else, 0 when the number is none.
std::optional<std::size_t> count_of(std::string_view text, std::string_view word)
{
    if (!text.starts_with(word) || !text.substr(word.size()).starts_with('(') || !text.ends_with(')'))
        return std::nullopt;
    const std::string_view digits = text.substr(word.size() + 1, text.size() - word.size() - 2);
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), count);
    return error == std::errc{} && end == digits.data() + digits.size() ? count : 0;
}

bool takes_digits(const element& e) { return e.kind == form::number || e.kind == form::scientific; }

// Whether a number without a picture would go on with this character.
bool takes(const element& number, char next)
{
    const bool begins_exponent = number.kind == form::scientific && (next == 'e' || next == 'E');
    return is_digit(next) || next == number.point || begins_exponent;
}

}  // namespace

class pattern_parser {
public:
    explicit pattern_parser(std::string_view text) : text_(text) {}

    parsed<pattern> parse()
    {
        if (text_.size() > max_pattern_size)
            return text_mistake{max_pattern_size + 1, "a pattern has at most 1024 characters"};
        while (at_ < text_.size() && !mistake_)
            if (text_[at_] == '{')
                read_field();
            else
                read_literal();
        if (!mistake_)
            check_neighbours();
        if (!mistake_ && result_.names_.empty())
            fail(1, "the pattern has no field: write one as {name:number} or {name:text}");
        if (mistake_)
            return *mistake_;
        return std::move(result_);
    }

private:
    void fail(std::size_t position, std::string why)
    {
        if (!mistake_)
            mistake_ = text_mistake{position, std::move(why)};
    }

    void read_literal()
    {
        element literal;
        literal.kind = form::literal;
        literal.position = at_ + 1;
        buffer characters;
        while (at_ < text_.size() && text_[at_] != '{') {
            if (text_[at_] == '}')
                return fail(at_ + 1, "} without {; for the character write \\}");
            if (auto mistake = read_character(text_, at_, characters)) {
                mistake_ = std::move(mistake);
                return;
            }
        }
        literal.text.assign(characters.begin(), characters.end());
        result_.elements_.push_back(std::move(literal));
    }

    void read_field()
    {
        const std::size_t begin = at_;
        const std::size_t end = text_.find('}', begin);
        if (end == text_.npos || text_.substr(begin + 1, end - begin - 1).find('{') != text_.npos)
            return fail(begin + 1, "{ without }; for the character write \\{");
        const std::string_view inside = text_.substr(begin + 1, end - begin - 1);
        const std::string_view name = inside.substr(0, inside.find(':'));
        at_ = end + 1;
        if (!is_name(name))
            return fail(begin + 2, "a field needs a name of letters, digits and _, or _ alone");

        element field;
        field.kind = form::rest_of_text;
        field.position = begin + 1;
        field.text = text_.substr(begin, at_ - begin);
        if (name.size() < inside.size())
            read_form(field, inside.substr(name.size() + 1), begin + 1 + name.size() + 2);
        if (name != "_") {
            if (std::find(result_.names_.begin(), result_.names_.end(), name) != result_.names_.end())
                return fail(begin + 2, "there are two fields of the name " + std::string(name));
            field.at = result_.names_.size();
            result_.names_.emplace_back(name);
        }
        result_.elements_.push_back(std::move(field));
    }

    void read_form(element& field, std::string_view text, std::size_t position)
    {
        if (text == "number" || text == "number(,)") {
            field.kind = form::number;
            field.point = text == "number" ? '.' : ',';
        }
        else if (text == "scientific") {
            field.kind = form::scientific;
        }
        else if (text == "spaces") {
            field.kind = form::spaces;
        }
        else if (text == "text") {
            field.kind = form::rest_of_text;
        }
        else if (const auto characters = count_of(text, "text")) {
            read_count(field, form::text, *characters, most_characters, position + 5);
        }
        else if (const auto digits = count_of(text, "hex")) {
            read_count(field, form::hex, *digits, most_hex_digits, position + 4);
        }
        else if (!text.empty() && std::string_view("+-#0").find(text.front()) != text.npos) {
            read_picture(field, text, position);
        }
        else {
            fail(position, "\"" + std::string(text) +
                               "\" is no form: expected number, number(,), scientific, hex(4), " +
                               "text, text(5), spaces, or a picture as +###.#");
        }
    }

    void read_count(element& field, form kind, std::size_t count, std::size_t most, std::size_t position)
    {
        field.kind = kind;
        field.count = count;
        if (count == 0 || count > most)
            fail(position, "the number of characters must be 1 to " + std::to_string(most));
    }

    void read_picture(element& field, std::string_view text, std::size_t position)
    {
        std::size_t at = 0;
        field.kind = form::picture;
        if (text[at] == '+' || text[at] == '-')
            field.signs = text[at++] == '+' ? element::sign::required : element::sign::optional;
        for (; at < text.size() && (text[at] == '#' || text[at] == '0'); ++at)
            field.before.push_back(text[at]);
        if (field.before.empty())
            return fail(position + at, "a picture needs # or 0 here");
        const bool has_point = at < text.size() && (text[at] == '.' || text[at] == ',');
        if (has_point)
            field.point = text[at++];
        for (; has_point && at < text.size() && (text[at] == '#' || text[at] == '0'); ++at)
            ++field.after;
        if (at < text.size() || (has_point && field.after == 0))
            fail(position + at, "a picture is +, - or nothing, then # or 0, then perhaps . or , and again # or 0");
        else if (field.before.size() + field.after > most_picture_digits)
            fail(position, "a picture has at most " + std::to_string(most_picture_digits) + " digits");
    }

    // Fields whose end could not be told from the beginning of the next one.
    void check_neighbours()
    {
        for (std::size_t i = 0; i + 1 < result_.elements_.size(); ++i) {
            const element& first = result_.elements_[i];
            const element& second = result_.elements_[i + 1];
            const char next = second.kind == form::literal ? second.text.front() : '\0';
            if (first.kind == form::rest_of_text && second.kind != form::literal)
                fail(second.position, first.text + " does not know where to end before " + second.text +
                                          ": put text between them, or say how long it is, as text(5)");
            if (takes_digits(first) && (is_number(second.kind) || takes(first, next)))
                fail(second.position, first.text + " takes the digits that follow it: put something between them, or " +
                                          "use a picture as ###.#");
            if (first.kind == form::spaces && next == ' ')
                fail(second.position, first.text + " takes the space that follows it");
        }
    }

    std::string_view text_;
    std::size_t at_ = 0;
    pattern result_;
    std::optional<text_mistake> mistake_;
};

parsed<pattern> pattern::parse(std::string_view text) { return pattern_parser(text).parse(); }

form pattern::form_of(std::size_t name) const
{
    return std::find_if(elements_.begin(), elements_.end(), [&](const element& each) { return each.at == name; })->kind;
}

}  // namespace plcgw::messages
