#include "daemon/watch_device.hpp"

#include "bridge/plc/memory.hpp"
#include "bridge/plc/model.hpp"
#include "daemon/station_reading.hpp"

namespace plcgw {
namespace {

// The PLC's name may hold dots, a device does not.
struct device_text {
    std::string plc;  // empty: any
    std::string device;
};

device_text parts_of(const std::string& text)
{
    const auto dot = text.rfind('.');
    return dot == std::string::npos ? device_text{{}, text} : device_text{text.substr(0, dot), text.substr(dot + 1)};
}

class names_over {
public:
    names_over(const plc_config& plc, const std::string& device, const gateway_config& config)
        : plc_(plc.name), model_(*plc::find_model(plc.model)), memory_(model_), config_(config)
    {
        if (const auto parsed = plc::parse_device(device, model_.names)) {
            wanted_ = memory_.find(*parsed);
            width_ = plc::is_bit_kind(parsed->kind) ? 1 : 16;
        }
    }

    bool exists() const { return wanted_.has_value(); }

    void add_to(std::set<std::string>& names) const
    {
        for (const route_config& r : config_.routes) {
            const auto head = plc::parse_device(r.device, model_.names);
            const bool bits = r.station.empty() ? head && plc::is_bit_kind(head->kind) : is_bits(place_of(r));
            if (covers(r.plc, r.device, bits ? r.count : std::size_t{16} * r.count))
                names.insert(r.name);
        }
        for (const point_config& p : config_.points)
            if (covers(p.plc, p.device, std::size_t{16} * registers_of(p.type, p.characters)))
                names.insert(p.name);
        for (const block_config& b : config_.dds.blocks) {
            const auto head = plc::parse_device(b.device, model_.names);
            if (head && covers(b.plc, b.device, plc::is_bit_kind(head->kind) ? b.count : std::size_t{16} * b.count))
                names.insert(b.plc + "." + plc::to_string(*head, model_.names));
        }
    }

private:
    bool covers(const std::string& plc, const std::string& device, std::size_t bits) const
    {
        const auto head = plc == plc_ ? plc::parse_device(device, model_.names) : std::nullopt;
        const auto at = head ? memory_.find(*head) : std::nullopt;
        return at && plc::overlaps(plc::change{at->area, at->bit, bits}, *wanted_, width_);
    }

    std::string plc_;
    const plc::model& model_;
    plc::memory memory_;
    const gateway_config& config_;
    std::optional<plc::place> wanted_;
    std::size_t width_ = 16;
};

}  // namespace

std::string filter_by_device(const std::string& text, const std::optional<gateway_config>& config, watch_filter& filter)
{
    const device_text wanted = parts_of(text);
    filter.by_device = true;
    bool exists = false;
    if (config) {
        for (const plc_config& each : config->plcs) {
            if (!wanted.plc.empty() && wanted.plc != each.name)
                continue;
            const names_over names(each, wanted.device, *config);
            exists = exists || names.exists();
            if (names.exists())
                names.add_to(filter.over_device);
        }
        return exists ? "" : "no PLC of the configuration has " + text;
    }
    for (const plc::model* const model : plc::all_models()) {
        const auto device = plc::parse_device(wanted.device, model->names);
        if (!device)
            continue;
        filter.area = plc::to_string(device->kind, model->names);
        filter.number = device->number;
        filter.block_prefix = wanted.plc.empty() ? "" : wanted.plc + ".";
        return {};
    }
    return text + " is no device of a PLC, such as D100, M8, X17 or DT100";
}

}  // namespace plcgw
