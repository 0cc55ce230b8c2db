#include "daemon/config/mistake.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace plcgw::config {
namespace {

// Keys and program lines are quoted as they stand in the file: a terminal gets no control characters, no broken UTF-8.
std::string printable(const std::string& text)
{
    const std::string quoted = nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::string said;
    for (std::size_t i = 1; i + 1 < quoted.size(); ++i) {
        if (quoted[i] == '\\' && (quoted[i + 1] == '\\' || quoted[i + 1] == '"'))
            ++i;
        said += quoted[i];
    }
    return said;
}

}  // namespace

std::size_t count_errors(const mistakes& all)
{
    return static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [](const mistake& m) { return m.how == mistake::weight::error; }));
}

bool has_errors(const mistakes& all) { return count_errors(all) != 0; }

std::string to_string(const std::string& file, const mistake& m)
{
    std::string said = file + ":";
    if (m.line != 0)
        said += std::to_string(m.line) + ":";
    said += m.how == mistake::weight::warning ? " warning: " : " ";
    if (!m.pointer.empty())
        said += m.pointer + " ";
    return printable(said + m.text);
}

}  // namespace plcgw::config
