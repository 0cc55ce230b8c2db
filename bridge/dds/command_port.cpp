#include "bridge/dds/command_port.hpp"

#include "bridge/dds/command_wire.hpp"
#include "bridge/dds/entities.hpp"

namespace plcgw {

struct command_port::state {
    dds_identity who;
    dds_entities entities;
    dds_entity_t registers{};  // reader of WriteRequest
    dds_entity_t points{};     // reader of PointWriteRequest
    dds_entity_t messages{};   // reader of SerialSendRequest
    dds_entity_t others{};     // reader of WriteReply
    dds_entity_t replies{};    // writer of WriteReply
    std::uint64_t drops = 0;

    std::string open(const dds_settings& settings);

    template <class Topic>
    bool take_requests(dds_entity_t reader, std::vector<command_news>& news) const
    {
        return take_some<Topic>(reader, [&](const Topic& in) {
            order_request request = received(in);
            if (request.gateway == who.gateway)
                news.emplace_back(std::move(request));
        });
    }
};

// The writer first: who is heard asking shall be able to hear the answer.
std::string command_port::state::open(const dds_settings& settings)
{
    std::string failed = entities.open(settings);
    if (failed.empty())
        failed = entities.add_writer(replies, plcgw_v1_WriteReply_desc, write_reply_topic, event_qos());
    if (failed.empty())
        failed = entities.add_reader(others, plcgw_v1_WriteReply_desc, write_reply_topic, event_qos());
    if (failed.empty())
        failed = entities.add_reader(registers, plcgw_v1_WriteRequest_desc, write_request_topic, request_qos());
    if (failed.empty())
        failed = entities.add_reader(points, plcgw_v1_PointWriteRequest_desc, point_write_request_topic, request_qos());
    if (failed.empty())
        failed =
            entities.add_reader(messages, plcgw_v1_SerialSendRequest_desc, serial_send_request_topic, request_qos());
    return failed;
}

dds_result<command_port> command_port::create(const dds_settings& settings, dds_identity who)
{
    auto made = std::make_unique<state>();
    made->who = std::move(who);
    if (std::string failed = made->open(settings); !failed.empty())
        return dds_error{std::move(failed)};
    return command_port(std::move(made));
}

command_port::command_port(std::unique_ptr<state> s) : state_(std::move(s)) {}
command_port::command_port(command_port&&) noexcept = default;
command_port& command_port::operator=(command_port&&) noexcept = default;
command_port::~command_port() = default;

int command_port::descriptor() const { return state_->entities.descriptor(); }
std::uint64_t command_port::drops() const { return state_->drops; }

std::vector<command_news> command_port::take()
{
    state_->entities.read_wakes();
    std::vector<command_news> news;
    const bool replies = take_some<plcgw_v1_WriteReply>(state_->others, [&](const plcgw_v1_WriteReply& in) {
        order_reply reply = received(in);
        if (reply.gateway == state_->who.gateway && reply.member != state_->who.member)
            news.emplace_back(std::move(reply));
    });
    const bool registers = state_->take_requests<plcgw_v1_WriteRequest>(state_->registers, news);
    const bool points = state_->take_requests<plcgw_v1_PointWriteRequest>(state_->points, news);
    const bool messages = state_->take_requests<plcgw_v1_SerialSendRequest>(state_->messages, news);
    if (replies || registers || points || messages)
        state_->entities.wake();
    return news;
}

void command_port::reply(const order_key& to, const order_outcome& outcome, wall_time done)
{
    const order_reply said{to, state_->who.gateway, state_->who.member, outcome, done};
    plcgw_v1_WriteReply out{};
    fill(out, said);
    if (dds_write(state_->replies, &out) != DDS_RETCODE_OK)
        ++state_->drops;
}

}  // namespace plcgw
