// A MEWTOCOL-COM or MEWTOCOL7-COM line, on a serial port or behind a device server: asks its stations for the devices
// of routes, and for those that MODBUS requests of others mean.
#pragma once

#include "daemon/polling_line.hpp"
#include "protocols/mewtocol/block_transaction.hpp"

namespace plcgw {

class mewtocol_line final : public polling_line {
public:
    using polling_line::polling_line;

private:
    asio::awaitable<boost::system::error_code> exchange(client_line::question question) override;

    // Asks the blocks and tells the routes what came.
    template <class Client>
    asio::awaitable<boost::system::error_code> ask(Client client, std::vector<mewtocol::block> blocks,
                                                   const client_line::question& question);

    std::uint8_t next_number_ = 0;  // of MEWTOCOL7 frames
};

// How a station of such a line is asked.
mewtocol::line_options options_of(const modbus::serial_options& timing);

// What has no number on such a line, station_id::none, is not asked.
mewtocol::station_id com_station(station_number n);    // 0: the global station
mewtocol7::station_id com7_station(station_number n);  // there is no global one

}  // namespace plcgw
