#include "daemon/learned_keeper.hpp"

#include "daemon/log.hpp"
#include "daemon/state_path.hpp"

#include <boost/asio/post.hpp>

namespace plcgw {
namespace {

learned_by_station told_by(const learned_keeper::lines& all)
{
    learned_by_station stations;
    for (const auto& line : all)
        line->tell(stations);
    return stations;
}

}  // namespace

learned_keeper::learned_keeper(asio::io_context& loop, const std::string& configured_folder)
    : loop_(loop), store_(state_folder(configured_folder))
{
}

void learned_keeper::remember(const lines& all) const
{
    const learned_store::loaded kept = store_.load();
    if (!kept.problem.empty())
        log::warning("{} {}", store_.file().string(), kept.problem);
    for (const auto& line : all)
        line->remember(kept.stations);
}

void learned_keeper::keep_if_new(running_line& of, const lines& all)
{
    if (!of.routes.take_learned())
        return;
    waiting_ = told_by(all);
    write_waiting();
}

void learned_keeper::write_waiting()
{
    if (writing_ || !waiting_)
        return;
    writing_ = true;
    asio::post(disk_, [this, stations = *std::exchange(waiting_, std::nullopt)] {
        asio::post(loop_, [this, problem = store_.save(stations)] {
            writing_ = false;
            say(problem);
            write_waiting();
        });
    });
}

void learned_keeper::keep(const lines& all)
{
    disk_.join();
    say(store_.save(told_by(all)));
}

void learned_keeper::say(const std::string& problem)
{
    if (!problem.empty() && problem != problem_)
        log::warning("{} cannot be written: {}. What is learned about devices is lost at the next restart",
                     store_.file().string(), problem);
    problem_ = problem;
}

}  // namespace plcgw
