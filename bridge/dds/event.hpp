// What a subscriber hears: registers, a gateway's status, what happened, or that there is nobody left who writes them.
#pragma once

#include "bridge/dds/gateway_status.hpp"
#include "bridge/line_event.hpp"
#include "bridge/link_status.hpp"
#include "bridge/points/point.hpp"
#include "bridge/sample.hpp"
#include "bridge/serial_message.hpp"

#include <cstdint>
#include <string>
#include <variant>

namespace plcgw {

struct received_block {
    std::string gateway;
    std::string member;  // which process wrote it
    std::uint64_t seq{};
    std::uint16_t code{};  // quality as sent: QUALITY_* of registers.idl, or a code of a later version
    sample value;
};

struct received_point {
    std::string gateway;
    std::string member;
    std::uint64_t seq{};
    std::uint16_t code{};  // quality as sent
    std::string name;
    point_value value;
    quality state{};
    wall_time source{};
    std::string unit;
};

struct received_status {
    dds_identity who;
    gateway_status status;
    std::uint64_t beat{};
};

struct received_message {
    std::string gateway;
    std::string member;
    std::uint64_t seq{};
    serial_message value;
};

struct received_port {
    std::string gateway;
    std::string member;
    port_status status;
};

struct received_device {
    std::string gateway;
    std::string member;
    device_status status;
};

// Something that a gateway has to say.
struct received_event {
    std::string gateway;
    std::string member;
    std::uint64_t id{};
    wall_time when{};
    line_event::severity level{};
    std::string code;
    std::string subject;
    std::string text;
};

enum class gone_reason : std::uint8_t {
    disposed,     // the route went away
    writer_lost,  // the gateway ended, or was not heard for its lease: the last values are old
};

struct gone_block {
    std::string gateway;
    std::string route;
    std::string area;
    std::uint32_t first{};
    gone_reason reason{};
};

struct gone_point {
    std::string gateway;
    std::string name;
    gone_reason reason{};
};

struct gone_port {
    std::string gateway;
    std::string port;
    gone_reason reason{};
};

struct gone_device {
    std::string gateway;
    std::string device;
    gone_reason reason{};
};

struct gone_gateway {
    std::string gateway;
    std::string member;
    gone_reason reason{};
};

using dds_event =
    std::variant<received_block, received_point, received_status, received_port, received_device, received_message,
                 received_event, gone_block, gone_point, gone_port, gone_device, gone_gateway>;

}  // namespace plcgw
