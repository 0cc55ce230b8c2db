// The devices of one simulated PLC, and which of them changed since somebody last asked.
#pragma once

#include "bridge/plc/model.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace plcgw::plc {

// Where a device lives: an area of the model, and its first bit in that area's register image.
struct place {
    std::size_t area{};
    std::size_t bit{};
    bool operator==(const place&) const = default;
};

// Devices whose value changed, as a run of bits in an area's image. Of a bit device it is its bit, of a word device
// all 16.
struct change {
    std::size_t area{};
    std::size_t first_bit{};
    std::size_t count{};  // bits
    bool operator==(const change&) const = default;
};

bool overlaps(const change& changed, place first, std::size_t bits);

// Each area is one image of registers: 16 bit devices, one word device, or half a 32-bit device (low word first) in
// each. So every view that MODBUS and the routes need is a run of bits in one image.
class memory {
public:
    explicit memory(const plc::model& m);

    const plc::model& model() const { return *model_; }

    std::optional<place> find(device d) const;

    // How many registers or bits there are from a place to the end of its area.
    std::size_t bits_from(place p) const;

    // The caller has checked that the run lies within bits_from(p). Bits that only fill up a register of bit devices
    // stay 0, and protected devices stay what the PLC shows in them.
    bool bit(place p) const;
    std::uint16_t word(place p) const;
    void read(place p, std::span<std::uint16_t> words) const;
    void set_bit(place p, bool value);
    void set_word(place p, std::uint16_t value);  // bits of no device stay 0

    // As set_bit() and set_word(), but no sign of life of whoever writes there: what the gateway puts in his place.
    void put_bit(place p, bool value);
    void put_word(place p, std::uint16_t value);

    // Writes count although the value stays the same: for who has to know whether somebody still writes there.
    using watch = std::size_t;
    watch watch_writes(place p, std::size_t bits);
    void end_watch(watch w);                                        // its number may be given again
    bool take_written(watch w);                                     // since the last call
    bool take_written() { return std::exchange(written_, false); }  // any of the watched devices

    // Devices that nobody but the PLC sets: show_word() and show_bit() do, the others pass over them.
    void set_protected(place p, std::size_t bits, bool on);
    bool is_open(place p, std::size_t bits) const;  // anybody may set all of them
    void show_bit(place p, bool value);
    void show_word(place p, std::uint16_t value);  // of a word device or a whole register of bit devices

    std::vector<change> take_changes();  // since the last call, in the order of areas and numbers
    bool has_changes() const { return changed_; }

private:
    struct image {
        std::vector<std::uint16_t> registers;
        std::vector<std::uint16_t> dirty;     // bits that changed
        std::vector<std::uint16_t> writable;  // bits that anybody may set
        std::size_t dirty_begin = 0;          // dirty registers lie in [begin, end)
        std::size_t dirty_end = 0;
        std::vector<std::vector<watch>> watched;  // by register; empty where nobody watches
    };
    struct watched_run {
        place first;
        std::size_t bits{};
        bool written = false;
    };

    static void close(image& of, std::size_t first_bit, std::size_t count);
    void store(image& of, std::size_t index, std::uint16_t value);
    void note_write(place p, std::size_t bits);

    const plc::model* model_;
    std::vector<image> images_;
    std::vector<watched_run> watches_;
    std::vector<watch> ended_watches_;
    bool changed_ = false;
    bool written_ = false;  // some watched device
};

}  // namespace plcgw::plc
