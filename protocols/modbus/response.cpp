#include "protocols/modbus/response.hpp"

#include "protocols/modbus/wire.hpp"

#include <algorithm>

namespace plcgw::modbus {
namespace {

using size = std::optional<std::size_t>;

constexpr std::size_t event_counter_size = 5;
constexpr std::size_t event_log_header = 6;       // status, event count, message count
constexpr std::size_t identification_header = 7;  // function, MEI type, access, conformity, more, next, objects
constexpr std::uint8_t mei_device_identification = 0x0E;

// The request PDU's leading bytes that the response to a write repeats.
std::size_t echoed_size(function f) { return f == function::mask_write_register ? 7 : 5; }

// Function code, byte count, and as many bytes.
size counted_size(bytes begin) { return begin.size() < 2 ? size{} : size{2U + begin[1]}; }

size identification_size(bytes begin)
{
    if (begin.size() < identification_header)
        return std::nullopt;
    std::size_t at = identification_header;
    for (unsigned n = begin[identification_header - 1]; n > 0; --n) {
        if (begin.size() < at + 2)
            return std::nullopt;
        at += 2U + begin[at + 1];
    }
    return at;
}

// One overload for each request.
struct sizer {
    bytes begin;

    size operator()(const read_table& r) const
    {
        return 2 + (is_bit_table(r.from) ? packed_size(r.count) : 2U * r.count);
    }
    size operator()(const read_write_multiple_registers& r) const { return 2 + 2U * r.read_count; }
    size operator()(const mask_write_register&) const { return 7; }
    size operator()(const read_exception_status&) const { return 2; }
    size operator()(const diagnostics& r) const { return 3 + r.data.size(); }
    size operator()(const get_comm_event_counter&) const { return event_counter_size; }
    size operator()(const get_comm_event_log&) const { return counted_size(begin); }
    size operator()(const report_server_id&) const { return counted_size(begin); }
    size operator()(const read_device_identification&) const { return identification_size(begin); }
    template <class Write>
    size operator()(const Write&) const
    {
        return 5;
    }
};

struct encoder {
    const request& question;

    buffer operator()(const bits_read& answer) const
    {
        buffer pdu = header(packed_size(answer.values.size()));
        append_bits(pdu, answer.values);
        return pdu;
    }
    buffer operator()(const registers_read& answer) const
    {
        buffer pdu = header(2 * answer.values.size());
        append_words(pdu, answer.values);
        return pdu;
    }
    buffer operator()(const written&) const
    {
        buffer pdu = encode_request(question);
        pdu.resize(echoed_size(function_of(question)));
        return pdu;
    }
    buffer operator()(exception_code code) const { return encode_exception(code_byte(), code); }
    buffer operator()(const exception_status_read& answer) const { return {code_byte(), answer.status}; }
    buffer operator()(const diagnostics_answered& answer) const
    {
        buffer pdu{code_byte()};
        append_word(pdu, static_cast<std::uint16_t>(std::get<diagnostics>(question).what));
        pdu.insert(pdu.end(), answer.data.begin(), answer.data.end());
        return pdu;
    }
    buffer operator()(const event_counter_read& answer) const
    {
        buffer pdu{code_byte()};
        append_words(pdu, {answer.status, answer.events});
        return pdu;
    }
    buffer operator()(const event_log_read& answer) const
    {
        buffer pdu = header(event_log_header + answer.log.size());
        append_words(pdu, {answer.status, answer.events, answer.messages});
        pdu.insert(pdu.end(), answer.log.begin(), answer.log.end());
        return pdu;
    }
    buffer operator()(const server_id_read& answer) const
    {
        buffer pdu = header(answer.data.size());
        pdu.insert(pdu.end(), answer.data.begin(), answer.data.end());
        return pdu;
    }
    buffer operator()(const device_identification_read& answer) const
    {
        buffer pdu{code_byte(),
                   mei_device_identification,
                   static_cast<std::uint8_t>(answer.how),
                   answer.conformity,
                   answer.more_follows,
                   answer.next_object,
                   static_cast<std::uint8_t>(answer.objects.size())};
        for (const auto& each : answer.objects) {
            pdu.push_back(each.id);
            pdu.push_back(static_cast<std::uint8_t>(each.value.size()));
            pdu.insert(pdu.end(), each.value.begin(), each.value.end());
        }
        return pdu;
    }
    buffer operator()(const no_response&) const { return {}; }

private:
    std::uint8_t code_byte() const { return static_cast<std::uint8_t>(function_of(question)); }
    buffer header(std::size_t byte_count) const { return {code_byte(), static_cast<std::uint8_t>(byte_count)}; }
};

// Takes a PDU apart whose function code and size fit the question. One overload for each request.
struct parser {
    const request& question;
    bytes pdu;

