#include "daemon/config/read.hpp"

#include "daemon/config/check.hpp"
#include "daemon/config/reader.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace plcgw::config {
namespace {

// FNV-1a: tells two configurations apart, no more.
std::string hash_of(std::string_view text)
{
    std::uint64_t hash = 0xCBF29CE484222325;
    for (const char c : text)
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3;
    return fmt::format("{:016x}", hash);
}

}  // namespace

loaded load_text(std::string_view text, const std::filesystem::path& folder)
{
    loaded result;
    result.folder = folder.string();
    result.hash = hash_of(text);
    const located_json file = parse_located(text, result.found);
    if (!file.complete)
        return result;
    if (!file.value.is_object()) {
        result.found.push_back({"", 1, "the file holds no object: { ... }"});
        return result;
    }
    reader root(file, file.value, "", result.found);
    describe(root, result.config);
    root.report_unknown_keys();
    dds_config& dds = result.config.dds;
    dds.settings.topics = dds.topics.all();
    if (!dds.settings.cyclone_config.empty())
        dds.settings.cyclone_config = (folder / dds.settings.cyclone_config).string();
    check(result.config, file, result.folder, result.found);
    std::stable_sort(result.found.begin(), result.found.end(),
                     [](const mistake& a, const mistake& b) { return a.line < b.line; });
    return result;
}

loaded load_file(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    if (!stream || std::filesystem::is_directory(file)) {
        loaded result;
        const std::string why = stream ? "is a folder" : std::strerror(errno);
        result.found.push_back({"", 0, "cannot be read: " + why});
        return result;
    }
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    return load_text(text, file.parent_path());
}

}  // namespace plcgw::config
