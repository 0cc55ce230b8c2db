// Those who wait until a station has taken what they wrote: clients of write-through routes, and whoever gives orders.
#include "bridge/routes/client_line.hpp"
#include "bridge/services/mewtocol_forward.hpp"

#include <algorithm>

namespace plcgw {

std::vector<std::uint64_t> client_line::write_through(const plc::simulated_plc& plc)
{
    plan();
    std::vector<std::uint64_t> numbers;
    for (row& of : routes_)
        if (of.through && of.content.plc == &plc && of.content.plc->memory().take_written(*of.through))
            numbers.push_back(wait_for(of));
    return numbers;
}

std::vector<std::uint64_t> client_line::order(const plc::simulated_plc& plc, const plc::change& written)
{
    plan();
    std::vector<std::uint64_t> numbers;
    for (row& of : routes_) {
        if (!writes(of.content.way) || !touches(of.content, plc, written))
            continue;
        if (of.through)
            of.content.plc->memory().take_written(*of.through);
        if (of.first_write)  // the question itself begins the periods
            of.content.plc->memory().take_written(*of.first_write);
        of.taken_back.reset();
        numbers.push_back(wait_for(of));
    }
    return numbers;
}

std::uint64_t client_line::wait_for(row& of)
{
    const std::uint64_t number = ++last_through_;
    of.waiting.push_back(number);
    ask_write(of);
    if (!port_open_)
        through_lost(of);
    else if (schedule_.state_of(of.station) == health::down)  // at once: the line is for the living
        through_unanswered(of, "it is known to be down");
    return number;
}

bool client_line::has_begun(std::uint64_t number) const
{
    return std::none_of(routes_.begin(), routes_.end(), [number](const row& each) {
        return std::find(each.waiting.begin(), each.waiting.end(), number) != each.waiting.end();
    });
}

void client_line::withdraw(const std::vector<std::uint64_t>& numbers)
{
    for (row& of : routes_) {
        const auto is_withdrawn = [&](std::uint64_t n) {
            return std::find(numbers.begin(), numbers.end(), n) != numbers.end();
        };
        if (std::erase_if(of.waiting, is_withdrawn) == 0 || !of.waiting.empty() || !is_as_station_has(of))
            continue;
        if (of.content.way == direction::periodic_write && !of.first_write)
            ask_write(of, of.next_write);
        else
            schedule_.forget(write_item(of));
        if (!of.through && !of.half)
            of.taken_back = words_in_memory(of.content);
    }
}

// Nobody else's change waits to be written.
bool client_line::is_as_station_has(const row& of)
{
    const std::vector<std::uint16_t> words = words_in_memory(of.content);
    if (of.through)
        return words == of.agreed;
    return words == (of.half ? routes_[*of.partner].agreed : of.content.words);
}

// Those who wait for a question that is not out yet are served by the next one, unless nobody can ask.
void client_line::through_ended(row& of, const std::optional<write_failure>& failed)
{
    const bool is_given_up = failed && (!port_open_ || schedule_.state_of(of.station) == health::down);
    if (is_given_up)
        of.on_its_way.insert(of.on_its_way.end(), of.waiting.begin(), of.waiting.end());
    if (is_given_up)
        of.waiting.clear();
    const bool somebody_waited = !of.on_its_way.empty();
    for (const std::uint64_t number : std::exchange(of.on_its_way, {})) {
        through_outcome& outcome = through_outcomes_.emplace_back();
        outcome.number = number;
        if (failed)
            outcome = {number, failed->shown, failed->device_code, failed->reason, failed->goes_on};
    }
    if (!of.through || !failed || !somebody_waited || !of.waiting.empty())
        return;
    schedule_.forget(write_item(of));  // who wanted it knows that it failed
    put_words(of.content, of.agreed);
}

void client_line::through_refused(row& of, const question& q, const station_refusal& why)
{
    const bool is_modbus = std::holds_alternative<modbus::request>(q.asked);
    const auto shown = is_modbus ? static_cast<modbus::exception_code>(why.code)
                                 : exception_of(static_cast<mewtocol::error_code>(why.code));
    const bool again = goes_on(of) && (why.may_pass || of.content.way == direction::periodic_write);
    through_ended(of, write_failure{shown, why.code, label(stations_[of.station]) + " refuses: " + why.reason, again});
}

void client_line::through_unanswered(row& of, const std::string& reason)
{
    through_ended(of, write_failure{modbus::exception_code::gateway_target_failed_to_respond, 0,
                                    label(stations_[of.station]) + " does not answer: " + reason, goes_on(of)});
}

void client_line::through_lost(row& of)
{
    of.on_its_way.insert(of.on_its_way.end(), of.waiting.begin(), of.waiting.end());
    of.waiting.clear();
    through_ended(of,
                  write_failure{modbus::exception_code::gateway_path_unavailable, 0,
                                label(stations_[of.station]) + " is out of reach: the port is absent", goes_on(of)});
}

}  // namespace plcgw