    using parsed = result<response>;

    parsed operator()(const read_table& r) const
    {
        if (pdu[1] != pdu.size() - 2)
            return unexpected();
        if (is_bit_table(r.from))
            return response{bits_read{read_bits(pdu.subspan(2), r.count)}};
        return response{registers_read{read_words(pdu.subspan(2))}};
    }
    parsed operator()(const read_write_multiple_registers&) const
    {
        if (pdu[1] != pdu.size() - 2)
            return unexpected();
        return response{registers_read{read_words(pdu.subspan(2))}};
    }
    parsed operator()(const read_exception_status&) const { return response{exception_status_read{pdu[1]}}; }
    parsed operator()(const diagnostics& r) const
    {
        const bytes data = pdu.subspan(3);
        const bool echoes = r.what <= diagnostic::clear_counters && r.what != diagnostic::return_diagnostic_register;
        if (read_word(pdu, 1) != static_cast<std::uint16_t>(r.what) ||
            (echoes && !std::equal(data.begin(), data.end(), r.data.begin())))
            return unexpected();
        return response{diagnostics_answered{buffer(data.begin(), data.end())}};
    }
    parsed operator()(const get_comm_event_counter&) const
    {
        return response{event_counter_read{read_word(pdu, 1), read_word(pdu, 3)}};
    }
    parsed operator()(const get_comm_event_log&) const
    {
        if (pdu[1] < event_log_header)
            return unexpected();
        return response{event_log_read{read_word(pdu, 2), read_word(pdu, 4), read_word(pdu, 6),
                                       buffer(pdu.begin() + 8, pdu.end())}};
    }
    parsed operator()(const report_server_id&) const
    {
        return response{server_id_read{buffer(pdu.begin() + 2, pdu.end())}};
    }
    parsed operator()(const read_device_identification& r) const
    {
        if (pdu[1] != mei_device_identification || pdu[2] != static_cast<std::uint8_t>(r.how))
            return unexpected();
        device_identification_read answer{r.how, pdu[3], pdu[4], pdu[5], {}};
        for (std::size_t at = identification_header; at < pdu.size(); at += 2U + pdu[at + 1]) {
            const bytes value = pdu.subspan(at + 2, pdu[at + 1]);
            answer.objects.push_back({pdu[at], std::string(value.begin(), value.end())});
        }
        return response{std::move(answer)};
    }
    template <class Write>
    parsed operator()(const Write&) const
    {
        const buffer asked = encode_request(question);
        if (!std::equal(pdu.begin(), pdu.end(), asked.begin()))
            return unexpected();
        return response{written{}};
    }

private:
    static boost::system::error_code unexpected() { return make_error_code(errc::unexpected_answer); }
};

}  // namespace

buffer encode_response(const request& question, const response& answer)
{
    return std::visit(encoder{question}, answer);
}

buffer encode_exception(std::uint8_t function_code, exception_code code)
{
    return {static_cast<std::uint8_t>(function_code | 0x80), static_cast<std::uint8_t>(code)};
}

bool expects_answer(unit_id unit, const request& question)
{
    const auto* const sub = std::get_if<diagnostics>(&question);
    return unit != unit_id::broadcast && (sub == nullptr || sub->what != diagnostic::force_listen_only);
}

bool echoes_request(const request& question)
{
    return std::holds_alternative<write_single_coil>(question) ||
           std::holds_alternative<write_single_register>(question) ||
           std::holds_alternative<mask_write_register>(question) || std::holds_alternative<diagnostics>(question);
}

size response_size(const request& question, bytes begin) { return std::visit(sizer{begin}, question); }

result<response> parse_response(const request& question, bytes pdu)
{
    const auto code = static_cast<std::uint8_t>(function_of(question));
    if (pdu.size() == exception_size && pdu[0] == (code | 0x80))
        return response{exception_code{pdu[1]}};
    if (pdu.empty() || pdu[0] != code || response_size(question, pdu) != pdu.size())
        return make_error_code(errc::unexpected_answer);
    return std::visit(parser{question, pdu}, question);
}

}  // namespace plcgw::modbus
