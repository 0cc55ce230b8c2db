// One unit on a serial line, served by libmodbus (RTU).
#pragma once

#include "tests/field/modbus_handles.hpp"
#include "tests/field/posix.hpp"

#include <string>

namespace plcgw::field {

class line_server {
public:
    line_server(const std::string& port, int baud, int unit);

    int fd() const { return fd_.get(); }
    request receive();  // call it when bytes wait; empty if they are no request to this unit
    bool reply(request to, modbus_mapping_t& registers);  // false if no answer went out, as to a broadcast
    void serve_without_reply(request to, modbus_mapping_t& registers);  // as if the transmitter were broken

private:
    void renew_context();
    void discard_until_silence();

    std::string port_;
    int baud_;
    int unit_;
    modbus_context context_;
    unique_fd fd_;
    unique_fd nowhere_;
    request_buffer room_{};
};

}  // namespace plcgw::field
