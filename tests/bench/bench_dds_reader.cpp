#include "tests/bench/bench_dds_reader.hpp"

#include "bridge/dds/bounded_string.hpp"
#include "registers.h"

#include <array>

namespace plcgw::bench {
namespace {

constexpr std::size_t at_once = 256;

// Calls `note` with each valid sample of the reader until it is empty.
template <class Sample, class Note>
void take_all(dds_entity_t from, Note note)
{
    std::array<void*, at_once> samples{};
    std::array<dds_sample_info_t, at_once> infos{};
    for (;;) {
        const dds_return_t count = dds_take(from, samples.data(), infos.data(), at_once, at_once);
        if (count <= 0)
            return;
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
            if (infos[i].valid_data)
                note(*static_cast<const Sample*>(samples[i]));
        dds_return_loan(from, samples.data(), count);
    }
}

}  // namespace

reader::reader(const dds_settings& settings) : parts_(settings)
{
    dds_listener_t* listener = dds_create_listener(this);
    dds_lset_data_available(listener,
                            [](dds_entity_t from, void* self) { static_cast<reader*>(self)->take_points(from); });
    parts_.make_reader(plcgw_v1_Point_desc, topic_name(dds_topic::point), listener);
    dds_lset_data_available(listener,
                            [](dds_entity_t from, void* self) { static_cast<reader*>(self)->take_blocks(from); });
    parts_.make_reader(plcgw_v1_RegisterBlock_desc, topic_name(dds_topic::register_block), listener);
    dds_delete_listener(listener);
}

reader::~reader() { parts_.close(); }  // waits for the listeners, which use the other members

void reader::take_points(dds_entity_t from)
{
    std::uint64_t taken = 0;
    take_all<plcgw_v1_Point>(from, [&](const plcgw_v1_Point&) { ++taken; });
    const std::lock_guard lock(mutex_);
    points_ += taken;
}

void reader::take_blocks(dds_entity_t from)
{
    take_all<plcgw_v1_RegisterBlock>(from, [&](const plcgw_v1_RegisterBlock& block) {
        const std::int64_t at = monotonic_ns();
        const std::lock_guard lock(mutex_);
        heard_.push_back({std::string(read_string(block.route)),
                          block.words._length == 0 ? std::uint16_t{0} : block.words._buffer[0], block.source_ns, at});
    });
}

nlohmann::json reader::report()
{
    std::vector<heard_block> heard;
    std::uint64_t points = 0;
    {
        const std::lock_guard lock(mutex_);
        heard.swap(heard_);
        std::swap(points, points_);
    }
    nlohmann::json listed = nlohmann::json::array();
    for (const heard_block& each : heard)
        listed.push_back({each.route, each.value, each.source_ns, each.at_ns});
    return {{"points", points}, {"blocks", heard.size()}, {"heard", std::move(listed)}};
}

}  // namespace plcgw::bench
