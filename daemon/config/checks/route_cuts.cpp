#include "daemon/config/checks/route_cuts.hpp"

#include "bridge/routes/command_cuts.hpp"
#include "daemon/station_reading.hpp"

namespace plcgw::config {

mewtocol::block block_of(const route_config& r, const mewtocol::device& first, direction way)
{
    const bool is_read = way == direction::read;
    if (const auto* const contact = std::get_if<mewtocol::contact>(&first))
        return is_read ? mewtocol::block{mewtocol::read_run{*contact, r.count}}
                       : mewtocol::block{mewtocol::write_run{*contact, std::vector<bool>(r.count)}};
    const auto& [area, number] = std::get<mewtocol::word_device>(first);
    return is_read ? mewtocol::block{mewtocol::read_words{area, number, r.count}}
                   : mewtocol::block{mewtocol::write_words{area, number, std::vector<std::uint16_t>(r.count)}};
}

std::vector<std::size_t> cuts_of(const route_config& r, const line_config* line, direction way)
{
    const auto first =
        line == nullptr || !is_mewtocol(line->protocol) ? std::nullopt : mewtocol::parse_device(r.source);
    if (!first)
        return {};
    const std::size_t bits_of_item = mewtocol::is_contact(*first) ? 1 : 16;
    std::vector<std::size_t> cuts = command_cuts(reading_of(*line, {}).bus, block_of(r, *first, way));
    for (std::size_t& each : cuts)
        each *= bits_of_item;
    return cuts;
}

}  // namespace plcgw::config
