#include "bridge/services/mewtocol_station.hpp"

namespace plcgw {
namespace {

constexpr unsigned last_short_number = 99;

mewtocol::server make_normal(const mewtocol_station_options& o)
{
    const unsigned own = o.number <= last_short_number ? o.number : 0;
    return mewtocol::server({.own = mewtocol::station_id{static_cast<std::uint8_t>(own)},
                             .answers_any = o.answers_any,
                             .offered = o.offered,
                             .expansion = o.expansion,
                             .several_frames = o.several_frames,
                             .rest_kept = o.rest_kept});
}

mewtocol7::server make_seven(const mewtocol_station_options& o)
{
    return mewtocol7::server({.own = mewtocol7::station_id{static_cast<std::uint16_t>(o.number)},
                              .answers_any = o.answers_any,
                              .dialect = o.dialect,
                              .rest_kept = o.rest_kept});
}

}  // namespace

mewtocol_station::mewtocol_station(plc::simulated_plc& plc, mewtocol_station_options options)
    : options_(std::move(options)), access_(plc), normal_(make_normal(options_)),
      seven_(make_seven(options_)), registered_{.max_contacts = options_.max_contacts, .max_words = options_.max_words},
      power_ons_(plc.power_ons())
{
}

std::optional<buffer> mewtocol_station::hear(time_point now, const mewtocol::reception& r)
{
    if (std::exchange(power_ons_, plc().power_ons()) != plc().power_ons())
        reset();
    access_.look(now);
    if (auto reply = reply_to(r, now, normal_, access_, registered_))
        return reply;
    return reply_to(r, now, seven_, access_);
}

void mewtocol_station::reset()
{
    normal_ = make_normal(options_);
    seven_ = make_seven(options_);
    registered_.contacts.clear();
    registered_.words.clear();
}

bool is_like_request(bytes reply)
{
    if (reply.empty())
        return false;
    const std::size_t mark = reply.front() == '>' ? 7 : 3;
    return reply.size() <= mark || (reply[mark] != '$' && reply[mark] != '!');
}

}  // namespace plcgw
