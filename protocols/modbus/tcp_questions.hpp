// The requests that a MODBUS TCP client has under way on one connection: who gets which answer, and which came too
// late. MODBUS Messaging on TCP/IP Implementation Guide V1.0b section 4.4.1.
#pragma once

#include "protocols/modbus/mbap.hpp"
#include "protocols/modbus/response.hpp"
#include "protocols/time.hpp"

#include <map>

namespace plcgw::modbus {

class tcp_questions {
public:
    enum class key : std::uint32_t {};  // of the caller's choice, unique among those under way

    // The ADU to send. Each call takes a new transaction id, so the answer to an earlier attempt is a stranger.
    buffer ask(key who, unit_id unit, const request& question, time_point deadline);

    struct outcome {
        key who{};
        result<response> answer;
    };

    // Strangers (a late answer, another's id or unit) give nothing and are counted.
    std::optional<outcome> take(const tcp_frame& received);
    std::optional<outcome> take_expired(time_point now);  // errc::timed_out
    void forget_all() { open_.clear(); }                  // the connection is gone

    time_point deadline() const;  // of the first to expire; time_point::max() when nothing is under way
    std::size_t size() const { return open_.size(); }
    std::size_t strangers() const { return strangers_; }

private:
    struct open_question {
        key who{};
        unit_id unit{};
        request question;
        time_point deadline{};
    };

    std::map<transaction_id, open_question> open_;
    std::uint16_t last_id_ = 0;
    std::size_t strangers_ = 0;
};

}  // namespace plcgw::modbus
