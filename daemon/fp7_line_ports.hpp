// The COM ports of FP7s that one line stands for: what the line tells them.
#pragma once

#include "bridge/services/fp7_unit.hpp"
#include "daemon/bit_errors.hpp"

#include <vector>

namespace plcgw {

class fp7_line_ports {
public:
    // A null unit is that of no FP7: nobody to tell.
    void add(fp7_unit* unit, unsigned com);

    void note(const bit_errors& wrong);  // each port hears the same line

private:
    struct port {
        fp7_unit* unit;
        unsigned com;
    };
    std::vector<port> ports_;
};

}  // namespace plcgw
