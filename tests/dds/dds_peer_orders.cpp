#include "tests/dds/dds_peer_orders.hpp"

#include "bridge/dds/command_client.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>
#include <poll.h>
#include <unistd.h>

namespace plcgw::test {
namespace {

constexpr std::chrono::milliseconds repeat_after{100};
constexpr std::chrono::minutes begin_within{1};  // longer than any takeover: none may expire

std::int64_t now_ns() { return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void say(const nlohmann::json& what)
{
    std::puts(what.dump().c_str());
    std::fflush(stdout);
}

class orderer {
public:
    orderer(command_client& out, order_request next) : out_(out), next_(std::move(next)) {}

    void run()
    {
        while (!ended_ || !answered_) {
            if (answered_)
                begin();
            else if (now_ns() >= again_at_)
                send();
            wait();
            hear();
        }
        // What is said twice is said by now.
        for (const std::int64_t end = now_ns() + 500'000'000; now_ns() < end; hear())
            wait();
    }

private:
    void begin()
    {
        ++next_.key.request;
        auto& values = std::get<route_order>(next_.what.what).values;
        values = {false, 1, {static_cast<std::uint16_t>(next_.key.request)}};
        answered_ = false;
        say({{"sent", next_.key.request}, {"at", now_ns()}});
        send();
    }

    void send()
    {
        out_.send(next_);
        again_at_ = now_ns() + std::chrono::nanoseconds(repeat_after).count();
    }

    void wait()
    {
        std::array<pollfd, 2> ready{{{out_.descriptor(), POLLIN, 0}, {ended_ ? -1 : STDIN_FILENO, POLLIN, 0}}};
        ::poll(ready.data(), ready.size(), 10);
        std::array<char, 64> ignored{};
        if (ready[1].revents != 0)
            ended_ = ::read(STDIN_FILENO, ignored.data(), ignored.size()) <= 0;
    }

    void hear()
    {
        for (const order_reply& each : out_.take()) {
            if (each.key.client != next_.key.client)
                continue;
            say({{"answered", each.key.request},
                 {"result", to_string(each.outcome.result)},
                 {"detail", each.outcome.detail},
                 {"member", each.member},
                 {"done", static_cast<std::int64_t>(each.done)},
                 {"at", now_ns()}});
            answered_ = answered_ || each.key.request == next_.key.request;
        }
    }

    command_client& out_;
    order_request next_;
    std::int64_t again_at_ = 0;
    bool answered_ = true;
    bool ended_ = false;
};

}  // namespace

int give_orders(const dds_settings& settings, const std::string& gateway, const std::string& client, route_order target)
{
    auto out = command_client::create(settings);
    if (!out)
        return std::fprintf(stderr, "%s\n", out.error().text.c_str()), 1;
    orderer(*out, {{client, 0}, gateway, {std::move(target), wall_time::never, begin_within}, {}}).run();
    return 0;
}

}  // namespace plcgw::test
