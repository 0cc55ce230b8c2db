// What the two members of a hot-standby pair tell each other: pair.idl.
#pragma once

#include "bridge/dds/error.hpp"
#include "bridge/dds/settings.hpp"
#include "bridge/standby/pair_beat.hpp"
#include "bridge/standby/pair_mirror.hpp"

#include <memory>
#include <variant>

namespace plcgw {

// The other member has not asserted its liveliness for its lease, or its process is gone.
struct pair_lost {
    std::string member;
};

using pair_news = std::variant<pair_beat, memory_chunk, route_record, pair_lost>;

struct pair_identity {
    std::string gateway;
    std::string member;
    wall_time started{};
};

// Create, use and destroy on one thread. Nothing here waits.
class pair_port {
public:
    // lease: the other member notices within this time that this one has stopped. Say beats more often.
    static dds_result<pair_port> create(const dds_settings& settings, pair_identity who, duration lease);

    pair_port(pair_port&&) noexcept;
    pair_port& operator=(pair_port&&) noexcept;
    ~pair_port();

    void publish(const pair_beat& beat);
    void publish(const memory_chunk& chunk);
    void publish(const route_record& route);
    std::uint64_t drops() const;  // what could not be written

    int descriptor() const;  // readable: call take()

    // Of other members of the same gateway, beats first. A beat of another process that has this one's own name, by
    // mistake, has a name that decides for the one that started first: "" of the later one, with a ' of the earlier
    // one. At most some 1000; what is left keeps the descriptor readable.
    std::vector<pair_news> take();

private:
    struct state;
    explicit pair_port(std::unique_ptr<state> s);
    std::unique_ptr<state> state_;
};

}  // namespace plcgw
