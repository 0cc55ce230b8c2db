// What the running lines have learned about their stations, and the file that keeps it.
#pragma once

#include "daemon/learned_store.hpp"
#include "daemon/running_line.hpp"

#include <boost/asio/thread_pool.hpp>

namespace plcgw {

// While the lines run, a thread of its own writes the file: a disk may take seconds for it.
class learned_keeper {
public:
    using lines = std::vector<std::unique_ptr<running_line>>;

    learned_keeper(asio::io_context& loop, const std::string& configured_folder);

    void remember(const lines& all) const;  // tells them what the file holds
    void keep_if_new(running_line& of, const lines& all);
    void keep(const lines& all);  // at the end: waits for the disk

private:
    void write_waiting();
    void say(const std::string& problem);  // in the log, once

    asio::io_context& loop_;
    learned_store store_;
    std::optional<learned_by_station> waiting_;  // to be written
    bool writing_ = false;
    std::string problem_;        // said
    asio::thread_pool disk_{1};  // the last member: its thread uses the others
};

}  // namespace plcgw
