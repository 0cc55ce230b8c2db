// ASCII stations that were told to end their frames with another character.
#include "bridge/routes/client_line.hpp"

namespace plcgw {

std::uint8_t client_line::delimiter_of(station_number unit, std::uint8_t of_a_stranger) const
{
    const auto told = delimiters_.find(unit);
    if (told == delimiters_.end())
        return of_a_stranger;
    return told->second.in_force ? told->second.character : modbus::ascii_delimiter;
}

void client_line::learn_delimiter(const question& q, const station_answer& answer)
{
    const auto* const response = std::get_if<modbus::response>(&answer);
    const auto* const request = std::get_if<modbus::request>(&q.asked);
    const auto* const asked = request == nullptr ? nullptr : std::get_if<modbus::diagnostics>(request);
    if (asked == nullptr || response == nullptr || asked->what != modbus::diagnostic::change_ascii_delimiter ||
        asked->data.empty())
        return;
    if (std::holds_alternative<modbus::diagnostics_answered>(*response))
        delimiters_[q.unit] = {asked->data[0]};
    else if (q.unit == station_number(modbus::unit_id::broadcast) &&
             std::holds_alternative<modbus::no_response>(*response))
        for (unsigned unit = 0; unit <= 247; ++unit)  // whoever did not hear it is found out by asking
            delimiters_[station_number(unit)] = {asked->data[0]};
}

void client_line::doubt_delimiter(station_number unit)
{
    if (const auto told = delimiters_.find(unit); told != delimiters_.end())
        told->second.in_force = !told->second.in_force;
}

}  // namespace plcgw
