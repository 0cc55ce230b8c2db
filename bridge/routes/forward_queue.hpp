// Requests that are no routes: of MODBUS TCP clients and of the PLCs' own programs to the stations of a line, in the
// order in which they came.
#pragma once

#include "bridge/routes/station_question.hpp"
#include "protocols/modbus/answer_fault.hpp"
#include "protocols/modbus/response.hpp"
#include "protocols/modbus/serial_transaction.hpp"

#include <deque>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace plcgw {

enum class forward_ticket : std::uint64_t {};

struct forward_request {
    forward_ticket ticket{};
    station_number unit;
    modbus::request request;                       // also to a MEWTOCOL station: its line translates
    std::optional<modbus::serial_options> timing;  // of the station or the line, if absent
};

struct forward_answer {
    forward_ticket ticket{};
    result<modbus::response> response;
};

// One attempt of a request went wrong; others may follow, and its answer will.
struct forward_fault {
    forward_ticket ticket{};
    modbus::answer_fault why;
};

class forward_queue {
public:
    // Nothing when as many wait already: exception 06, server device busy.
    std::optional<forward_ticket> add(station_number unit, modbus::request request,
                                      std::optional<modbus::serial_options> timing)
    {
        constexpr std::size_t longest = 64;
        if (waiting_.size() >= longest)
            return std::nullopt;
        const forward_ticket ticket{++last_};
        waiting_.push_back({ticket, unit, std::move(request), std::move(timing)});
        return ticket;
    }

    bool empty() const { return waiting_.empty(); }

    forward_request take()
    {
        forward_request first = std::move(waiting_.front());
        waiting_.pop_front();
        under_way_.insert(first.ticket);
        return first;
    }

    // Of a request that was taken. Dropped if its asker has left meanwhile.
    void answer(forward_ticket ticket, result<modbus::response> response)
    {
        if (under_way_.erase(ticket) != 0)
            answers_.push_back({ticket, std::move(response)});
    }

    void answer_all(errc why)
    {
        for (; !waiting_.empty(); waiting_.pop_front())
            answers_.push_back({waiting_.front().ticket, make_error_code(why)});
    }

    // Its asker has left: it is not taken any more, or, if it was, not repeated.
    void cancel(forward_ticket ticket)
    {
        std::erase_if(waiting_, [ticket](const forward_request& each) { return each.ticket == ticket; });
        std::erase_if(answers_, [ticket](const forward_answer& each) { return each.ticket == ticket; });
        under_way_.erase(ticket);
    }

    // Somebody waits for the answer of this request, which was taken.
    bool is_wanted(forward_ticket ticket) const { return under_way_.contains(ticket); }

    void note_fault(forward_ticket ticket, modbus::answer_fault why) { faults_.push_back({ticket, std::move(why)}); }

    std::vector<forward_answer> take_answers() { return std::exchange(answers_, {}); }
    std::vector<forward_fault> take_faults() { return std::exchange(faults_, {}); }

private:
    std::deque<forward_request> waiting_;
    std::set<forward_ticket> under_way_;
    std::vector<forward_answer> answers_;
    std::vector<forward_fault> faults_;
    std::uint64_t last_ = 0;
};

}  // namespace plcgw
