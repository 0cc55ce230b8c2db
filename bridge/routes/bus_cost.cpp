#include "bridge/routes/bus_cost.hpp"

#include "bridge/link_time.hpp"

namespace plcgw {
namespace {

constexpr std::size_t mbap_size = 7;
constexpr duration network_byte{1};

duration serial_exchange(const bus_timing& bus, std::size_t request, std::size_t response, duration silence)
{
    return character_time(bus.format, request) + bus.turnaround + character_time(bus.format, response) +
           std::max(bus.gap, silence);
}

// Items of a request whose response depends on them.
std::size_t items_of(const modbus::request& r)
{
    const auto* const read = std::get_if<modbus::read_table>(&r);
    return read == nullptr ? 1 : read->count;
}

duration modbus_exchange(const bus_timing& bus, const modbus::request& asked)
{
    const auto sizes = sizes_of(modbus::function_of(asked), items_of(asked), 1);
    if (!sizes)
        return {};
    const std::size_t request = modbus::encode_request(asked).size();
    if (bus.protocol == bus_protocol::modbus_tcp)
        return static_cast<std::int64_t>(2 * mbap_size + request + sizes->response) * network_byte + bus.turnaround;
    const auto mode = bus.protocol == bus_protocol::modbus_ascii ? plc::framing::ascii : plc::framing::rtu;
    return serial_exchange(bus, adu_size(request, mode), adu_size(sizes->response, mode), frame_gap(bus.format));
}

// Characters of the longest response that a command can get, without what surrounds the text.
std::size_t response_size(const mewtocol::command& c)
{
    if (const auto* const words = std::get_if<mewtocol::read_words>(&c))
        return 3 + 4 * std::size_t{words->count};  // $RD
    if (const auto* const contacts = std::get_if<mewtocol::read_contacts>(&c))
        return 3 + contacts->at.size();
    return 4;
}

std::size_t response_size(const mewtocol7::command& c)
{
    const auto* const words = std::get_if<mewtocol7::read_words>(&c);
    return words == nullptr ? 5 : 5 + 4 * std::size_t{words->count};  // $MMRD
}

duration com_exchange(const bus_timing& bus, const mewtocol::block& asked)
{
    duration sum{};
    const auto plan = mewtocol::plan(asked, bus.headers);
    if (plan)
        for (const mewtocol::command& each : plan->commands)
            sum += serial_exchange(bus, mewtocol::frame_overhead + 1 + mewtocol::encode_command(each).size(),
                                   mewtocol::frame_overhead + response_size(each), character_time(bus.format, 1));
    return sum;
}

duration com7_exchange(const bus_timing& bus, const mewtocol::block& asked)
{
    constexpr std::size_t in_a_frame = mewtocol7::max_frame_size - mewtocol7::frame_overhead;
    duration sum{};
    const auto plan = mewtocol::plan(asked, bus.dialect);
    if (!plan)
        return sum;
    for (const mewtocol7::command& each : *plan) {
        const std::size_t text = response_size(each);
        const std::size_t frames = (text + in_a_frame - 1) / in_a_frame;
        sum += serial_exchange(
                   bus, mewtocol7::frame_overhead * frames + 1 + mewtocol7::encode_command(each, bus.dialect).size(),
                   mewtocol7::frame_overhead * frames + text, character_time(bus.format, 1)) +
               static_cast<std::int64_t>(frames - 1) * bus.turnaround;
    }
    return sum;
}

// Of a question that is one exchange. 0: nobody knows.
std::size_t characters_of_answer(const bus_timing& bus, const station_question& asked)
{
    if (const auto* const request = std::get_if<modbus::request>(&asked)) {
        const auto sizes = sizes_of(modbus::function_of(*request), items_of(*request), 1);
        const auto mode = bus.protocol == bus_protocol::modbus_ascii ? plc::framing::ascii : plc::framing::rtu;
        return sizes ? adu_size(sizes->response, mode) : 0;
    }
    const auto& block = std::get<mewtocol::block>(asked);
    if (bus.protocol == bus_protocol::mewtocol7_com) {
        const auto plan = mewtocol::plan(block, bus.dialect);
        return plan && !plan->empty() ? mewtocol7::frame_overhead + response_size(plan->front()) : 0;
    }
    const auto plan = mewtocol::plan(block, bus.headers);
    return plan && !plan->commands.empty() ? mewtocol::frame_overhead + response_size(plan->commands.front()) : 0;
}

}  // namespace

duration exchange_time(const bus_timing& bus, const station_question& asked)
{
    if (const auto* const request = std::get_if<modbus::request>(&asked))
        return modbus_exchange(bus, *request);
    const auto& block = std::get<mewtocol::block>(asked);
    return bus.protocol == bus_protocol::mewtocol7_com ? com7_exchange(bus, block) : com_exchange(bus, block);
}

duration turnaround_in(const bus_timing& bus, const station_question& asked, duration until_answered)
{
    const duration response = character_time(bus.format, characters_of_answer(bus, asked));
    return std::max(duration{}, until_answered - response);
}

bool is_one_exchange(const bus_timing& bus, const station_question& asked)
{
    if (const auto* const request = std::get_if<modbus::request>(&asked))
        return sizes_of(modbus::function_of(*request), items_of(*request), 1).has_value();
    const auto& block = std::get<mewtocol::block>(asked);
    if (bus.protocol != bus_protocol::mewtocol7_com) {
        const auto plan = mewtocol::plan(block, bus.headers);
        return plan && plan->commands.size() == 1;
    }
    const auto plan = mewtocol::plan(block, bus.dialect);
    return plan && plan->size() == 1 &&
           response_size(plan->front()) <= mewtocol7::max_frame_size - mewtocol7::frame_overhead;
}

}  // namespace plcgw
