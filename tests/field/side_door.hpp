// The same registers over MODBUS TCP on 127.0.0.1: through it a test reads and sets what a device holds.
#pragma once

#include "tests/field/modbus_handles.hpp"
#include "tests/field/posix.hpp"

#include <functional>
#include <poll.h>
#include <vector>

namespace plcgw::field {

class side_door {
public:
    explicit side_door(int port);

    void watch(std::vector<pollfd>& watched) const;  // adds one row for new clients and one for each client
    void serve(std::span<const pollfd> rows, const std::function<modbus_mapping_t&()>& registers);

private:
    bool answer(const unique_fd& client, const std::function<modbus_mapping_t&()>& registers);

    modbus_context context_;
    unique_fd listener_;
    std::vector<unique_fd> clients_;
};

}  // namespace plcgw::field
