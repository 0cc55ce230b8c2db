#include "daemon/doctor/doctor.hpp"

#include "bridge/dds/log.hpp"
#include "daemon/doctor/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

namespace plcgw {
namespace {

void print(const finding& f)
{
    switch (f.how) {
    case finding::weight::good: fmt::print("ok     {}\n", f.text); break;
    case finding::weight::note: fmt::print("note   {}\n", f.text); break;
    case finding::weight::bad:
        fmt::print("WRONG  {}\n", f.text);
        if (!f.cure.empty())
            fmt::print("       -> {}\n", f.cure);
        break;
    }
    std::fflush(stdout);
}

// Participants say hello when they start and answer such a hello; their endpoints come a little later.
std::vector<seen_participant> listen(dds_discovery& in, unsigned seconds)
{
    using namespace std::chrono_literals;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
    std::vector<seen_participant> seen = in.look();
    while (std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(100ms);
        seen = in.look();
    }
    return seen;
}

}  // namespace

int doctor_dds(const dds_settings& settings, unsigned seconds)
{
    findings found;
    std::size_t shown = 0;
    const auto show = [&] {
        for (; shown < found.size(); ++shown)
            print(found[shown]);
    };
    if (!settings.enabled)
        found.push_back(
            {finding::weight::bad, "dds.enabled is false: the gateway publishes nothing", "set dds.enabled to true"});
    look_at_cyclone_config(settings, found);
    look_at_interface(settings, found);
    look_at_ports(settings, found);
    look_at_peers(settings, found);
    show();

    set_dds_log([](dds_log_level level, const std::string& line) {
        if (level != dds_log_level::info)
            fmt::print("note   Cyclone DDS says: {}\n", line);
    });
    auto discovery = dds_discovery::create(settings);
    if (!discovery) {
        found.push_back({finding::weight::bad, discovery.error().text,
                         "settle what is wrong above; without such a line, what Cyclone DDS says here is the reason"});
    }
    else {
        found.push_back({finding::weight::good,
                         fmt::format("DDS starts on domain {}; listening for {} s ...", settings.domain, seconds),
                         {}});
        show();
        look_at_participants(settings, listen(*discovery, seconds), seconds, found);
    }
    show();
    set_dds_log({});
    const auto wrong =
        std::ranges::count_if(found, [](const finding& each) { return each.how == finding::weight::bad; });
    fmt::print("{}\n", wrong == 0 ? "nothing is wrong" : fmt::format("{} wrong", wrong));
    return wrong == 0 ? 0 : 1;
}

}  // namespace plcgw
