#include "daemon/fp7_line_ports.hpp"

#include "daemon/read_before.hpp"

#include <algorithm>

namespace plcgw {

void fp7_line_ports::add(fp7_unit* unit, unsigned com)
{
    if (unit != nullptr)
        ports_.push_back({unit, com});
}

void fp7_line_ports::note(const bit_errors& wrong)
{
    using plc::receive_error;
    constexpr std::uint64_t at_once = 1000;  // a line that is nothing but noise does not hold up the others
    const std::pair<receive_error, std::uint64_t> counted[] = {{receive_error::overrun, wrong.overrun},
                                                               {receive_error::framing, wrong.framing},
                                                               {receive_error::parity, wrong.parity}};
    for (const auto& [what, count] : counted)
        for (std::uint64_t i = 0; i < std::min(count, at_once); ++i)
            note(what);
}

void fp7_line_ports::note(plc::receive_error what)
{
    for (const port& each : ports_)
        each.unit->note(each.com, what);
}

void fp7_line_ports::note(plc::setting_error what)
{
    for (const port& each : ports_)
        each.unit->note(each.com, what);
}

void fp7_line_ports::note(errc why)
{
    using plc::receive_error;
    switch (why) {
    case errc::overrun: return note(receive_error::overrun);
    case errc::bad_stop_bit: return note(receive_error::framing);
    case errc::bad_parity: return note(receive_error::parity);
    case errc::overlong: return note(receive_error::buffer_overrun);
    default: return;
    }
}

void fp7_line_ports::show(const com_state& state)
{
    for (const port& each : ports_)
        each.unit->show(now(), each.com, state);
}

void fp7_line_ports::sends(time_point until)
{
    for (const port& each : ports_)
        each.unit->sends(now(), each.com, until);
}

void fp7_line_ports::copied()
{
    for (const port& each : ports_)
        each.unit->copied(now(), each.com);
}

void fp7_line_ports::reset_done()
{
    for (const port& each : ports_)
        each.unit->reset_done(now(), each.com);
}

}  // namespace plcgw
