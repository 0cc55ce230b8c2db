// Drives an RTU transaction as a serial line would, in virtual time: a script of sends, waits and feeds.
#pragma once

#include "protocols/modbus/serial_transaction.hpp"
#include "tests/support/print.hpp"

namespace plcgw::test {

// The transaction wants this sent now. Tells it that it was.
inline bool sends(modbus::serial_transaction& t, time_point now, const buffer& adu)
{
    const auto action = t.next(now);
    const auto* send = std::get_if<modbus::serial_transaction::send>(&action);
    if (send == nullptr || buffer(send->adu.begin(), send->adu.end()) != adu)
        return false;
    t.sent(now);
    return true;
}

// Until when the transaction waits; nothing when it wants something else.
inline std::optional<time_point> waits(modbus::serial_transaction& t, time_point now)
{
    const auto action = t.next(now);
    const auto* wait = std::get_if<modbus::serial_transaction::wait>(&action);
    return wait == nullptr ? std::nullopt : std::optional(wait->until);
}

inline bool is_done(modbus::serial_transaction& t, time_point now)
{
    return std::holds_alternative<modbus::serial_transaction::done>(t.next(now));
}

}  // namespace plcgw::test
