#include "tests/fastdds/request.hpp"

#include "tests/fastdds/samples.hpp"

#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <functional>
#include <iostream>
#include <thread>

namespace fast_dds {
namespace {

using namespace plcgw::v1;
using eprosima::fastdds::dds::DataReader;
using eprosima::fastrtps::types::ReturnCode_t;
using std::chrono::steady_clock;

using sender = std::function<void()>;

template <class PubSubType>
sender make(participant& in, const std::string& topic, const json& content)
{
    typename PubSubType::type request;
    fill(request, content);
    return [=, writer = in.writer<PubSubType>(topic)]() mutable { writer->write(&request); };
}

struct topic_row {
    std::string name;
    sender (*make)(participant&, const std::string&, const json&);
};

const std::vector<topic_row>& table()
{
    static const std::vector<topic_row> rows = {
        {"WriteRequest", make<WriteRequestPubSubType>},
        {"PointWriteRequest", make<PointWriteRequestPubSubType>},
        {"SerialSendRequest", make<SerialSendRequestPubSubType>},
    };
    return rows;
}

// Takes replies, also those to others. True when it printed ours.
bool replied(DataReader& replies, const std::string& client, std::uint64_t id)
{
    WriteReply reply;
    eprosima::fastdds::dds::SampleInfo info;
    while (replies.take_next_sample(&reply, &info) == ReturnCode_t::RETCODE_OK)
        if (info.valid_data && client == reply.client().c_str() && reply.request_id() == id) {
            std::cout << fields(reply).dump() << std::endl;
            return true;
        }
    return false;
}

}  // namespace

const std::vector<std::string>& request_topics()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const auto& row : table())
            all.push_back(row.name);
        return all;
    }();
    return names;
}

bool request(const settings& where, const std::string& topic, const std::string& content, const patience& waits)
{
    const json from = json::parse(content);
    const auto client = from.value("client", std::string());
    const auto id = from.value("request_id", std::uint64_t{});

    participant in(where);
    DataReader* replies = in.reader<WriteReplyPubSubType>("WriteReply", topic_kind::event);
    sender send;
    for (const auto& row : table())
        if (row.name == topic)
            send = row.make(in, topic, from);

    const auto deadline = steady_clock::now() + waits.longest;
    auto next = steady_clock::now();
    while (steady_clock::now() < deadline) {
        if (steady_clock::now() >= next) {
            send();
            next += waits.repeat;
        }
        if (replied(*replies, client, id))
            return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

}  // namespace fast_dds
