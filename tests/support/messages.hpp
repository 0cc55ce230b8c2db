// Messages of general-purpose lines as text.
#pragma once

#include "protocols/general_purpose/message_framer.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

#include <string>
#include <string_view>

namespace plcgw::test {

using texts = std::vector<std::string>;

inline buffer raw(std::string_view text) { return buffer(text.begin(), text.end()); }

inline std::string text_of(const result<buffer>& event)
{
    return event ? std::string(event->begin(), event->end()) : "! " + event.error().message();
}

inline void drain(general_purpose::message_framer& in, time_point now, texts& into)
{
    while (const auto each = in.next(now))
        into.push_back(text_of(*each));
}

}  // namespace plcgw::test

namespace doctest {

template <>
struct StringMaker<plcgw::test::texts> {
    static String convert(const plcgw::test::texts& all)
    {
        std::string text;
        for (const std::string& each : all)
            text += '[' + each + ']';
        return text.c_str();
    }
};

}  // namespace doctest
