// MODBUS TCP framing: the MBAP header of "MODBUS Messaging on TCP/IP Implementation Guide" V1.0b section 3.1.3.
#pragma once

#include "protocols/errc.hpp"
#include "protocols/modbus/types.hpp"

#include <optional>

namespace plcgw::modbus {

enum class transaction_id : std::uint16_t {};

struct tcp_frame {
    transaction_id id{};
    frame content;
    bool operator==(const tcp_frame&) const = default;
};

inline constexpr std::size_t mbap_size = 7;  // transaction id, protocol id, length, unit id

// Cuts ADUs out of a TCP stream. After an error the stream cannot be trusted any more: close it.
class mbap_framer {
public:
    void feed(bytes received);
    std::optional<result<tcp_frame>> next();                      // nothing yet, a frame, or errc::bad_header
    bool empty() const { return consumed_ == received_.size(); }  // no part of a frame waits for its rest

private:
    buffer received_;
    std::size_t consumed_ = 0;
};

void append_mbap(buffer& to, const tcp_frame& f);

}  // namespace plcgw::modbus
