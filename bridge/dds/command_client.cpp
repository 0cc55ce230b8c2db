#include "bridge/dds/command_client.hpp"

#include "bridge/dds/command_wire.hpp"
#include "bridge/dds/entities.hpp"

namespace plcgw {

struct command_client::state {
    dds_entities entities;
    dds_entity_t registers{};  // writer of WriteRequest
    dds_entity_t points{};     // writer of PointWriteRequest
    dds_entity_t messages{};   // writer of SerialSendRequest
    dds_entity_t replies{};    // reader of WriteReply

    std::string open(const dds_settings& settings);

    template <class Topic>
    static bool write(dds_entity_t writer, const order_request& request)
    {
        Topic out{};
        return fill(out, request) && dds_write(writer, &out) == DDS_RETCODE_OK;
    }
};

std::string command_client::state::open(const dds_settings& settings)
{
    std::string failed = entities.open(settings);
    if (failed.empty())
        failed = entities.add_reader(replies, plcgw_v1_WriteReply_desc, write_reply_topic, event_qos());
    if (failed.empty())
        failed = entities.add_writer(registers, plcgw_v1_WriteRequest_desc, write_request_topic, event_qos());
    if (failed.empty())
        failed = entities.add_writer(points, plcgw_v1_PointWriteRequest_desc, point_write_request_topic, event_qos());
    if (failed.empty())
        failed = entities.add_writer(messages, plcgw_v1_SerialSendRequest_desc, serial_send_request_topic, event_qos());
    return failed;
}

dds_result<command_client> command_client::create(const dds_settings& settings)
{
    auto made = std::make_unique<state>();
    if (std::string failed = made->open(settings); !failed.empty())
        return dds_error{std::move(failed)};
    return command_client(std::move(made));
}

command_client::command_client(std::unique_ptr<state> s) : state_(std::move(s)) {}
command_client::command_client(command_client&&) noexcept = default;
command_client& command_client::operator=(command_client&&) noexcept = default;
command_client::~command_client() = default;

int command_client::descriptor() const { return state_->entities.descriptor(); }

bool command_client::send(const order_request& request)
{
    if (std::holds_alternative<point_order>(request.what.what))
        return state::write<plcgw_v1_PointWriteRequest>(state_->points, request);
    if (std::holds_alternative<route_order>(request.what.what))
        return state::write<plcgw_v1_WriteRequest>(state_->registers, request);
    return std::holds_alternative<message_order>(request.what.what) &&
           state::write<plcgw_v1_SerialSendRequest>(state_->messages, request);
}

std::vector<order_reply> command_client::take()
{
    state_->entities.read_wakes();
    std::vector<order_reply> replies;
    const auto add = [&](const plcgw_v1_WriteReply& in) { replies.push_back(received(in)); };
    while (take_some<plcgw_v1_WriteReply>(state_->replies, add)) {
    }
    return replies;
}

}  // namespace plcgw
