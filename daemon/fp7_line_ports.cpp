#include "daemon/fp7_line_ports.hpp"

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
            for (const port& each : ports_)
                each.unit->note(each.com, what);
}

}  // namespace plcgw
