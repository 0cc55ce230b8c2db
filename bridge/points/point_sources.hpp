// Who fills devices of the PLCs, and what they say of them: routes that read, messages, and copies of other devices.
#pragma once

#include "bridge/plc/simulated_plc.hpp"
#include "bridge/routes/quality.hpp"
#include "protocols/time.hpp"

#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace plcgw {

struct source_state {
    quality state = quality::good;
    wall_time source = wall_time::never;
};

struct device_span {
    const plc::simulated_plc* plc = nullptr;
    plc::place at;
    std::size_t bits{};
};

class point_sources {
public:
    using say = std::function<source_state()>;

    void add(std::string name, const device_span& filled, say state);
    void add_copy(const device_span& from, const device_span& to);  // as many bits

    // The sources whose values stand in these devices, themselves or as copies.
    std::vector<std::uint32_t> find(const device_span& devices) const;

    std::vector<std::uint32_t> named(const std::string& name) const;
    std::size_t size() const { return sources_.size(); }

    // The worst quality and the oldest time of some sources; good and never when there are none.
    source_state of(const std::vector<std::uint32_t>& which) const;

private:
    struct source {
        device_span filled;
        say state;
    };
    struct copied {
        device_span from;
        device_span to;
    };
    using area_key = std::pair<const plc::simulated_plc*, std::size_t>;
    struct starts {
        std::multimap<std::size_t, std::uint32_t> by_first;
        std::size_t longest = 0;
    };

    void find(const device_span& devices, unsigned copies_left, std::vector<std::uint32_t>& found) const;

    std::vector<source> sources_;
    std::vector<copied> copies_;
    std::map<area_key, starts> areas_;
    std::unordered_multimap<std::string, std::uint32_t> by_name_;
};

}  // namespace plcgw
