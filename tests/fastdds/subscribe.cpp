#include "tests/fastdds/subscribe.hpp"

#include "tests/fastdds/samples.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <functional>
#include <iostream>
#include <map>
#include <thread>

namespace fast_dds {
namespace {

using namespace plcgw::v1;
using eprosima::fastdds::dds::DataReader;
using eprosima::fastdds::dds::SampleInfo;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::types::ReturnCode_t;

using keys = std::vector<const char*>;

// Prints what has come since the last call.
template <class PubSubType>
class subscription {
public:
    subscription(participant& in, std::string topic, topic_kind kind, keys key)
        : topic_(std::move(topic)), key_(std::move(key)), reader_(in.reader<PubSubType>(topic_, kind))
    {
    }

    void operator()()
    {
        typename PubSubType::type sample;
        SampleInfo info;
        while (reader_->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK)
            info.valid_data ? alive(sample, info) : disposed(info);
        count_writers();
    }

private:
    void alive(const typename PubSubType::type& sample, const SampleInfo& info)
    {
        const json all = fields(sample);
        json& key = key_of_[info.instance_handle];
        for (const char* each : key_)
            key[each] = all.at(each);
        print("alive", all);
    }

    // What else may end an instance, its writers' end, Fast DDS 2.9 does not tell by a sample. A late joiner also gets
    // disposals of what it never had.
    void disposed(const SampleInfo& info)
    {
        const auto known = key_of_.find(info.instance_handle);
        if (known != key_of_.end() && info.instance_state == eprosima::fastdds::dds::NOT_ALIVE_DISPOSED_INSTANCE_STATE)
            print("disposed", known->second);
    }

    void count_writers()
    {
        eprosima::fastdds::dds::SubscriptionMatchedStatus matched;
        if (reader_->get_subscription_matched_status(matched) == ReturnCode_t::RETCODE_OK &&
            matched.current_count != writers_) {
            writers_ = matched.current_count;
            std::cout << json{{"topic", topic_}, {"writers", writers_}}.dump() << std::endl;
        }
    }

    void print(const char* instance, const json& more)
    {
        json line = {{"topic", topic_}, {"instance", instance}};
        line.update(more);
        std::cout << line.dump(-1, ' ', false, json::error_handler_t::replace) << std::endl;
    }

    std::string topic_;
    keys key_;
    DataReader* reader_;
    std::int32_t writers_ = 0;
    std::map<InstanceHandle_t, json> key_of_;  // Fast DDS 2.9 cannot say what key a handle has
};

using taker = std::function<void()>;

template <class PubSubType>
std::function<taker(participant&)> topic(const char* name, topic_kind kind, keys key = {})
{
    return [=](participant& in) { return subscription<PubSubType>(in, name, kind, key); };
}

struct topic_row {
    std::string name;
    std::function<taker(participant&)> subscribe;
};

const std::vector<topic_row>& table()
{
    constexpr auto state = topic_kind::state;
    constexpr auto event = topic_kind::event;
    static const std::vector<topic_row> rows = {
        {"RegisterBlock",
         topic<RegisterBlockPubSubType>("RegisterBlock", state, {"gateway", "route", "area", "first"})},
        {"Point", topic<PointPubSubType>("Point", state, {"gateway", "name"})},
        {"PortStatus", topic<PortStatusPubSubType>("PortStatus", state, {"gateway", "port"})},
        {"DeviceStatus", topic<DeviceStatusPubSubType>("DeviceStatus", state, {"gateway", "device"})},
        {"GatewayStatus", topic<GatewayStatusPubSubType>("GatewayStatus", state, {"gateway", "member"})},
        {"Event", topic<EventPubSubType>("Event", event)},
        {"SerialMessage", topic<SerialMessagePubSubType>("SerialMessage", event)},
        {"WriteReply", topic<WriteReplyPubSubType>("WriteReply", event)},
    };
    return rows;
}

}  // namespace

const std::vector<std::string>& subscribed_topics()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const auto& row : table())
            all.push_back(row.name);
        return all;
    }();
    return names;
}

void subscribe(const settings& where, const std::vector<std::string>& topics, const volatile std::sig_atomic_t& stop)
{
    participant in(where);
    std::vector<taker> takers;
    for (const auto& row : table())
        if (std::find(topics.begin(), topics.end(), row.name) != topics.end())
            takers.push_back(row.subscribe(in));
    while (!stop) {
        for (const auto& take : takers)
            take();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

}  // namespace fast_dds
