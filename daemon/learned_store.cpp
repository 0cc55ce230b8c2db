#include "daemon/learned_store.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <unistd.h>

namespace plcgw {
namespace {

using nlohmann::json;

constexpr const char* kinds[] = {"gap", "boundary", "block", "length"};  // as learned_limit::kind counts them
constexpr int version = 1;

json to_json(const learned_limit& l)
{
    json made = {{"what", kinds[static_cast<std::size_t>(l.what)]},
                 {"first", l.at.first},
                 {"end", l.at.end},
                 {"request_first", l.request.first},
                 {"request_end", l.request.end},
                 {"reason", l.reason},
                 {"since_ns", static_cast<std::int64_t>(l.since)}};
    if (l.seam) {
        made["seam_first"] = l.seam->first;
        made["seam_end"] = l.seam->end;
    }
    return made;
}

learned_limit limit_of(const json& from)
{
    const auto* const what = std::find(std::begin(kinds), std::end(kinds), from.at("what").get<std::string>());
    if (what == std::end(kinds))
        throw json::other_error::create(0, "no known limit: " + from.at("what").get<std::string>(), nullptr);
    learned_limit made{.what = static_cast<learned_limit::kind>(what - std::begin(kinds)),
                       .at = {from.at("first"), from.at("end")},
                       .request = {from.at("request_first"), from.at("request_end")},
                       .reason = from.at("reason"),
                       .since = wall_time{from.at("since_ns").get<std::int64_t>()}};
    if (from.contains("seam_first"))
        made.seam = read_block{from.at("seam_first"), from.at("seam_end")};
    if (made.at.first > made.at.end || made.request.first >= made.request.end)
        throw json::other_error::create(0, "a block that ends before it begins", nullptr);
    return made;
}

learned_by_station stations_of(const json& all)
{
    learned_by_station made;
    if (all.at("version") != version)
        throw json::other_error::create(0, "another version", nullptr);
    for (const json& each : all.at("stations")) {
        station_limits& of = made[{each.at("line").get<std::string>(), each.at("unit").get<unsigned>()}];
        if (each.contains("turnaround_us"))
            of.turnaround = duration{std::clamp<std::int64_t>(each.at("turnaround_us"), 0, 60'000'000)};
        for (const auto& [area, limits] : each.at("limits").items())
            for (const json& limit : limits)
                of.tables[area].restore(limit_of(limit));
    }
    return made;
}

json to_json(const learned_by_station& stations)
{
    json list = json::array();
    for (const auto& [who, learned] : stations) {
        json limits = json::object();
        for (const auto& [area, table] : learned.tables)
            for (const learned_limit& each : table.all())
                limits[area].push_back(to_json(each));
        json row = {{"line", who.first}, {"unit", who.second}, {"limits", std::move(limits)}};
        if (learned.turnaround)
            row["turnaround_us"] = learned.turnaround->count();
        list.push_back(std::move(row));
    }
    return {{"version", version}, {"stations", std::move(list)}};
}

std::string write_all(const std::filesystem::path& to, const std::string& text)
{
    const int file = ::open(to.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (file < 0)
        return std::strerror(errno);
    std::string why;
    for (std::size_t done = 0; done < text.size() && why.empty();) {
        const ssize_t size = ::write(file, text.data() + done, text.size() - done);
        if (size < 0)
            why = std::strerror(errno);
        else
            done += static_cast<std::size_t>(size);
    }
    if (why.empty() && ::fsync(file) != 0)
        why = std::strerror(errno);
    ::close(file);
    return why;
}

}  // namespace

learned_store::learned_store(const std::filesystem::path& folder)
    : file_(folder.empty() ? folder : folder / "learned.json")
{
}

learned_store::loaded learned_store::load() const
{
    loaded made;
    if (file_.empty())
        return made;
    std::ifstream stream(file_);
    if (!stream) {
        if (errno != ENOENT && errno != ENOTDIR)
            made.problem = std::string("cannot be read: ") + std::strerror(errno);
        return made;
    }
    try {
        made.stations = stations_of(json::parse(stream));
    }
    catch (const json::exception& wrong) {
        made.problem = std::string("is damaged and ignored: ") + wrong.what();
    }
    return made;
}

std::string learned_store::save(const learned_by_station& stations) const
{
    if (file_.empty())
        return {};
    std::error_code ec;
    std::filesystem::create_directories(file_.parent_path(), ec);
    if (ec)
        return ec.message();
    std::filesystem::path fresh = file_;
    fresh += ".new";
    std::string why = write_all(fresh, to_json(stations).dump(1) + "\n");
    if (!why.empty())
        return why;
    std::filesystem::rename(fresh, file_, ec);
    return ec ? ec.message() : std::string();
}

}  // namespace plcgw
