#include "bridge/services/device_identification.hpp"

#include <algorithm>

namespace plcgw {
namespace {

using modbus::device_identification_read;
using access = modbus::read_device_identification::access;
using objects = std::vector<device_identification_read::object>;

constexpr std::string_view vendor = "plc-gateway";

constexpr std::uint8_t last_basic_object = 0x02;
constexpr std::uint8_t regular_and_one_object = 0x82;  // conformity level
constexpr std::uint8_t more = 0xFF;

constexpr std::size_t header_size = 7;
constexpr std::size_t object_overhead = 2;  // id, length
constexpr std::size_t longest_value = modbus::max_pdu_size - header_size - object_overhead;

// In the order of their ids.
objects all_objects(const plc::simulated_plc& plc, std::string_view revision)
{
    const std::string model(plc.model().name);
    objects all{
        {0x00, std::string(vendor)}, {0x01, model}, {0x02, std::string(revision)}, {0x05, model}, {0x06, plc.name()}};
    for (auto& each : all)
        each.value.resize(std::min(each.value.size(), longest_value));
    return all;
}

}  // namespace

modbus::response identify(const plc::simulated_plc& plc, std::string_view revision,
                          const modbus::read_device_identification& r)
{
    objects known = all_objects(plc, revision);
    if (r.how == access::basic)
        std::erase_if(known, [](const auto& each) { return each.id > last_basic_object; });

    auto next = std::find_if(known.begin(), known.end(), [&](const auto& each) { return each.id == r.first_object; });
    device_identification_read answer{r.how, regular_and_one_object, 0, 0, {}};
    if (r.how == access::one_object) {
        if (next == known.end())
            return modbus::exception_code::illegal_data_address;
        answer.objects.push_back(*next);
        return answer;
    }
    if (next == known.end())
        next = known.begin();  // an unknown object restarts the stream at the first one
    std::size_t room = modbus::max_pdu_size - header_size;
    for (; next != known.end(); ++next) {
        const std::size_t size = object_overhead + next->value.size();
        if (size > room) {
            answer.more_follows = more;
            answer.next_object = next->id;
            break;
        }
        room -= size;
        answer.objects.push_back(std::move(*next));
    }
    return answer;
}

}  // namespace plcgw
