#include "bridge/routes/forward_queue.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr std::size_t most_of_one = 64;
constexpr std::size_t most_of_all = 4096;

bool is_read(const modbus::request& r) { return std::holds_alternative<modbus::read_table>(r); }

}  // namespace

forward_queue::asker_queue& forward_queue::queue_of(forward_asker asker)
{
    const auto found =
        std::find_if(askers_.begin(), askers_.end(), [asker](const asker_queue& each) { return each.asker == asker; });
    return found != askers_.end() ? *found : askers_.emplace_back(asker_queue{asker, {}});
}

std::optional<forward_ticket> forward_queue::add(forward_asker asker, station_number unit, modbus::request request,
                                                 std::optional<modbus::serial_options> timing)
{
    asker_queue& of = queue_of(asker);
    if (of.waiting.size() >= most_of_one || waiting_ >= most_of_all)
        return std::nullopt;
    const forward_ticket ticket{++last_};
    of.waiting.push_back({ticket, unit, std::move(request), std::move(timing)});
    ++waiting_;
    return ticket;
}

time_point forward_queue::look(time_point now, const judge& what_of)
{
    time_point earliest = time_point::max();
    for (asker_queue& of : askers_) {
        std::erase_if(of.waiting, [&](const forward_request& each) {
            const verdict v = what_of(each);
            const auto* const read = std::get_if<modbus::read_table>(&each.request);
            const auto known = read == nullptr ? std::nullopt : cache_.find(each.unit, *read, now);
            if (known)
                answer_one(each, *known);
            else if (v.failed)
                answer_one(each, make_error_code(*v.failed));
            else
                earliest = std::min(earliest, v.not_before);
            const bool is_done = known || v.failed;
            waiting_ -= is_done ? 1 : 0;
            return is_done;
        });
    }
    std::erase_if(askers_, [](const asker_queue& of) { return of.waiting.empty(); });
    return earliest;
}

std::optional<forward_request> forward_queue::take(time_point now, const judge& what_of)
{
    for (auto of = askers_.begin(); of != askers_.end(); ++of) {
        const auto found = std::find_if(of->waiting.begin(), of->waiting.end(),
                                        [&](const forward_request& each) { return what_of(each).not_before <= now; });
        if (found == of->waiting.end())
            continue;
        group taken{found->unit, now, found->request, {}};
        taken.members.push_back(std::move(*found));
        of->waiting.erase(found);
        --waiting_;
        asker_queue served = std::move(*of);
        askers_.erase(of);
        if (!served.waiting.empty())
            askers_.push_back(std::move(served));
        join(taken);
        forward_request goes = taken.members.front();
        goes.request = taken.asked;
        under_way_.emplace(goes.ticket, std::move(taken));
        return goes;
    }
    return std::nullopt;
}

void forward_queue::join(group& with)
{
    const forward_request& first = with.members.front();
    if (!is_read(with.asked) || first.alone || first.timing)
        return;
    const station_number unit = first.unit;
    for (bool grew = true; std::exchange(grew, false);) {
        for (asker_queue& of : askers_) {
            for (auto each = of.waiting.begin(); each != of.waiting.end();) {
                const auto* const read = std::get_if<modbus::read_table>(&each->request);
                const bool may = read != nullptr && each->unit == unit && !each->alone && !each->timing;
                const auto both = may ? joined(std::get<modbus::read_table>(with.asked), *read) : std::nullopt;
                if (!both) {
                    ++each;
                    continue;
                }
                with.asked = *both;
                with.members.push_back(std::move(*each));
                each = of.waiting.erase(each);
                --waiting_;
                grew = true;
            }
        }
    }
    std::erase_if(askers_, [](const asker_queue& of) { return of.waiting.empty(); });
}

void forward_queue::answer(forward_ticket ticket, result<modbus::response> response, time_point now)
{
    const auto found = under_way_.find(ticket);
    if (found == under_way_.end())
        return;
    group done = std::move(found->second);
    under_way_.erase(found);
    // Whoever asked may have left, or nobody answered: a write may have been executed all the same.
    if (response)
        heard(done.unit, done.asked, *response, done.asked_at, now);
    else if (!is_read(done.asked))
        forget(done.unit, now);
    if (!response) {
        for (const forward_request& each : done.members)
            answer_one(each, response.error());
        return;
    }
    const auto* const whole = std::get_if<modbus::read_table>(&done.asked);
    const bool differ = std::any_of(done.members.begin(), done.members.end(),
                                    [&](const forward_request& each) { return each.request != done.asked; });
    if (differ && may_be_due_to_others(*response)) {
        ask_alone(std::move(done.members));
        return;
    }
    for (const forward_request& each : done.members)
        answer_one(each, differ ? part_of(*response, *whole, std::get<modbus::read_table>(each.request)) : *response);
}

void forward_queue::ask_alone(std::vector<forward_request> members)
{
    for (forward_request& each : members) {
        each.alone = true;
        askers_.push_front({forward_asker::nobody, {}});
        askers_.front().waiting.push_back(std::move(each));
        ++waiting_;
    }
}

void forward_queue::answer_all(errc why)
{
    for (const asker_queue& of : askers_)
        for (const forward_request& each : of.waiting)
            answer_one(each, make_error_code(why));
    askers_.clear();
    waiting_ = 0;
    cache_.forget_all();
}

void forward_queue::heard(station_number unit, const modbus::request& asked, const modbus::response& answer,
                          time_point asked_at, time_point now)
{
    if (const auto* const read = std::get_if<modbus::read_table>(&asked))
        cache_.store(unit, *read, answer, asked_at, now);
    else
        cache_.forget(unit, now);
}

void forward_queue::cancel(forward_ticket ticket)
{
    const auto is_it = [ticket](const auto& each) { return each.ticket == ticket; };
    for (asker_queue& of : askers_)
        waiting_ -= std::erase_if(of.waiting, is_it);
    std::erase_if(askers_, [](const asker_queue& of) { return of.waiting.empty(); });
    for (auto& [leader, of] : under_way_)
        std::erase_if(of.members, is_it);
    std::erase_if(answers_, is_it);
}

bool forward_queue::is_wanted(forward_ticket ticket) const
{
    const auto found = under_way_.find(ticket);
    return found != under_way_.end() && !found->second.members.empty();
}

void forward_queue::note_fault(forward_ticket ticket, const modbus::answer_fault& why)
{
    const auto found = under_way_.find(ticket);
    if (found == under_way_.end())
        return;
    for (const forward_request& each : found->second.members)
        faults_.push_back({each.ticket, why});
}

}  // namespace plcgw
