#include "daemon/config/program_file.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace plcgw::config {

std::optional<std::string> program_text(const plc_config& c, const std::string& folder)
{
    if (c.program_file.empty()) {
        std::string text;
        for (const std::string& line : c.program)
            text += line + "\n";
        return text;
    }
    const std::filesystem::path path = std::filesystem::path(folder) / c.program_file;
    if (!std::filesystem::is_regular_file(path))  // a pipe would wait for somebody who writes
        return std::nullopt;
    std::ifstream file(path);
    if (!file)
        return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace plcgw::config
