#include "bridge/messages/pattern.hpp"

#include <algorithm>

namespace plcgw::messages {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Goes through a message once, from left to right.
class reader {
public:
    explicit reader(std::string_view text) : text_(text) {}

    // What the element takes, or nothing; then place() is where it failed and expected() what it wanted there.
    std::optional<capture> take(const element& e, const element* next)
    {
        const std::size_t begin = at_;
        decimal number;
        if (!take(e, next, number))
            return std::nullopt;
        return capture{text_.substr(begin, at_ - begin), number};
    }

    std::size_t place() const { return at_ + 1; }
    const std::string& expected() const { return expected_; }
    bool at_end() const { return at_ == text_.size(); }

private:
    bool fail(std::string expected)
    {
        expected_ = std::move(expected);
        return false;
    }

    char peek() const { return at_end() ? '\0' : text_[at_]; }
    bool digit_here() const { return !at_end() && is_digit(peek()); }
    bool skip(char c)
    {
        const bool here = !at_end() && peek() == c;
        at_ += here ? 1 : 0;
        return here;
    }
    void skip_spaces()
    {
        while (skip(' '))
            continue;
    }

    bool take(const element& e, const element* next, decimal& number)
    {
        switch (e.kind) {
        case form::literal: return literal(e.text);
        case form::picture: return picture(e, number);
        case form::number: return plain_number(e.point, number);
        case form::scientific: return plain_number(e.point, number) && exponent(number);
        case form::hex: return hex(e.count, number);
        case form::text: return characters(e.count);
        case form::rest_of_text: return up_to(next);
        case form::spaces: skip_spaces(); return true;
        }
        return false;
    }

    bool literal(std::string_view text)
    {
        const std::string_view here = text_.substr(at_, text.size());
        const auto differs = std::mismatch(here.begin(), here.end(), text.begin()).first;
        at_ += static_cast<std::size_t>(differs - here.begin());
        return differs == here.end() && here.size() == text.size() ? true : fail(quoted(text));
    }

    static std::string quoted(std::string_view text)
    {
        return '"' + printable({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}) + '"';
    }

    bool digit(decimal& number)
    {
        if (!digit_here())
            return false;
        number.append(static_cast<unsigned>(text_[at_++] - '0'));
        return true;
    }

    bool picture(const element& e, decimal& number)
    {
        if (e.signs != element::sign::none) {
            number.negative = peek() == '-';
            const bool taken = skip('-') || skip('+') || (e.signs == element::sign::optional && skip(' '));
            if (!taken)
                return fail(e.signs == element::sign::required ? "a sign" : "a sign or a space");
        }
        bool begun = false;
        for (const char each : e.before)
            if (digit(number))
                begun = true;
            else if (begun || each == '0' || !skip(' '))
                return fail(begun || each == '0' ? "a digit" : "a digit or a space");
        if (e.after == 0)
            return begun ? true : fail("a digit before here");
        if (!skip(e.point))
            return fail(quoted({&e.point, 1}));
        for (std::size_t i = 0; i < e.after; ++i)
            if (!digit(number))
                return fail("a digit");
        number.places = static_cast<int>(e.after);
        return true;
    }

    bool plain_number(char point, decimal& number)
    {
        skip_spaces();
        number.negative = peek() == '-';
        if (skip('-') || skip('+'))
            skip_spaces();
        bool begun = false;
        while (digit(number))
            begun = true;
        if (skip(point))
            for (; digit(number); begun = true)
                ++number.places;
        return begun ? true : fail("a digit");
    }

    bool exponent(decimal& number)
    {
        constexpr int largest = 9999;  // beyond what any type holds
        if (!skip('E') && !skip('e'))
            return true;
        const bool negative = peek() == '-';
        if (!skip('-'))
            skip('+');
        if (!digit_here())
            return fail("a digit of the exponent");
        int value = 0;
        for (; digit_here(); ++at_)
            value = std::min(largest, value * 10 + (peek() - '0'));
        number.places += negative ? value : -value;
        return true;
    }

    bool hex(std::size_t count, decimal& number)
    {
        for (std::size_t i = 0; i < count; ++i, ++at_) {
            const char c = peek();
            const bool letter = (c >= 'A' && c <= 'F') || (c >= 'a' && c <= 'f');
            if (!is_digit(c) && !letter)
                return fail("a hexadecimal digit");
            const unsigned digit = letter ? (static_cast<unsigned>(c) & 0x0FU) + 9U : static_cast<unsigned>(c - '0');
            number.digits = number.digits << 4 | digit;
        }
        return true;
    }

    bool characters(std::size_t count)
    {
        const std::size_t there = text_.size() - at_;
        at_ += std::min(count, there);
        return there >= count ? true : fail("text of " + std::to_string(count) + " characters");
    }

    bool up_to(const element* next)
    {
        const std::size_t end = next == nullptr ? text_.size() : text_.find(next->text, at_);
        if (end == text_.npos)
            return fail(quoted(next->text) + " behind the text");
        at_ = end;
        return true;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::string expected_;
};

}  // namespace

boost::system::result<std::vector<capture>, mismatch> pattern::match(bytes message) const
{
    reader in({reinterpret_cast<const char*>(message.data()), message.size()});
    std::vector<capture> taken(names_.size());
    for (std::size_t i = 0; i < elements_.size(); ++i) {
        const element& each = elements_[i];
        const auto part = in.take(each, i + 1 < elements_.size() ? &elements_[i + 1] : nullptr);
        if (!part)
            return mismatch{in.place(), each.position, in.expected()};
        if (each.at)
            taken[*each.at] = *part;
    }
    if (!in.at_end())
        return mismatch{in.place(), 0, "the end of the message"};
    return taken;
}

std::string to_string(const mismatch& why)
{
    const std::string place = "byte " + std::to_string(why.byte) + ": expected " + why.expected;
    return why.position == 0 ? place : place + " (character " + std::to_string(why.position) + " of the pattern)";
}

}  // namespace plcgw::messages
