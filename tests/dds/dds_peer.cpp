// The other process of the DDS tests; PLACE is domain/partition.
// dds_peer publish PLACE GATEWAY ROUTES: publishes, prints "ready", and ends with its standard input; each line there
//                                        disposes of the next route.
// dds_peer watch PLACE json|lines COUNT TIMEOUT_MS [FILTER]...: `plc-gateway watch`; 0 is no count, no timeout.
// dds_peer orders PLACE GATEWAY CLIENT ROUTE AREA FIRST: see dds_peer_orders.hpp; on the loopback interface.
#include "bridge/dds/publisher.hpp"
#include "daemon/watch.hpp"
#include "tests/dds/dds_peer_orders.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>

using namespace plcgw;

namespace {

sample peer_sample(unsigned i)
{
    return {"peer." + std::to_string(i),
            "holding",
            i,
            sample_format::words,
            2,
            {std::uint16_t(i), 7},
            quality::good,
            wall_time{1'700'000'000'123'000'000}};
}

int publish(const dds_settings& settings, const std::string& gateway, unsigned routes)
{
    auto out = dds_publisher::create(settings, {gateway, "peer", "1.0", "hash"});
    if (!out)
        return std::fprintf(stderr, "%s\n", out.error().text.c_str()), 1;
    for (unsigned i = 0; i < routes; ++i)
        out->publish(peer_sample(i));
    out->publish(gateway_status{gateway_role::solo, 0, wall_time{1}, routes, routes});
    std::puts("ready");
    std::fflush(stdout);
    unsigned disposed = 0;
    for (int c = std::getchar(); c != EOF; c = std::getchar())
        if (c == '\n')
            out->dispose(peer_sample(disposed++));
    return 0;
}

}  // namespace

int main(int argc, char** argv)
{
    const std::vector<std::string> args(argv + 1, argv + argc);
    if (args.size() < 4)
        return 2;
    dds_settings settings;
    const auto slash = args[1].find('/');
    settings.domain = static_cast<std::uint32_t>(std::stoul(args[1].substr(0, slash)));
    if (slash != std::string::npos)
        settings.partition = args[1].substr(slash + 1);
    if (args[0] == "publish")
        return publish(settings, args[2], static_cast<unsigned>(std::stoul(args[3])));
    if (args[0] == "orders" && args.size() == 7) {
        settings.interface = "lo";
        const auto first = static_cast<std::uint32_t>(std::stoul(args[6]));
        return test::give_orders(settings, args[2], args[3], {args[4], args[5], first, {}});
    }

    watch_options options{.dds = settings, .json = args[2] == "json", .count = {}, .timeout = {}, .filter = {}};
    if (args[3] != "0")
        options.count = static_cast<unsigned>(std::stoul(args[3]));
    if (args.size() > 4 && args[4] != "0")
        options.timeout = std::chrono::milliseconds(std::stoul(args[4]));
    if (args.size() > 5)
        options.filter.names.assign(args.begin() + 5, args.end());
    return watch(options);
}
