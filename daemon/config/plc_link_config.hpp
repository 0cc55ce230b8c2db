// A station of a PLC link as the configuration has it. Links of the same name are one, in this gateway or in others.
#pragma once

#include "bridge/plc_link.hpp"

#include <string>

namespace plcgw {

struct plc_link_config {
    std::string name;  // of the link
    std::string plc;   // an FP7
    plc_link_station as;
};

}  // namespace plcgw
