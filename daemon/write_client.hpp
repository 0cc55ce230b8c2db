// `plc-gateway read`, `write` and `send`: asks the running gateway of this host over its control socket.
#pragma once

#include <string>
#include <vector>

namespace plcgw {

// Of both ways, socket and DDS. Exit status: 0 done, 1 refused by the gateway or the device, 2 usage, 3 no answer.
struct access_options {
    std::string socket;  // empty: where it usually is
    std::string target;  // or the line of send
    std::vector<std::string> values;
    unsigned count = 1;  // of read; of text its characters
    std::string type;
    std::string order;
    unsigned timeout_ms = 0;  // to begin within; 0: what the gateway thinks
    bool json = false;
};

int read_over_socket(const access_options& o);
int write_over_socket(const access_options& o);
int send_over_socket(const access_options& o);

}  // namespace plcgw
