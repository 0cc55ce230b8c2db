#include "bridge/plc_link_time.hpp"

#include <numeric>

namespace plcgw {

duration plc_link_time::total() const { return std::accumulate(ts.begin(), ts.end(), tlt + tso + tlk); }

plc_link_time round_time(const plc_link_time_input& in)
{
    plc_link_time t;
    for (const link_load& each : in.stations)
        t.ts.push_back(each.scan + link_send_time(each, in.baud_rate));
    t.tlt = link_table_time(in.stations.size(), in.baud_rate);
    t.tso = in.master_scan;
    if (in.somebody_absent)
        t.tlk = link_join_time(in.master_scan, in.join_wait, in.baud_rate);
    return t;
}

}  // namespace plcgw
