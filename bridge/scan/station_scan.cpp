#include "bridge/scan/station_scan.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr unsigned most_tries = 3;

bool is_printable(char c) { return c >= ' ' && c <= '~'; }

station_place modbus_first(modbus::table of) { return modbus_place{of, modbus::address{0}}; }
station_place contact_first(mewtocol::contact_area of) { return mewtocol::device{mewtocol::contact{of, 0}}; }
station_place word_first(mewtocol::word_area of) { return mewtocol::device{mewtocol::word_device{of, 0}}; }

// A gateway says that nobody is there, V1.1b3 chapter 7.
bool means_nobody(const station_answer& answer)
{
    const auto* const response = std::get_if<modbus::response>(&answer);
    const auto* const code = response == nullptr ? nullptr : std::get_if<modbus::exception_code>(response);
    return code != nullptr && (*code == modbus::exception_code::gateway_path_unavailable ||
                               *code == modbus::exception_code::gateway_target_failed_to_respond);
}

bool is_silence(const boost::system::error_code& why)
{
    return why == errc::timed_out || why == errc::port_absent || why == errc::not_expressible;
}

std::string text_of(const modbus::device_identification_read& read)
{
    std::string text;
    for (const auto& each : read.objects)
        if (!each.value.empty())
            text += (text.empty() ? "" : " ") + printable(each.value);
    return text;
}

// Function 11: what the bytes mean is the maker's. Most put a name in, behind an id and before FF for RUN.
std::string text_of(const modbus::server_id_read& read)
{
    constexpr std::size_t least_name = 3;
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string name;
    std::string hex;
    for (const std::uint8_t each : read.data) {
        if (is_printable(static_cast<char>(each)))
            name += static_cast<char>(each);
        hex += hex.empty() ? "" : " ";
        hex += {digits[each / 16U], digits[each % 16U]};
    }
    return name.size() >= least_name ? name : "server id " + hex;
}

std::string identification_in(const station_answer& answer)
{
    const auto* const response = std::get_if<modbus::response>(&answer);
    if (response == nullptr)
        return {};
    if (const auto* const read = std::get_if<modbus::device_identification_read>(response))
        return text_of(*read);
    if (const auto* const read = std::get_if<modbus::server_id_read>(response))
        return text_of(*read);
    return {};
}

}  // namespace

std::string printable(std::string_view text)
{
    std::string made(text);
    std::replace_if(
        made.begin(), made.end(), [](char c) { return !is_printable(c); }, '.');
    return made;
}

station_scan::station_scan(scan_language language, std::vector<station_number> units)
    : language_(language), units_(std::move(units))
{
}

std::vector<station_scan::step> station_scan::steps_for(scan_language language)
{
    std::vector<step> steps;
    const auto read = [&](const station_place& first) { steps.push_back({read_question(first, 1), first}); };
    if (language == scan_language::mewtocol) {
        read(word_first(mewtocol::word_area::dt));
        read(contact_first(mewtocol::contact_area::internal_relay));
        read(contact_first(mewtocol::contact_area::external_input));
        return steps;
    }
    read(modbus_first(modbus::table::holding_registers));
    steps.push_back(
        {modbus::request{modbus::read_device_identification{modbus::read_device_identification::access::basic, 0}},
         {}});
    steps.push_back({modbus::request{modbus::report_server_id{}}, {}});
    read(modbus_first(modbus::table::input_registers));
    read(modbus_first(modbus::table::coils));
    read(modbus_first(modbus::table::discrete_inputs));
    return steps;
}

std::optional<station_scan::question> station_scan::next()
{
    if (!waits())
        return std::nullopt;
    asking_ = true;
    const station_question asked = steps_.empty() ? steps_for(language_).front().asked : steps_.front().asked;
    return question{units_[at_], asked};
}

void station_scan::answered(const station_answer& answer)
{
    asking_ = false;
    if (!steps_.empty()) {
        note(steps_.front(), answer);
        end_step();
        return;
    }
    ++questions_;
    tries_ = 0;
    if (means_nobody(answer)) {
        ++at_;
        return;
    }
    auto steps = steps_for(language_);
    found_.push_back({.unit = units_[at_]});
    note(steps.front(), answer);
    steps_.assign(steps.begin() + 1, steps.end());
}

void station_scan::note(const step& of, const station_answer& answer)
{
    scan_finding& station = found_.back();
    if (!of.area) {
        const std::string text = identification_in(answer);
        if (station.identification.empty())
            station.identification = text;
        return;
    }
    const auto refusal = refusal_in(answer);
    station.areas.push_back({*of.area, refusal ? scanned_area::says::refused : scanned_area::says::values,
                             refusal ? refusal->reason : std::string()});
}

void station_scan::end_step()
{
    ++questions_;
    tries_ = 0;
    // Who has told its name is not asked for it in the other way.
    do
        steps_.pop_front();
    while (!steps_.empty() && !steps_.front().area && !found_.back().identification.empty());
    if (steps_.empty())
        ++at_;
}

void station_scan::failed(const boost::system::error_code& why)
{
    asking_ = false;
    if (why == errc::line_not_quiet && ++tries_ < most_tries)
        return;
    if (!steps_.empty()) {
        const step& of = steps_.front();
        if (of.area)
            found_.back().areas.push_back({*of.area, scanned_area::says::nothing, why.message()});
        end_step();
        return;
    }
    ++questions_;
    tries_ = 0;
    if (why == errc::line_not_quiet)
        ++disturbed_;
    else if (!is_silence(why))
        found_.push_back({.unit = units_[at_], .is_damaged = true, .damage = why.message()});
    ++at_;
}

}  // namespace plcgw
