// A station that answers everything, but later than its response timeout. DECISIONS.md: a late answer is never stored
// for another address, whatever the line makes of it.
#include "bridge/routes/client_line.hpp"
#include "tests/support/plc_fixture.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

#include <deque>

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace plcgw::test;

namespace {

constexpr unit_id unit{1};
constexpr std::uint16_t addresses[] = {100, 200, 300, 400};  // of the station's registers and of the PLC's D devices

// The serial line's loop in virtual time, and a station whose registers hold their own addresses.
class slow_line : public fx3u_fixture {
public:
    slow_line(duration delay, unsigned retries, duration period, bool one_by_one)
        : delay_(delay), one_by_one_(one_by_one), timing_{.format = {}, .response_timeout = 500ms, .retries = retries},
          routes_("bus", {{"slow", unit, timing_}}, {.longest_silence = 10s})
    {
        for (const std::uint16_t at : addresses)
            routes_.add_route(route_to(("D" + std::to_string(at)).c_str(), table::holding_registers, at, 2), 0, period);
        routes_.start(t0);
    }

    void run(duration how_long)
    {
        for (const time_point until = now_ + how_long; now_ < until;) {
            if (const auto question = routes_.next(now_))
                exchange(*question);
            else if (const auto late = next_answer(routes_.wake_at(now_)))
                free_from_ = now_ + frame_gap(timing_.format);  // it belongs to nobody
        }
    }

    // Devices that hold a value of another address.
    int wrong() const
    {
        int count = 0;
        for (const std::uint16_t at : addresses) {
            const std::uint16_t value = word(("D" + std::to_string(at)).c_str());
            count += value != 0 && value != at ? 1 : 0;
        }
        return count;
    }

private:
    void exchange(const client_line::question& q)
    {
        serial_transaction t(unit_of(q.unit), q.request(), q.timing, free_from_, now_);
        for (;;) {
            const auto action = t.next(now_);
            if (std::holds_alternative<serial_transaction::done>(action))
                break;
            if (std::holds_alternative<serial_transaction::send>(action)) {
                t.sent(now_);
                free_ = (one_by_one_ ? std::max(now_, free_) : now_) + delay_;
                on_their_way_.push_back({free_, answer_to(std::get<read_table>(q.request()))});
            }
            else if (const auto late = next_answer(std::get<serial_transaction::wait>(action).until)) {
                t.feed(now_, *late);
            }
        }
        free_from_ = t.line_free_from();
        const unanswered_requests late{t.unanswered(), t.unanswered_since()};
        if (t.outcome())
            routes_.answered(q, *t.outcome(), now_, wall_time{1}, late);
        else
            routes_.failed(q, t.outcome().error(), now_, late);
    }

    // Lets time pass until the next bytes or the deadline.
    std::optional<buffer> next_answer(time_point deadline)
    {
        if (on_their_way_.empty() || on_their_way_.front().at > deadline) {
            now_ = deadline;
            return std::nullopt;
        }
        now_ = on_their_way_.front().at;
        const buffer adu = on_their_way_.front().adu;
        on_their_way_.pop_front();
        return adu;
    }

    static buffer answer_to(const read_table& asked)
    {
        registers_read values;
        for (unsigned i = 0; i < asked.count; ++i)
            values.values.push_back(static_cast<std::uint16_t>(number(asked.first) + i));
        return encode_rtu({unit, encode_response(asked, values)});
    }

    struct answer {
        time_point at;
        buffer adu;
    };

    duration delay_;
    bool one_by_one_;  // reads its next request when it has answered the one before
    time_point free_ = t0;
    serial_options timing_;
    client_line routes_;
    time_point now_ = t0;
    time_point free_from_ = t0;
    std::deque<answer> on_their_way_;
};

}  // namespace

TEST_CASE("slow station: a late answer is never stored for another address")
{
    for (const bool one_by_one : {false, true})
        for (const duration period : {200ms, 1000ms})
            for (unsigned retries = 0; retries <= 2; ++retries)
                for (const duration delay : {20ms, 450ms, 550ms, 700ms, 950ms, 1050ms, 1300ms, 1600ms}) {
                    CAPTURE(one_by_one);
                    CAPTURE(period);
                    CAPTURE(retries);
                    CAPTURE(delay);
                    slow_line line(delay, retries, period, one_by_one);
                    int wrong = 0;
                    for (int second = 0; second < 60; ++second) {
                        line.run(1s);
                        wrong = std::max(wrong, line.wrong());
                    }
                    CHECK(wrong == 0);
                }
}

TEST_SUITE_END();
