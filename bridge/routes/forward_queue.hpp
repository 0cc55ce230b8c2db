// Requests that are no routes: of MODBUS TCP clients and of the PLCs' own programs to the stations of a line, in the
// order in which they came.
#pragma once

#include "protocols/modbus/answer_fault.hpp"
#include "protocols/modbus/response.hpp"
#include "protocols/modbus/serial_transaction.hpp"

#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace plcgw {

enum class forward_ticket : std::uint64_t {};

struct forward_request {
    forward_ticket ticket{};
    modbus::unit_id unit{};
    modbus::request request;
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
    std::optional<forward_ticket> add(modbus::unit_id unit, modbus::request request,
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
        return first;
    }

    void answer(forward_ticket ticket, result<modbus::response> response)
    {
        answers_.push_back({ticket, std::move(response)});
    }

    void answer_all(errc why)
    {
        for (; !waiting_.empty(); waiting_.pop_front())
            answer(waiting_.front().ticket, make_error_code(why));
    }

    void note_fault(forward_ticket ticket, modbus::answer_fault why) { faults_.push_back({ticket, std::move(why)}); }

    std::vector<forward_answer> take_answers() { return std::exchange(answers_, {}); }
    std::vector<forward_fault> take_faults() { return std::exchange(faults_, {}); }

private:
    std::deque<forward_request> waiting_;
    std::vector<forward_answer> answers_;
    std::vector<forward_fault> faults_;
    std::uint64_t last_ = 0;
};

}  // namespace plcgw
