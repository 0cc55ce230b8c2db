#include "daemon/config/reader.hpp"

#include <algorithm>
#include <numeric>

namespace plcgw::config {
namespace {

std::size_t edit_distance(const std::string& a, const std::string& b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
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
    constexpr std::size_t longest = 60;
    if (said.size() > longest)
        said = said.substr(0, longest) + "...";
    return said;
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& known)
{
    std::string best;
    std::size_t fewest = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& candidate : known) {
        const std::size_t edits = edit_distance(word, candidate);
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
                 "is no known key: " + (meant.empty() ? "known are " + joined(all) : "did you mean \"" + meant + "\"?"));
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
        complain(at, "is empty");
    else if (value.size() > rule.most)
        complain(at, "is longer than " + std::to_string(rule.most) + " bytes: shorten it");
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

std::optional<std::int64_t> reader::integer(const nlohmann::json& from, const std::string& at, const range& rule)
{
    const bool fits = from.is_number_integer() && (!from.is_number_unsigned() || from.get<std::uint64_t>() <= INT64_MAX);
    if (fits && from.get<std::int64_t>() >= rule.least && from.get<std::int64_t>() <= rule.most)
        return from.get<std::int64_t>();
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
