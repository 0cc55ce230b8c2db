#include "daemon/config/located_json.hpp"

#include <algorithm>
#include <iterator>

namespace plcgw::config {
namespace {

using nlohmann::json;

// Counts how far the parser has read. nlohmann's lexer takes one character after a number before it reports it: a line
// break belongs to the line that it ends, so the count is right then too.
struct reading_position {
    std::size_t characters = 0;
    std::size_t line = 1;
    bool after_break = false;

    void advance(char c)
    {
        ++characters;
        line += after_break ? 1 : 0;
        after_break = c == '\n';
    }
};

class counting_iterator {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    counting_iterator(const char* at, reading_position* position) : at_(at), position_(position) {}

    reference operator*() const { return *at_; }
    counting_iterator& operator++()
    {
        position_->advance(*at_);
        ++at_;
        return *this;
    }
    counting_iterator operator++(int)
    {
        counting_iterator before = *this;
        ++*this;
        return before;
    }
    bool operator==(const counting_iterator& other) const { return at_ == other.at_; }

private:
    const char* at_;
    reading_position* position_;
};

constexpr std::size_t most_levels = 32;  // a configuration has 5

// Parts of nlohmann's "syntax error while parsing object key - unexpected '}'; expected ...", and what helps.
struct syntax_cure {
    std::string_view when;
    std::string_view cure;
};

constexpr syntax_cure syntax_cures[] = {
    {"unexpected end of input", ": is the file complete?"},
    {"object key - unexpected '}'", ": is there a comma too many before it?"},
    {"value - unexpected ']'", ": is there a comma too many before it?"},
    {"object - unexpected string literal", ": is a comma missing before it?"},
    {"array - unexpected string literal", ": is a comma missing before it?"},
    {"array - unexpected number literal", ": is a comma missing before it?"},
    {"array - unexpected '{'", ": is a comma missing before it?"},
};

std::string syntax_error(std::string_view what)
{
    std::string_view said = what;  // "[json.exception.parse_error.101] parse error at line 3, column 7: syntax ..."
    for (const std::string_view lead : {"] ", " - "})
        said.remove_prefix(said.find(lead) == said.npos ? 0 : said.find(lead) + lead.size());
    constexpr std::size_t longest = 120;
    if (said.size() > longest)
        said = said.substr(0, std::min(longest, said.find("; last read")));
    std::string text = "is no JSON: " + std::string(said);
    for (const syntax_cure& each : syntax_cures)
        if (what.find(each.when) != what.npos)
            return text.append(each.cure);
    return text;
}

class builder : public nlohmann::json_sax<json> {
public:
    builder(located_json& to, const reading_position& position, mistakes& found)
        : to_(to), position_(position), found_(found)
    {
    }

    bool null() override { return scalar(nullptr); }
    bool boolean(bool value) override { return scalar(value); }
    bool number_integer(number_integer_t value) override { return scalar(value); }
    bool number_unsigned(number_unsigned_t value) override { return scalar(value); }
    bool number_float(number_float_t value, const string_t&) override { return scalar(value); }
    bool string(string_t& value) override { return scalar(value); }
    bool binary(binary_t&) override { return false; }

    bool start_object(std::size_t) override { return open(json::object()); }
    bool start_array(std::size_t) override { return open(json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override
    {
        key_ = name;
        const std::string pointer = open_.back().pointer + "/" + escape_pointer(name);
        if (open_.back().value->contains(name))
            found_.push_back({pointer, position_.line, "stands here for the second time: remove one"});
        to_.lines[pointer] = position_.line;
        return true;
    }

    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) override
    {
        found_.push_back({"", position_.line, syntax_error(error.what())});
        return false;
    }

private:
    struct container {
        json* value;
        std::string pointer;
    };

    bool scalar(json value)
    {
        place(std::move(value));
        return true;
    }

    bool open(json empty)
    {
        if (open_.size() == most_levels) {
            found_.push_back(
                {"", position_.line, "is nested deeper than any configuration: look for a bracket too many"});
            return false;
        }
        std::string pointer = next_pointer();
        json* const placed = place(std::move(empty));
        open_.push_back({placed, std::move(pointer)});
        return true;
    }

    bool close()
    {
        open_.pop_back();
        return true;
    }

    std::string next_pointer() const
    {
        if (open_.empty())
            return {};
        const container& in = open_.back();
        return in.pointer + "/" + (in.value->is_array() ? std::to_string(in.value->size()) : escape_pointer(key_));
    }

    json* place(json value)
    {
        if (open_.empty()) {
            to_.value = std::move(value);
            return &to_.value;
        }
        json& in = *open_.back().value;
        if (in.is_object())
            return &(in[key_] = std::move(value));
        to_.lines[next_pointer()] = position_.line;
        in.push_back(std::move(value));
        return &in.back();
    }

    located_json& to_;
    const reading_position& position_;
    mistakes& found_;
    std::vector<container> open_;
    std::string key_;
};

}  // namespace

std::size_t located_json::line_of(std::string pointer) const
{
    for (;;) {
        if (const auto found = lines.find(pointer); found != lines.end())
            return found->second;
        const std::size_t parent = pointer.rfind('/');
        if (parent == pointer.npos)
            return 1;
        pointer.erase(parent);
    }
}

std::string escape_pointer(std::string_view key)
{
    std::string escaped;
    for (const char c : key) {
        if (c == '~')
            escaped += "~0";
        else if (c == '/')
            escaped += "~1";
        else
            escaped += c;
    }
    return escaped;
}

located_json parse_located(std::string_view text, mistakes& found)
{
    located_json parsed;
    // nlohmann takes a zero byte for the end of the file, whatever follows.
    if (const std::size_t zero = text.find('\0'); zero != text.npos) {
        const auto breaks = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(zero), '\n');
        found.push_back({"", static_cast<std::size_t>(breaks) + 1, "holds a zero byte: save the file as UTF-8"});
        return parsed;
    }
    reading_position position;
    builder sax(parsed, position, found);
    const counting_iterator first(text.data(), &position);
    const counting_iterator last(text.data() + text.size(), &position);
    constexpr bool strict = true;
    constexpr bool ignore_comments = true;
    parsed.complete =
        json::sax_parse(first, last, &sax, nlohmann::detail::input_format_t::json, strict, ignore_comments);
    return parsed;
}

}  // namespace plcgw::config
