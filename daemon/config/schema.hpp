// JSON Schema (draft 2020-12) of the configuration file, for editors: made from fields.hpp and the structs' defaults.
#pragma once

#include <string>

namespace plcgw::config {

std::string schema();  // pretty-printed, as shipped in etc/plc-gateway.schema.json

}  // namespace plcgw::config
