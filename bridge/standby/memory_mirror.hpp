// The memories of the simulated PLCs in chunks: which of them changed since they were said, and what the other member's
// mean for ours.
#pragma once

#include "bridge/plc/simulated_plc.hpp"
#include "bridge/standby/pair_mirror.hpp"

#include <optional>
#include <set>

namespace plcgw {

class memory_mirror {
public:
    void add(plc::simulated_plc& plc) { plcs_.push_back(&plc); }

    // Special devices are not part of it: each PLC shows its own state there.
    void memory_changed(const plc::simulated_plc& plc, const plc::change& changed);
    void say_everything();  // but chunks that have always been zero: so the memory begins

    std::optional<memory_chunk> next();  // one that changed

    // Bits of our memory that we know better: by register of the chunk.
    using own_bits = std::vector<std::uint16_t>;

    // False when there is no such place here: the members are configured differently.
    bool apply(const memory_chunk& chunk, const own_bits& own);

    static std::size_t chunk_of(std::size_t bit) { return bit / 16 / memory_chunk::size; }

private:
    struct key {
        std::size_t plc{};
        std::size_t area{};
        std::size_t chunk{};
        auto operator<=>(const key&) const = default;
    };
    static bool is_special(const plc::simulated_plc& plc, std::size_t area);
    static std::size_t registers_in(const plc::simulated_plc& plc, std::size_t area);
    memory_chunk read(const key& where) const;

    std::vector<plc::simulated_plc*> plcs_;
    std::set<key> changed_;
    std::set<key> used_;  // changed once at least
};

}  // namespace plcgw
