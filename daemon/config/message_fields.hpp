// How the structs of message_config.hpp are written in JSON.
#pragma once

#include "daemon/config/message_config.hpp"
#include "daemon/config/rules.hpp"

namespace plcgw::config {

using general_purpose::end_code;
using general_purpose::start_code;
using general_purpose::when_full;
using messages::word_order;

inline constexpr choice<start_code> start_codes[] = {{"none", start_code::none}, {"stx", start_code::stx}};
inline constexpr choice<end_code> end_codes[] = {
    {"cr", end_code::cr}, {"cr-lf", end_code::cr_lf}, {"etx", end_code::etx}, {"silence", end_code::silence}};
inline constexpr choice<when_full> full_policies[] = {{"drop", when_full::drop}, {"stop", when_full::stop}};
inline constexpr choice<value_type> value_types[] = {
    {"int16", value_type::int16},   {"uint16", value_type::uint16},   {"int32", value_type::int32},
    {"uint32", value_type::uint32}, {"float32", value_type::float32}, {"float64", value_type::float64},
    {"bcd16", value_type::bcd16},   {"bcd32", value_type::bcd32},     {"text", value_type::text},
};
inline constexpr choice<word_order> word_orders[] = {{"low-first", word_order::low_first},
                                                     {"high-first", word_order::high_first}};

template <class Visitor>
void describe(Visitor& v, received_config& c)
{
    v.required("name", c.name, "Name of these words: key of their DDS instance", name_rule);
    v.required("plc", c.plc, "Name of the simulated PLC", name_rule);
    v.required("device", c.device, "Word that gets the count of bytes; the bytes follow, low byte first", text{2, 16});
    v.required("count", c.count, "Words, that of the count among them", range{1, 2049});
    v.optional("ready", c.ready,
               "Bit that comes on with a message; the next one is stored when it is off again. Empty: each message "
               "replaces the one before",
               text{0, 16});
    v.optional("when_full", c.when_full,
               "When the eight buffers are full: drop new messages, or stop receiving until the channel is reset, as "
               "the PLC does",
               full_policies);
}

template <class Visitor>
void describe(Visitor& v, field_config& c)
{
    v.required("name", c.name, "Name of the field in the pattern", name_rule);
    v.required("device", c.device, "First device in the PLC's memory", text{2, 16});
    v.optional("type", c.type, "How the registers hold the value", value_types);
    v.optional("decimals", c.decimals, "The number is multiplied by 10 to this: 123.4 with 1 is 1234", range{0, 9});
    v.optional("characters", c.characters, "Of text: room for so many", range{0, 4096});
    v.optional("word_order", c.order, "Which word of a long value stands in the first register", word_orders);
}

template <class Visitor>
void describe(Visitor& v, message_config& c)
{
    v.required("name", c.name, "Name of the message: <name>.<field> is the key of a DDS instance", name_rule);
    v.required("pattern", c.pattern, "What the message looks like: ST,{_},{weight:number}kg", text{1, 1024});
    v.required("plc", c.plc, "Name of the simulated PLC", name_rule);
    v.optional("fields", c.fields, "Which parts go where");
    v.optional("longest_silence_ms", c.longest_silence,
               "The values are stale when no such message came for so long; 0 = never", range{0, 86'400'000});
    v.optional("answer_to", c.answer_to, "Name of a send: only its answers are read by this pattern", text{0, 64});
}

template <class Visitor>
void describe(Visitor& v, send_config& c)
{
    v.required("name", c.name, "Name of the sending", name_rule);
    v.optional("text", c.text, "What is sent, without start and end codes: W<CR> and \\x05 are control characters",
               text{0, 1024});
    v.optional("plc", c.plc, "Name of the simulated PLC that has the words or the trigger", text{0, 64});
    v.optional("device", c.device,
               "Or words of the PLC: the count of bytes (negative: no end code), then the bytes, low byte first",
               text{0, 16});
    v.optional("count", c.count, "Words, that of the count among them", range{0, 2049});
    v.optional("trigger", c.trigger, "Bit of the PLC; the message is sent when it comes on", text{0, 16});
    v.optional("period_ms", c.period, "Milliseconds from one sending to the next; 0 = not periodically",
               range{0, 86'400'000});
    v.optional("answer", c.answer, "The next message is the answer; without one the request is repeated");
    v.optional("response_timeout_ms", c.response_timeout, "As at the line, for this request", range{1, 60'000});
}

template <class Visitor>
void describe(Visitor& v, message_status_config& c)
{
    v.optional("plc", c.plc, "Name of the simulated PLC", text{0, 64});
    v.optional("device", c.device, "First of eight words that show errors and counters", text{0, 16});
    v.optional("reset", c.reset, "Bit that empties the receive buffers and clears the errors when it comes on",
               text{0, 16});
}

template <class Visitor>
void describe(Visitor& v, general_purpose_config& c)
{
    v.optional("start_code", c.start, "First character of each message", start_codes);
    v.optional("end_code", c.end, "What ends a message", end_codes);
    v.optional("end_silence_us", c.end_silence, "Microseconds of silence that end a message; 0 = 32 bits",
               range{0, 100'000});
    v.optional("abandon_ms", c.abandon, "A message whose end does not come is dropped after this silence; 0 = never",
               range{0, 60'000});
    v.optional("send_wait_ms", c.send_wait, "Milliseconds before each sending", range{0, 100});
    v.optional("received", c.received, "Words that get whole messages");
    v.optional("messages", c.messages, "Patterns; a message is read by the first one that fits");
    v.optional("sends", c.sends, "What is sent, and when");
    v.optional("dds_sends", c.dds_sends, "DDS clients may send messages on this line, if dds/writes is true");
    v.optional("status", c.status, "Where the PLC shows how the line does");
}

}  // namespace plcgw::config
