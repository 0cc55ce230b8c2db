#include "daemon/learned_keeper.hpp"

#include "daemon/log.hpp"
#include "daemon/state_path.hpp"

namespace plcgw {

learned_keeper::learned_keeper(const std::string& configured_folder) : store_(state_folder(configured_folder)) {}

void learned_keeper::remember(const lines& all) const
{
    const learned_store::loaded kept = store_.load();
    if (!kept.problem.empty())
        log::warning("{} {}", store_.file().string(), kept.problem);
    for (const auto& line : all)
        line->remember(kept.stations);
}

void learned_keeper::keep(const lines& all)
{
    learned_by_station stations;
    for (const auto& line : all)
        line->tell(stations);
    const std::string problem = store_.save(stations);
    if (!problem.empty() && problem != problem_)
        log::warning("{} cannot be written: {}. What is learned about devices is lost at the next restart",
                     store_.file().string(), problem);
    problem_ = problem;
}

}  // namespace plcgw
