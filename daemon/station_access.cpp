#include "daemon/station_access.hpp"

#include "bridge/plc/models/fp7.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plcgw {
namespace {

using found_place = boost::system::result<modbus_place, order_outcome>;
using maybe_request = boost::system::result<modbus::request, order_outcome>;

order_outcome rejected(std::string why) { return {order_result::rejected, 0, std::move(why)}; }

// Forwarded requests are MODBUS requests, which a MEWTOCOL line translates by the FP7's map (table 8.2).
found_place as_modbus(const station_place& p, bool writes)
{
    if (const auto* const there = std::get_if<modbus_place>(&p))
        return *there;
    const auto& device = std::get<mewtocol::device>(p);
    const std::string name = mewtocol::to_string(device);
    const auto same = plc::parse_device(name, plc::fp7.names);
    for (const plc::map_row& row : plc::fp7.standard_map) {
        const bool may_write = row.table == modbus::table::coils || row.table == modbus::table::holding_registers;
        if (same && row.head.kind == same->kind && same->number >= row.head.number &&
            same->number - row.head.number < row.count && (may_write || !writes))
            return modbus_place{
                row.table, modbus::address{static_cast<std::uint16_t>(row.first + same->number - row.head.number)}};
    }
    return rejected(fmt::format("{} cannot be {} directly: a station's X, Y, R, DT, WL and LD can, as far as the FP7's "
                                "MODBUS map has them; a route reaches the others",
                                name, writes ? "written" : "read"));
}

maybe_request write_request(const station_order& o)
{
    const found_place there = as_modbus(o.first, true);
    if (!there)
        return there.error();
    if (there->table != modbus::table::coils && there->table != modbus::table::holding_registers)
        return rejected(
            fmt::format("{} is read-only in MODBUS: coil and holding can be written", modbus::to_string(there->table)));
    const bool bits = modbus::is_bit_table(there->table);
    if (bits != o.values.are_bits || !is_whole(o.values))
        return rejected(bits ? "these are bits: give 0 or 1 for each" : "these are words: give a number for each");
    const unsigned most = bits ? modbus::max_write_coils : modbus::max_write_registers;
    if (o.values.count > most || modbus::number(there->first) + o.values.count > 65'536)
        return rejected(fmt::format("one request carries {} of these, up to address 65535", most));
    if (!bits && o.values.count == 1)
        return modbus::request(modbus::write_single_register{there->first, o.values.words.front()});
    if (!bits)
        return modbus::request(modbus::write_multiple_registers{there->first, o.values.words});
    if (o.values.count == 1)
        return modbus::request(modbus::write_single_coil{there->first, o.values.bit(0)});
    std::vector<bool> values(o.values.count);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = o.values.bit(i);
    return modbus::request(modbus::write_multiple_coils{there->first, std::move(values)});
}

order_outcome outcome_of(const std::optional<result<modbus::response>>& answer, const running_line& line)
{
    if (!answer)
        return {order_result::busy, 0,
                fmt::format("too many requests wait on line {}: repeat it later", line.config.name)};
    if (!*answer && answer->error() == errc::not_expressible)
        return rejected("no such request exists in the protocol of line " + line.config.name);
    if (!*answer && answer->error() == errc::port_absent)
        return {order_result::timeout, 0,
                fmt::format("the port of line {} is absent: nothing was asked", line.config.name)};
    if (!*answer)
        return {order_result::timeout, 0,
                fmt::format("the station does not answer ({}): what it has is not known", answer->error().message())};
    const station_answer said = **answer;
    if (const auto refused = refusal_in(said))
        return {order_result::device_error, refused->code, "the station refuses: " + refused->reason};
    if (std::holds_alternative<modbus::no_response>(**answer))
        return {order_result::ok, 0, "sent to all stations, of which none answers a broadcast"};
    return {order_result::ok, 0, "the station has it"};
}

// Nothing when too many wait; an expired question fails with errc::not_ready.
asio::awaitable<std::optional<result<modbus::response>>>
ask(running_line& line, station_number unit, modbus::request question, time_point begin_by, bool& expired)
{
    const forward_gate::handle asked = line.gate.begin(new_asker(), unit, std::move(question));
    if (!asked)
        co_return std::nullopt;
    expired = co_await line.gate.expires(asked, begin_by);
    if (expired)
        line.gate.cancel(asked);
    auto answer = co_await forward_gate::finish(asked);
    co_return std::move(answer);
}

const order_outcome too_late{order_result::expired, 0,
                             "it did not begin within its timeout and was not asked: the line is busy"};

}  // namespace

asio::awaitable<order_outcome> write_station(running_line& line, station_order o, time_point begin_by)
{
    auto question = write_request(o);
    if (!question)
        co_return question.error();
    bool expired = false;
    auto answer = co_await ask(line, o.unit, std::move(*question), begin_by, expired);
    co_return expired ? too_late : outcome_of(answer, line);
}

asio::awaitable<station_reading_result> read_station(running_line& line, station_number unit, station_place first,
                                                     std::uint32_t count, time_point begin_by)
{
    station_reading_result read;
    const found_place there = as_modbus(first, false);
    if (!there) {
        read.outcome = there.error();
        co_return read;
    }
    const bool bits = modbus::is_bit_table(there->table);
    const unsigned most = bits ? modbus::max_read_bits : modbus::max_read_registers;
    if (count == 0 || count > most || modbus::number(there->first) + count > 65'536) {
        read.outcome = rejected(fmt::format("one request reads 1 to {} of these, up to address 65535", most));
        co_return read;
    }
    if (number(unit) == 0 && line.config.protocol != line_protocol::modbus_tcp) {
        read.outcome = rejected("unit 0 is all stations, of which none answers: it can be written only");
        co_return read;
    }
    modbus::request question = modbus::read_table{there->table, there->first, static_cast<std::uint16_t>(count)};
    bool expired = false;
    const auto answer = co_await ask(line, unit, std::move(question), begin_by, expired);
    read.outcome = expired ? too_late : outcome_of(answer, line);
    if (read.outcome.result != order_result::ok)
        co_return read;
    read.values = {bits, count, std::vector<std::uint16_t>(bits ? (count + 15) / 16 : count)};
    if (const auto* const registers = std::get_if<modbus::registers_read>(&**answer))
        std::copy_n(registers->values.begin(), std::min<std::size_t>(count, registers->values.size()),
                    read.values.words.begin());
    if (const auto* const some = std::get_if<modbus::bits_read>(&**answer))
        for (std::size_t i = 0; i < std::min<std::size_t>(count, some->values.size()); ++i)
            if (some->values[i])
                read.values.words[i / 16] = static_cast<std::uint16_t>(read.values.words[i / 16] | 1U << i % 16);
    co_return read;
}

}  // namespace plcgw
