// One exchange of a general-purpose line in virtual time: the question is Q and CR.
#pragma once

#include "protocols/general_purpose/exchange.hpp"
#include "tests/support/messages.hpp"

namespace plcgw::test {

using namespace plcgw::general_purpose;

inline constexpr message_form cr{start_code::none, end_code::cr, {}, {}};
inline constexpr message_form quiet{start_code::none, end_code::silence, 50ms, {}};

inline exchange_options usual()
{
    exchange_options o;
    o.format = {10'000, 8, parity::none, 1};  // 1 ms for each character
    o.response_timeout = 100ms;
    o.retries = 1;
    o.silence = 20ms;
    return o;
}

struct bench {
    explicit bench(const exchange_options& options = usual(), const message_form& form = cr,
                   expect answer = expect::message, time_point line_free_from = t0)
        : in(form), ex(in, raw("Q\r"), answer, options, line_free_from, t0)
    {
    }

    void sends(time_point at)
    {
        const auto action = ex.next(at);
        const auto* sending = std::get_if<line_action::send>(&action);
        REQUIRE(sending != nullptr);
        CHECK(text_of(buffer(sending->message.begin(), sending->message.end())) == "Q\r");
        ex.sent(at);
    }

    void waits(time_point at, time_point until)
    {
        const auto action = ex.next(at);
        const auto* waiting = std::get_if<line_action::wait>(&action);
        REQUIRE(waiting != nullptr);
        CHECK(waiting->until == until);
    }

    void ends(time_point at, std::string_view outcome)
    {
        REQUIRE(std::holds_alternative<line_action::done>(ex.next(at)));
        CHECK(text_of(ex.outcome()) == outcome);
    }

    texts others()
    {
        texts all;
        for (const auto& each : ex.take_others())
            all.push_back(text_of(each));
        return all;
    }

    message_framer in;
    exchange ex;
};

}  // namespace plcgw::test
