// Devices of the PLCs that are published as blocks, whoever writes them.
#pragma once

#include "bridge/plc_block.hpp"
#include "daemon/config/config.hpp"
#include "daemon/dds_link.hpp"
#include "daemon/message_line.hpp"
#include "daemon/running_line.hpp"

namespace plcgw {

class published_blocks {
public:
    using client_lines = std::vector<std::unique_ptr<running_line>>;
    using message_lines = std::vector<std::unique_ptr<message_line>>;

    // The lines are asked for the quality of what they fill.
    published_blocks(const client_lines& lines, const message_lines& messages, dds_link& dds)
        : lines_(lines), messages_(messages), dds_(dds)
    {
    }

    void add(const block_config& from, plc::simulated_plc& plc);

    void memory_changed(const plc::simulated_plc& plc, const plc::change& changed);
    void qualities_changed();  // a route's quality is that of the block over its devices, too
    void say_everything();
    void keep_silences(time_point now, duration longest);  // what was not said for so long is due again
    void publish();                                        // those that changed

    struct found {
        const plc_block* block = nullptr;  // null: there is none of that name
        bool writable = false;
    };
    found find(const std::string& name) const;

private:
    struct row {
        plc_block content;
        bool writable = false;
        bool changed = true;
        quality said = quality::good;
        time_point said_at{};
    };

    sample sample_now(const row& block) const;

    std::vector<row> rows_;
    const client_lines& lines_;
    const message_lines& messages_;
    dds_link& dds_;
};

}  // namespace plcgw
