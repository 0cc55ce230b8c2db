// Internal to bridge/dds: a participant whose readers wake a descriptor, and writers that a Fast DDS peer can read.
// Ports that both read and write are made of it.
#pragma once

#include "bridge/dds/domain.hpp"

#include <dds/dds.h>

#include <array>
#include <string>

namespace plcgw {

class dds_entities {
public:
    dds_entities();
    ~dds_entities();  // waits for running listeners
    dds_entities(const dds_entities&) = delete;
    dds_entities& operator=(const dds_entities&) = delete;

    // Before the others. Empty when it worked, else why not; so do the others.
    std::string open(const dds_settings& settings);
    std::string add_reader(dds_entity_t& made, const dds_topic_descriptor_t& type, const char* topic, qos_ptr qos);
    std::string add_writer(dds_entity_t& made, const dds_topic_descriptor_t& type, const char* topic, qos_ptr qos);

    int descriptor() const { return descriptor_; }
    void read_wakes() const;
    void wake() const;

private:
    int descriptor_;
    std::unique_ptr<dds_participant> participant_;
    dds_entity_t publisher_{};
    dds_entity_t subscriber_{};
};

// One loan of Cyclone: each valid sample goes to `with`. False when the reader is empty now.
template <class Topic, class Function>
bool take_some(dds_entity_t reader, const Function& with)
{
    constexpr std::size_t most = 64;
    std::array<void*, most> samples{};
    std::array<dds_sample_info_t, most> infos;
    const dds_return_t taken = dds_take(reader, samples.data(), infos.data(), most, most);
    if (taken <= 0)
        return false;
    for (std::size_t i = 0; i < static_cast<std::size_t>(taken); ++i)
        if (infos[i].valid_data)
            with(*static_cast<const Topic*>(samples[i]));
    dds_return_loan(reader, samples.data(), taken);
    return taken == static_cast<dds_return_t>(most);
}

}  // namespace plcgw
