#include "tests/config/plant.hpp"

#include <doctest/doctest.h>
#include <fmt/core.h>

namespace plcgw::config {

std::string changed(std::string_view from, std::string_view to, std::string_view in)
{
    const std::size_t at = in.find(from);
    REQUIRE_MESSAGE(at != in.npos, "not in the text: " << std::string(from));
    REQUIRE_MESSAGE(in.find(from, at + 1) == in.npos, "stands twice in the text: " << std::string(from));
    return std::string(in).replace(at, from.size(), to);
}

std::string said(const mistakes& found)
{
    std::string all;
    for (const mistake& m : found)
        all += fmt::format("{}{} {}{}{}{}", all.empty() ? "" : "\n", m.line,
                           m.how == mistake::weight::warning ? "warning " : "", m.pointer, m.pointer.empty() ? "" : " ",
                           m.text);
    return all;
}

std::string said(std::string_view text, const std::filesystem::path& folder)
{
    return said(load_text(text, folder).found);
}

void check_row(const change_row& row)
{
    INFO(std::string(row.to));
    CHECK(said(changed(row.from, row.to)) == row.expected);
}

}  // namespace plcgw::config
