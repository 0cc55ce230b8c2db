#include "bridge/dds/command_wire.hpp"

#include "bridge/dds/bounded_string.hpp"

#include <algorithm>
#include <chrono>

namespace plcgw {
namespace {

static_assert(static_cast<int>(order_result::ok) == plcgw_v1_RESULT_OK);
static_assert(static_cast<int>(order_result::rejected) == plcgw_v1_RESULT_REJECTED);
static_assert(static_cast<int>(order_result::not_found) == plcgw_v1_RESULT_NOT_FOUND);
static_assert(static_cast<int>(order_result::expired) == plcgw_v1_RESULT_EXPIRED);
static_assert(static_cast<int>(order_result::device_error) == plcgw_v1_RESULT_DEVICE_ERROR);
static_assert(static_cast<int>(order_result::timeout) == plcgw_v1_RESULT_TIMEOUT);
static_assert(static_cast<int>(order_result::busy) == plcgw_v1_RESULT_BUSY);
static_assert(static_cast<int>(order_result::standby) == plcgw_v1_RESULT_STANDBY);
static_assert(static_cast<int>(order_result::denied) == plcgw_v1_RESULT_DENIED);

constexpr std::size_t most_words = 1024;
constexpr std::size_t most_bytes = 4096;

// A foreign writer may have left out the end of a name.
template <std::size_t Size>
std::string name_in(const char (&from)[Size], const char* what, order_request& of)
{
    if (std::find(std::begin(from), std::end(from), '\0') == std::end(from))
        of.malformed = std::string(what) + " does not end within " + std::to_string(Size - 1) + " bytes";
    return std::string(read_string(from));
}

template <class In>
order_request begin(const In& in)
{
    order_request out;
    out.key.request = in.request_id;
    out.key.client = name_in(in.client, "client", out);
    out.gateway = name_in(in.gateway, "gateway", out);
    if (out.key.client.empty())
        out.malformed = "client is empty: give a name that no other client process has";
    out.what.given = wall_time{in.source_ns};
    out.what.timeout = std::chrono::milliseconds(in.timeout_ms);
    return out;
}

// A name that is cut off would be another one.
template <std::size_t Size>
bool fill_name(char (&to)[Size], const std::string& name)
{
    fill_string(to, name);
    return name.size() < Size;
}

// False: its names are too long.
template <class Out>
bool begin(Out& to, const order_request& from)
{
    to.request_id = from.key.request;
    to.source_ns = static_cast<std::int64_t>(from.what.given);
    to.timeout_ms = static_cast<std::uint32_t>(from.what.timeout / std::chrono::milliseconds(1));
    const bool is_whole = fill_name(to.client, from.key.client);
    return fill_name(to.gateway, from.gateway) && is_whole;
}

template <class Sequence, class Values>
void lend(Sequence& to, const Values& values)
{
    to._length = to._maximum = static_cast<std::uint32_t>(values.size());
    to._buffer = const_cast<typename Values::value_type*>(values.data());  // dds_write only reads it
}

}  // namespace

order_request received(const plcgw_v1_WriteRequest& in)
{
    order_request out = begin(in);
    route_order o;
    o.route = name_in(in.route, "route", out);
    o.area = name_in(in.area, "area", out);
    o.first = in.first;
    o.values.are_bits = in.format == plcgw_v1_FORMAT_BITS;
    o.values.count = in.count;
    o.values.words.assign(in.words._buffer, in.words._buffer + in.words._length);
    if (in.format > plcgw_v1_FORMAT_BITS)
        out.malformed = "format " + std::to_string(in.format) + " is neither 0 (words) nor 1 (bits)";
    else if (!is_whole(o.values))
        out.malformed = "count " + std::to_string(in.count) + " does not go with " +
                        std::to_string(o.values.words.size()) +
                        " words: each word is one register, or 16 bits of which the last may be unused";
    out.what.what = std::move(o);
    return out;
}

order_request received(const plcgw_v1_PointWriteRequest& in)
{
    order_request out = begin(in);
    point_order o;
    o.name = name_in(in.name, "name", out);
    const bool known = in.kind > plcgw_v1_KIND_NONE && in.kind <= plcgw_v1_KIND_TEXT;
    o.value = {known ? point_kind{in.kind} : point_kind::none, in.real, in.integer, name_in(in.text, "text", out)};
    if (!known)
        out.malformed = "kind " + std::to_string(in.kind) + " is none of 1 boolean, 2 integer, 3 real, 4 text";
    out.what.what = std::move(o);
    return out;
}

order_request received(const plcgw_v1_SerialSendRequest& in)
{
    order_request out = begin(in);
    message_order o;
    o.line = name_in(in.line, "line", out);
    o.content.assign(in.content._buffer, in.content._buffer + in.content._length);
    out.what.what = std::move(o);
    return out;
}

order_reply received(const plcgw_v1_WriteReply& in)
{
    order_reply out;
    out.key = {std::string(read_string(in.client)), in.request_id};
    out.gateway = read_string(in.gateway);
    out.member = read_string(in.member);
    out.outcome = {order_result{in.result}, in.device_code, std::string(read_string(in.detail))};
    out.done = wall_time{in.done_ns};
    return out;
}

bool fill(plcgw_v1_WriteRequest& to, const order_request& from)
{
    const auto& o = std::get<route_order>(from.what.what);
    bool fits = begin(to, from);
    fits = fill_name(to.route, o.route) && fits;
    fits = fill_name(to.area, o.area) && fits;
    to.first = o.first;
    to.format = o.values.are_bits ? plcgw_v1_FORMAT_BITS : plcgw_v1_FORMAT_WORDS;
    to.count = o.values.count;
    lend(to.words, o.values.words);
    return fits && o.values.words.size() <= most_words;
}

bool fill(plcgw_v1_PointWriteRequest& to, const order_request& from)
{
    const auto& o = std::get<point_order>(from.what.what);
    bool fits = begin(to, from);
    fits = fill_name(to.name, o.name) && fits;
    to.kind = static_cast<std::uint8_t>(o.value.kind);
    to.real = o.value.real;
    to.integer = o.value.integer;
    return fill_name(to.text, o.value.text) && fits;
}

bool fill(plcgw_v1_SerialSendRequest& to, const order_request& from)
{
    const auto& o = std::get<message_order>(from.what.what);
    bool fits = begin(to, from);
    fits = fill_name(to.line, o.line) && fits;
    lend(to.content, o.content);
    return fits && o.content.size() <= most_bytes;
}

void fill(plcgw_v1_WriteReply& to, const order_reply& from)
{
    fill_string(to.client, from.key.client);
    to.request_id = from.key.request;
    fill_string(to.gateway, from.gateway);
    fill_string(to.member, from.member);
    to.result = static_cast<std::uint16_t>(from.outcome.result);
    to.device_code = from.outcome.device_code;
    to.done_ns = static_cast<std::int64_t>(from.done);
    fill_string(to.detail, from.outcome.detail);
}

}  // namespace plcgw
