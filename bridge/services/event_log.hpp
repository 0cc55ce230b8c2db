// The communication event log of a serial server: FX3 manual 9.5, V1.1b3 section 6.10.
#pragma once

#include "protocols/bytes.hpp"

#include <array>
#include <cstddef>

namespace plcgw {

// The bytes. A receive event is `received` and more bits, a send event `sent` and more bits. On an FX3 the bits 2 to 4
// of a send event (busy, NAK, write timeout) are always 0.
namespace event {

inline constexpr std::uint8_t received = 0x80;
inline constexpr std::uint8_t broadcast = 0x40;
inline constexpr std::uint8_t listening = 0x20;  // listen-only mode at that moment; of a send event too
inline constexpr std::uint8_t overrun = 0x10;
inline constexpr std::uint8_t damaged = 0x02;  // communication error

inline constexpr std::uint8_t sent = 0x40;
inline constexpr std::uint8_t sent_abort = 0x02;           // exception 04
inline constexpr std::uint8_t sent_read_exception = 0x01;  // exceptions 01 to 03

inline constexpr std::uint8_t entered_listen_only = 0x04;
inline constexpr std::uint8_t restarted = 0x00;

}  // namespace event

class event_log {
public:
    static constexpr std::size_t capacity = 64;

    void add(std::uint8_t e)
    {
        newest_ = (newest_ + 1) % capacity;
        events_[newest_] = e;
        size_ += size_ < capacity ? 1 : 0;
    }

    void clear() { size_ = 0; }
    std::size_t size() const { return size_; }

    std::uint8_t operator[](std::size_t age) const { return events_[(newest_ + capacity - age) % capacity]; }

    buffer newest_first() const
    {
        buffer events;
        for (std::size_t age = 0; age < size_; ++age)
            events.push_back((*this)[age]);
        return events;
    }

    // As D110-D142 in 9.5.1: the length, then two events in each register, the newer one in its low byte.
    std::array<std::uint16_t, 33> registers() const
    {
        std::array<std::uint16_t, 33> words{static_cast<std::uint16_t>(size_)};
        for (std::size_t age = 0; age < size_; ++age) {
            const unsigned shift = age % 2 == 0 ? 0 : 8;
            words[1 + age / 2] = static_cast<std::uint16_t>(words[1 + age / 2] | (*this)[age] << shift);
        }
        return words;
    }

private:
    std::array<std::uint8_t, capacity> events_{};
    std::size_t newest_ = 0;
    std::size_t size_ = 0;
};

}  // namespace plcgw
