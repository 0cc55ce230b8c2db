#include "daemon/config/checks/line_checks.hpp"
#include "daemon/config/mewtocol_fields.hpp"

#include <algorithm>
#include <cctype>

namespace plcgw::config {
namespace {

// Capital letters and digits. Anything else may mean something in a frame.
bool is_text_of_frames(const std::string& text)
{
    return std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) || std::isupper(c); });
}

void check_names(check_context& c, const std::string& at, const std::vector<mewtocol7::device_name>& devices)
{
    for (std::size_t i = 0; i < devices.size(); ++i)
        for (std::size_t other = 0; other < devices.size(); ++other)
            if (i != other && devices[i].name.starts_with(devices[other].name))
                c.complain(at + "/" + dialect_device_keys[i], "is \"" + devices[i].name + "\", which begins like \"" +
                                                                  devices[other].name + "\", the name of another area");
}

}  // namespace

void check_mewtocol(check_context& c, std::size_t i, const line_config& l)
{
    const std::string at = item("lines", i, "mewtocol") + "/dialect";
    const mewtocol7::dialect& d = l.mewtocol.dialect;
    const std::pair<const char*, const std::string*> texts[] = {{"item", &d.item},
                                                                {"scope", &d.scope},
                                                                {"before_words", &d.before_words},
                                                                {"before_error", &d.before_error},
                                                                {"before_piece", &d.before_piece}};
    const auto check_text = [&](const char* key, const std::string& value) {
        if (!is_text_of_frames(value))
            c.complain(at + "/" + key, "is \"" + value + "\", expected capital letters and digits");
    };
    for (const auto& [key, value] : texts)
        check_text(key, *value);
    for (std::size_t row = 0; row < d.devices.size(); ++row)
        check_text(dialect_device_keys[row], d.devices[row].name);
    if (c.is_sound(at))
        check_names(c, at, d.devices);
}

}  // namespace plcgw::config
