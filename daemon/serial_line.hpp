// A MODBUS line with one question at a time: RTU or ASCII, on a serial port or behind a device server.
#pragma once

#include "daemon/polling_line.hpp"

namespace plcgw {

class serial_line final : public polling_line {
public:
    using polling_line::polling_line;

private:
    asio::awaitable<boost::system::error_code> exchange(client_line::question question) override;
};

}  // namespace plcgw
