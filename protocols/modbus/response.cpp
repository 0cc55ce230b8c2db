#include "protocols/modbus/response.hpp"

#include "protocols/modbus/wire.hpp"

#include <algorithm>

namespace plcgw::modbus {
namespace {

// The request PDU's leading bytes that the response to a write repeats.
std::size_t echoed_size(function f) { return f == function::mask_write_register ? 7 : 5; }

bool is_write(const request& question)
{
    return !std::holds_alternative<read_table>(question) &&
           !std::holds_alternative<read_write_multiple_registers>(question);
}

struct sizer {
    std::size_t operator()(const read_table& r) const
    {
        return 2 + (is_bit_table(r.from) ? packed_size(r.count) : 2U * r.count);
    }
    std::size_t operator()(const read_write_multiple_registers& r) const { return 2 + 2U * r.read_count; }
    std::size_t operator()(const mask_write_register&) const { return 7; }
    template <class Write>
    std::size_t operator()(const Write&) const
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
    buffer operator()(exception_code code) const
    {
        return encode_exception(static_cast<std::uint8_t>(function_of(question)), code);
    }

private:
    buffer header(std::size_t byte_count) const
    {
        return {static_cast<std::uint8_t>(function_of(question)), static_cast<std::uint8_t>(byte_count)};
    }
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

std::size_t response_size(const request& question) { return std::visit(sizer{}, question); }

result<response> parse_response(const request& question, bytes pdu)
{
    const auto code = static_cast<std::uint8_t>(function_of(question));
    if (pdu.size() == exception_size && pdu[0] == (code | 0x80))
        return response{exception_code{pdu[1]}};
    if (pdu.size() != response_size(question) || pdu[0] != code)
        return make_error_code(errc::unexpected_answer);

    if (is_write(question)) {
        const buffer asked = encode_request(question);
        if (!std::equal(pdu.begin(), pdu.end(), asked.begin()))
            return make_error_code(errc::unexpected_answer);
        return response{written{}};
    }
    if (pdu[1] != pdu.size() - 2)
        return make_error_code(errc::unexpected_answer);
    if (const auto* read = std::get_if<read_table>(&question); read != nullptr && is_bit_table(read->from))
        return response{bits_read{read_bits(pdu.subspan(2), read->count)}};
    return response{registers_read{read_words(pdu.subspan(2))}};
}

}  // namespace plcgw::modbus
