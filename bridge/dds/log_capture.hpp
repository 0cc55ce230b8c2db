// Keeps what Cyclone logs on this thread while an entity is created: the return code alone never says why.
#pragma once

#include "bridge/dds/log.hpp"

#include <utility>
#include <vector>

namespace plcgw {

class log_capture {
public:
    log_capture();
    ~log_capture();  // lines that text() did not take go to the handler
    log_capture(const log_capture&) = delete;
    log_capture& operator=(const log_capture&) = delete;

    void add(dds_log_level level, std::string line) { lines_.emplace_back(level, std::move(line)); }
    std::string text();

private:
    std::vector<std::pair<dds_log_level, std::string>> lines_;
};

}  // namespace plcgw
