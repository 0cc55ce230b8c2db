// Requests that are no routes: of MODBUS TCP clients and of the PLCs' own programs to the stations of a line. The
// askers take turns; reads of several askers that overlap become one.
#pragma once

#include "bridge/routes/forward_reads.hpp"
#include "protocols/modbus/answer_fault.hpp"
#include "protocols/modbus/serial_transaction.hpp"

#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace plcgw {

enum class forward_ticket : std::uint64_t {};
enum class forward_asker : std::uint64_t { nobody = 0 };  // a client's connection, or a PLC's program

struct forward_request {
    forward_ticket ticket{};
    station_number unit;
    modbus::request request;                       // also to a MEWTOCOL station: its line translates
    std::optional<modbus::serial_options> timing;  // of the station or the line, if absent
    bool alone = false;                            // joined with others it was refused
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
    explicit forward_queue(duration cache_age = {}) : cache_(cache_age) {}

    // Nothing when as many wait already, of this asker or of all: exception 06, server device busy.
    std::optional<forward_ticket> add(forward_asker asker, station_number unit, modbus::request request,
                                      std::optional<modbus::serial_options> timing);

    bool empty() const { return waiting_ == 0; }

    // What may become of a request that waits: it goes, it waits until then, or it fails at once.
    struct verdict {
        time_point not_before{};
        std::optional<errc> failed;
    };
    using judge = std::function<verdict(const forward_request&)>;

    // Drops those that fail, or whose values are known. Then: when the first of the others may go; max() = none waits.
    time_point look(time_point now, const judge& what_of);

    // The next in turn that may go now, with others that ask the same: they are under way from now on.
    std::optional<forward_request> take(time_point now, const judge& what_of);

    // Of a request that was taken. Dropped for an asker who has left meanwhile.
    void answer(forward_ticket ticket, result<modbus::response> response, time_point now);
    void answer_all(errc why);

    // Somebody read or wrote this beside the queue, or may have written.
    void heard(station_number unit, const modbus::request& asked, const modbus::response& answer, time_point asked_at,
               time_point now);
    void forget(station_number unit, time_point now) { cache_.forget(unit, now); }

    // Its asker has left: it is not taken any more, or, if it was, not repeated.
    void cancel(forward_ticket ticket);

    // Somebody waits for the answer of this request, which was taken.
    bool is_wanted(forward_ticket ticket) const;

    void note_fault(forward_ticket ticket, const modbus::answer_fault& why);

    std::vector<forward_answer> take_answers() { return std::exchange(answers_, {}); }
    std::vector<forward_fault> take_faults() { return std::exchange(faults_, {}); }

private:
    struct asker_queue {
        forward_asker asker{};
        std::deque<forward_request> waiting;
    };
    struct group {
        station_number unit;
        time_point asked_at{};
        modbus::request asked;
        std::vector<forward_request> members;  // those who want the answer
    };

    void join(group& with);
    void answer_one(const forward_request& to, result<modbus::response> response)
    {
        answers_.push_back({to.ticket, std::move(response)});
    }
    asker_queue& queue_of(forward_asker asker);
    void ask_alone(std::vector<forward_request> members);

    std::deque<asker_queue> askers_;  // the first is next in turn
    std::size_t waiting_ = 0;
    std::map<forward_ticket, group> under_way_;
    read_cache cache_;
    std::vector<forward_answer> answers_;
    std::vector<forward_fault> faults_;
    std::uint64_t last_ = 0;
};

}  // namespace plcgw
