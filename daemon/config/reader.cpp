#include "daemon/config/reader.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

namespace plcgw::config {
namespace {

bool same_letter(char a, char b)
{
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

std::size_t edit_distance(const std::string& a, const std::string& b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (same_letter(a[i - 1], b[j - 1]) ? 0 : 1);
            diagonal = std::exchange(row[j], std::min({row[j] + 1, row[j - 1] + 1, replaced}));
        }
    }
    return row.back();
}

std::string joined(const std::vector<std::string_view>& names)
{
    std::string all;
    for (const std::string_view name : names)
        all.append(all.empty() ? "" : ", ").append(name);
    return all;
}

std::string dumped(const nlohmann::json& value)
{
    std::string said = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::size_t longest = 60;
    if (said.size() <= longest)
        return said;
    while ((static_cast<unsigned char>(said[longest]) & 0xC0U) == 0x80U)  // not within a character
        --longest;
    return said.substr(0, longest) + "...";
}

bool is_control(char c) { return (static_cast<unsigned char>(c) < 0x20U && c != '\t') || c == '\x7F'; }

// As JSON Schema has it: 1.0 is an integer.
std::optional<std::int64_t> whole_number(const nlohmann::json& from)
{
    constexpr double exact = 9007199254740992.0;  // 2^53
    if (from.is_number_unsigned() && from.get<std::uint64_t>() > INT64_MAX)
        return std::nullopt;
    if (from.is_number_integer())
        return from.get<std::int64_t>();
    if (from.is_number_float() && std::abs(from.get<double>()) < exact &&
        std::trunc(from.get<double>()) == from.get<double>())
        return static_cast<std::int64_t>(from.get<double>());
    return std::nullopt;
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& known)
{
    std::string best;
    std::size_t fewest = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& candidate : known) {
        const bool without_unit = candidate.starts_with(word + "_");  // "period" for "period_ms"
        const std::size_t edits = without_unit ? 1 : edit_distance(word, candidate);
        if (edits < fewest) {
            fewest = edits;
            best = candidate;
        }
    }
    return best;
}

void reader::report_unknown_keys()
{
    for (const auto& [key, value] : object_.items()) {
        if (std::find(known_.begin(), known_.end(), key) != known_.end())
            continue;
        const std::string meant = nearest(key, known_);
        std::vector<std::string_view> all(known_.begin(), known_.end());
        complain(pointer_ + "/" + escape_pointer(key),
                 "is no known key: " +
                     (meant.empty() ? "known are " + joined(all) : "did you mean \"" + meant + "\"?"));
    }
}

void reader::read(const nlohmann::json& from, const std::string& at, std::string& out, const text& rule)
{
    if (!from.is_string()) {
        complain(at, "is " + dumped(from) + ", expected a text in quotes");
        return;
    }
    const auto& value = from.get_ref<const std::string&>();
    if (value.size() < rule.least)
        complain(at, value.empty() ? "is empty: give it a text" : "is " + dumped(from) + ", which is too short");
    else if (value.size() > rule.most)
        complain(at, "is longer than " + std::to_string(rule.most) + " bytes: shorten it");
    else if (std::any_of(value.begin(), value.end(), is_control))
        complain(at, "is " + dumped(from) + ", expected a text without line breaks and control characters");
    else
        out = value;
}

void reader::read(const nlohmann::json& from, const std::string& at, bool& out)
{
    if (from.is_boolean())
        out = from.get<bool>();
    else
        complain(at, "is " + dumped(from) + ", expected true or false");
}

void reader::read(const nlohmann::json& from, const std::string& at, unsigned& out, const range& rule)
{
    if (const auto value = integer(from, at, rule))
        out = static_cast<unsigned>(*value);
}

void reader::read(const nlohmann::json& from, const std::string& at, std::vector<std::string>& out, const text& rule)
{
    if (!from.is_array()) {
        complain(at, "is " + dumped(from) + ", expected an array of texts: [ \"...\", \"...\" ]");
        return;
    }
    for (std::size_t i = 0; i < from.size(); ++i)
        read(from[i], at + "/" + std::to_string(i), out.emplace_back(), rule);
}

void reader::read(const nlohmann::json& from, const std::string& at, double& out, const real_range& rule)
{
    const double value = from.is_number() ? from.get<double>() : std::nan("");
    if (value >= rule.least && value <= rule.most)
        out = value;
    else
        complain(at,
                 "is " + dumped(from) + ", expected a number from " + dumped(rule.least) + " to " + dumped(rule.most));
}

void reader::read(const nlohmann::json& from, const std::string& at, std::vector<unsigned>& out, const range& rule)
{
    if (!from.is_array()) {
        complain(at, "is " + dumped(from) + ", expected an array of numbers: [ 0, 1 ]");
        return;
    }
    for (std::size_t i = 0; i < from.size(); ++i)
        read(from[i], at + "/" + std::to_string(i), out.emplace_back(), rule);
}

std::optional<std::int64_t> reader::integer(const nlohmann::json& from, const std::string& at, const range& rule)
{
    const auto value = whole_number(from);
    if (value && *value >= rule.least && *value <= rule.most)
        return value;
    complain(at, "is " + dumped(from) + ", expected a whole number from " + std::to_string(rule.least) + " to " +
                     std::to_string(rule.most));
    return std::nullopt;
}

void reader::complain_choice(const nlohmann::json& from, const std::string& at,
                             const std::vector<std::string_view>& names)
{
    complain(at, "is " + dumped(from) + ", expected one of: " + joined(names));
}

void reader::complain(const std::string& at, std::string what)
{
    found_.push_back({at, file_.line_of(at), std::move(what)});
}

}  // namespace plcgw::config
