// Samples of our topics as JSON, with the names of the IDL; and requests from it.
#pragma once

#include <nlohmann/json.hpp>

#include <messagesPubSubTypes.h>
#include <registersPubSubTypes.h>

namespace fast_dds {

using json = nlohmann::ordered_json;

json fields(const plcgw::v1::RegisterBlock& sample);
json fields(const plcgw::v1::Point& sample);
json fields(const plcgw::v1::PortStatus& sample);
json fields(const plcgw::v1::DeviceStatus& sample);
json fields(const plcgw::v1::GatewayStatus& sample);
json fields(const plcgw::v1::Event& sample);
json fields(const plcgw::v1::SerialMessage& sample);
json fields(const plcgw::v1::WriteReply& sample);

// Fields that are missing are 0 or empty. Throws nlohmann::json::exception.
void fill(plcgw::v1::WriteRequest& request, const json& from);
void fill(plcgw::v1::PointWriteRequest& request, const json& from);
void fill(plcgw::v1::SerialSendRequest& request, const json& from);

}  // namespace fast_dds
