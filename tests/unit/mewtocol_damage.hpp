// Each way to damage a frame: a wrong bit, a lost or doubled character, the end cut off.
#pragma once

#include "tests/unit/mewtocol_fake.hpp"

#include <doctest/doctest.h>

namespace plcgw::test {

// Calls try_it for each damaged form.
template <class Try>
void every_wrong_bit(const buffer& good, Try try_it)
{
    for (std::size_t at = 0; at < good.size(); ++at)
        for (unsigned bit = 0; bit < 8; ++bit) {
            buffer damaged = good;
            damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ 1U << bit);
            CAPTURE(at);
            CAPTURE(bit);
            try_it(damaged);
        }
}

template <class Try>
void every_lost_byte(const buffer& good, Try try_it)
{
    for (std::size_t at = 0; at < good.size(); ++at) {
        buffer damaged = good;
        damaged.erase(damaged.begin() + static_cast<std::ptrdiff_t>(at));
        CAPTURE(at);
        try_it(damaged);
    }
}

// One character twice. Of the CR and of the header the second is no damage: nothing stands between the two.
template <class Try>
void every_doubled_byte(const buffer& good, Try try_it)
{
    for (std::size_t at = 1; at + 1 < good.size(); ++at) {
        buffer damaged = good;
        damaged.insert(damaged.begin() + static_cast<std::ptrdiff_t>(at), good[at]);
        CAPTURE(at);
        try_it(damaged);
    }
}

template <class Try>
void every_cut_off(const buffer& good, Try try_it)
{
    for (std::size_t size = 0; size < good.size(); ++size) {
        CAPTURE(size);
        try_it(buffer(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)));
    }
}

template <class Try>
void every_damage(const buffer& good, Try try_it)
{
    every_wrong_bit(good, try_it);
    every_lost_byte(good, try_it);
    every_doubled_byte(good, try_it);
    every_cut_off(good, try_it);
}

}  // namespace plcgw::test
