// A configuration file into structs, with every mistake in it.
#pragma once

#include "daemon/config/config.hpp"
#include "daemon/config/mistake.hpp"

#include <filesystem>

namespace plcgw::config {

struct loaded {
    gateway_config config;  // as far as it could be read
    mistakes found;
    std::string folder;  // of the file: program_file is relative to it
    std::string hash;    // of the file's text, 16 hexadecimal digits
};

loaded load_file(const std::filesystem::path& file);
loaded load_text(std::string_view text, const std::filesystem::path& folder);  // folder: for program_file

}  // namespace plcgw::config
