// How doctest shows our values when a check fails.
#pragma once

#include "protocols/bytes.hpp"
#include "protocols/time.hpp"

#include <doctest/doctest.h>

#include <string>

namespace doctest {

template <>
struct StringMaker<const char*> {  // the names of rows
    static String convert(const char* value) { return value; }
};

template <>
struct StringMaker<plcgw::buffer> {
    static String convert(const plcgw::buffer& value)
    {
        constexpr const char* digits = "0123456789ABCDEF";
        std::string text;
        for (const std::uint8_t byte : value)
            text.append({digits[byte >> 4], digits[byte & 0xF], ' '});
        return {text.data(), static_cast<unsigned>(text.size())};
    }
};

template <>
struct StringMaker<plcgw::duration> {
    static String convert(plcgw::duration value) { return toString(value.count()) + " us"; }
};

template <>
struct StringMaker<plcgw::time_point> {
    static String convert(plcgw::time_point value) { return toString(value.time_since_epoch().count()) + " us"; }
};

}  // namespace doctest
