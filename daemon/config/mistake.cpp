#include "daemon/config/mistake.hpp"

#include <algorithm>

namespace plcgw::config {

bool has_errors(const mistakes& all)
{
    return std::any_of(all.begin(), all.end(), [](const mistake& m) { return m.how == mistake::weight::error; });
}

std::string to_string(const std::string& file, const mistake& m)
{
    std::string said = file + ":";
    if (m.line != 0)
        said += std::to_string(m.line) + ":";
    said += m.how == mistake::weight::warning ? " warning: " : " ";
    if (!m.pointer.empty())
        said += m.pointer + " ";
    return said + m.text;
}

}  // namespace plcgw::config
