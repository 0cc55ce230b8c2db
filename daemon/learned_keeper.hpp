// What the running lines have learned about their stations, and the file that keeps it.
#pragma once

#include "daemon/learned_store.hpp"
#include "daemon/running_line.hpp"

namespace plcgw {

class learned_keeper {
public:
    using lines = std::vector<std::unique_ptr<running_line>>;

    explicit learned_keeper(const std::string& configured_folder);

    void remember(const lines& all) const;  // tells them what the file holds
    void keep(const lines& all);            // writes it; what fails is said in the log, once
    void keep_if_new(running_line& of, const lines& all)
    {
        if (of.routes.take_learned())
            keep(all);
    }

private:
    learned_store store_;
    std::string problem_;  // said
};

}  // namespace plcgw
