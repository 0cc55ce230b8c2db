// Internal to bridge/dds: the writers of a publisher, and what it counts.
#pragma once

#include "bridge/dds/domain.hpp"
#include "bridge/dds/publisher.hpp"
#include "registers.h"

#include <dds/dds.h>

#include <array>
#include <map>
#include <tuple>
#include <unordered_map>

namespace plcgw {

struct dds_publisher::state {
    using instance_key = std::tuple<std::string, std::string, std::uint32_t>;  // route, area, first

    dds_settings settings;
    dds_identity who;
    std::unique_ptr<dds_participant> participant;
    std::array<dds_entity_t, dds_topics> writers{};   // 0: the topic is switched off
    std::array<std::uint32_t, dds_topics> refused{};  // readers that did not match, as far as they were told
    std::map<instance_key, std::uint64_t, std::less<>> sequence;
    std::map<std::string, std::uint64_t> messages_of;  // each line
    std::unordered_map<std::string, std::uint64_t> points_of;
    std::uint64_t beat = 0;
    std::uint64_t events = 0;
    std::uint64_t published = 0;
    std::uint64_t drops = 0;
    dds_return_t last_error = DDS_RETCODE_OK;

    dds_entity_t writer_of(dds_topic which) const { return writers[static_cast<std::size_t>(which)]; }

    void write(dds_topic which, const void* sample)
    {
        if (const dds_entity_t writer = writer_of(which); writer != 0)
            count(dds_write(writer, sample));
    }
    void dispose(dds_topic which, const void* key)
    {
        const dds_entity_t writer = writer_of(which);
        if (writer == 0)
            return;
        dds_return_t written = dds_dispose(writer, key);
        if (written == DDS_RETCODE_OK)
            written = dds_unregister_instance(writer, key);  // frees most of the instance's memory
        count(written);
    }
    void count(dds_return_t written)
    {
        if (written == DDS_RETCODE_OK) {
            ++published;
            return;
        }
        ++drops;
        last_error = written;
    }
    plcgw_v1_RegisterBlock keyed(const sample& s) const;
};

}  // namespace plcgw
