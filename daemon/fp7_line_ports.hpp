// The COM ports of FP7s that one line stands for: what the line tells them.
#pragma once

#include "bridge/services/fp7_unit.hpp"
#include "daemon/bit_errors.hpp"
#include "protocols/errc.hpp"

#include <vector>

namespace plcgw {

class fp7_line_ports {
public:
    // A null unit is that of no FP7: nobody to tell.
    void add(fp7_unit* unit, unsigned com);

    bool empty() const { return ports_.empty(); }

    // Each port hears the same line.
    void note(const bit_errors& wrong);
    void note(plc::receive_error what);
    void note(plc::setting_error what);
    void note(errc why);  // a message or frame was dropped; nothing for what PMGET has no bit for

    void show(const com_state& state);
    void sends(time_point until);
    void copied();
    void reset_done();

private:
    struct port {
        fp7_unit* unit;
        unsigned com;
    };
    std::vector<port> ports_;
};

}  // namespace plcgw
