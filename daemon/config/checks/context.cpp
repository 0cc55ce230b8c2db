#include "daemon/config/checks/context.hpp"

#include "daemon/config/reader.hpp"

namespace plcgw::config {

std::string item(const char* list, std::size_t index, const char* key)
{
    std::string pointer = std::string("/") + list + "/" + std::to_string(index);
    return key == nullptr ? pointer : pointer + "/" + key;
}

check_context::check_context(const gateway_config& c, const located_json& file, const std::string& folder_of_file,
                             mistakes& found)
    : config(c), folder(folder_of_file), plcs(c.plcs), lines(c.lines), stations(c.stations), file_(file), found_(found)
{
    for (const mistake& each : found)
        unread_.insert(each.pointer);
}

void check_context::complain(const std::string& at, std::string what, mistake::weight how)
{
    found_.push_back({at, file_.line_of(at), std::move(what), how});
}

bool check_context::is_sound(const std::string& row) const
{
    const auto inside = unread_.lower_bound(row + "/");
    return !unread_.contains(row) && (inside == unread_.end() || !inside->starts_with(row + "/"));
}

const plc_config* check_context::plc(const std::string& name, const std::string& at)
{
    return find("plcs", plcs, "PLC", name, at);
}

const line_config* check_context::line(const std::string& name, const std::string& at)
{
    return find("lines", lines, "line", name, at);
}

const station_config* check_context::station(const std::string& name, const std::string& at)
{
    return find("stations", stations, "station", name, at);
}

const plc::model* check_context::model_of(const std::string& plc) const
{
    const plc_config* const owner = plcs.find(plc);
    return owner == nullptr ? nullptr : plc::find_model(owner->model);
}

template <class Row>
const Row* check_context::find(const char* list, const name_index<Row>& rows, const char* what, const std::string& name,
                               const std::string& at)
{
    if (const Row* const found = rows.find(name))
        return found;
    const std::vector<std::string> known = rows.names();
    const bool nameless = rows.find("") != nullptr;
    if (name.empty() || nameless || (known.empty() && !is_sound(std::string("/") + list)))
        return nullptr;
    const std::string meant = nearest(name, known);
    std::string cure = meant.empty() ? std::string("add it") : "did you mean \"" + meant + "\"?";
    complain(at, "names the " + std::string(what) + " \"" + name + "\", which does not exist: " + cure);
    return nullptr;
}

}  // namespace plcgw::config
