// Who is asked, and in which of the two protocols: how a block becomes conversations. For block_transaction.
#pragma once

#include "protocols/mewtocol/block.hpp"
#include "protocols/mewtocol/conversation.hpp"
#include "protocols/mewtocol/mewtocol7_conversation.hpp"

namespace plcgw::mewtocol {

struct com_client {
    using conversation_type = conversation;
    struct step {
        header head{};
        command what;
    };
    static constexpr bool tells_late_answers = false;

    station_id station{};
    headers which = headers::automatic;

    bool asks_one() const { return is_server_number(station); }
    std::optional<std::vector<step>> plan(const block& b) const
    {
        auto made = mewtocol::plan(b, which);
        if (!made)
            return std::nullopt;
        std::vector<step> steps;
        for (command& each : made->commands)
            steps.push_back({made->head, std::move(each)});
        return steps;
    }
    conversation begin(const step& s) { return {s.head, station, s.what}; }
    void ended(const conversation&) {}
    static response as_response(response answer) { return answer; }
};

struct com7_client {
    using conversation_type = mewtocol7::conversation;
    using step = mewtocol7::command;
    static constexpr bool tells_late_answers = true;  // by their frame number

    mewtocol7::station_id station{};
    const mewtocol7::dialect& dialect;
    std::uint8_t& next_number;  // of all frames on this line

    bool asks_one() const { return mewtocol7::is_server_number(station); }
    std::optional<std::vector<step>> plan(const block& b) const { return mewtocol::plan(b, dialect); }
    mewtocol7::conversation begin(const step& s) { return {station, s, next_number, dialect}; }
    void ended(const mewtocol7::conversation& c) { next_number = c.next_number(); }
    static response as_response(mewtocol7::response answer) { return mewtocol::as_response(std::move(answer)); }
};

}  // namespace plcgw::mewtocol
