#include "protocols/modbus/request.hpp"

#include "protocols/modbus/wire.hpp"

namespace plcgw::modbus {
namespace {

using parsed = boost::system::result<request, exception_code>;

constexpr auto bad_value = exception_code::illegal_data_value;

address address_at(bytes pdu, std::size_t at) { return address{read_word(pdu, at)}; }

parsed parse_read(table from, std::uint16_t most, bytes pdu)
{
    if (pdu.size() != 5)
        return bad_value;
    const std::uint16_t count = read_word(pdu, 3);
    if (count < 1 || count > most)
        return bad_value;
    return request{read_table{from, address_at(pdu, 1), count}};
}

parsed parse_write_single_coil(bytes pdu)
{
    if (pdu.size() != 5)
        return bad_value;
    const std::uint16_t value = read_word(pdu, 3);
    if (value != 0x0000 && value != 0xFF00)
        return bad_value;
    return request{write_single_coil{address_at(pdu, 1), value == 0xFF00}};
}

parsed parse_write_single_register(bytes pdu)
{
    if (pdu.size() != 5)
        return bad_value;
    return request{write_single_register{address_at(pdu, 1), read_word(pdu, 3)}};
}

parsed parse_write_multiple_coils(bytes pdu)
{
    if (pdu.size() < 7)
        return bad_value;
    const std::uint16_t count = read_word(pdu, 3);
    if (count < 1 || count > max_write_coils || pdu[5] != packed_size(count) || pdu.size() != 6U + pdu[5])
        return bad_value;
    return request{write_multiple_coils{address_at(pdu, 1), read_bits(pdu.subspan(6), count)}};
}

parsed parse_write_multiple_registers(bytes pdu)
{
    if (pdu.size() < 8)
        return bad_value;
    const std::uint16_t count = read_word(pdu, 3);
    if (count < 1 || count > max_write_registers || pdu[5] != 2 * count || pdu.size() != 6U + pdu[5])
        return bad_value;
    return request{write_multiple_registers{address_at(pdu, 1), read_words(pdu.subspan(6))}};
}

parsed parse_mask_write(bytes pdu)
{
    if (pdu.size() != 7)
        return bad_value;
    return request{mask_write_register{address_at(pdu, 1), read_word(pdu, 3), read_word(pdu, 5)}};
}

parsed parse_read_write(bytes pdu)
{
    if (pdu.size() < 12)
        return bad_value;
    const std::uint16_t read_count = read_word(pdu, 3);
    const std::uint16_t write_count = read_word(pdu, 7);
    if (read_count < 1 || read_count > max_read_registers || write_count < 1 ||
        write_count > max_read_write_registers || pdu[9] != 2 * write_count || pdu.size() != 10U + pdu[9])
        return bad_value;
    return request{
        read_write_multiple_registers{address_at(pdu, 1), read_count, address_at(pdu, 5), read_words(pdu.subspan(10))}};
}

// A function code alone.
template <class Request>
parsed parse_bare(bytes pdu)
{
    if (pdu.size() != 1)
        return bad_value;
    return request{Request{}};
}

bool is_known(diagnostic what)
{
    return what <= diagnostic::force_listen_only ||
           (what >= diagnostic::clear_counters && what <= diagnostic::bus_character_overrun_count);
}

// Which data each sub-function takes: V1.1b3 section 6.8.1, FX3 manual 7.11.
bool data_fits(diagnostic what, bytes data)
{
    if (what == diagnostic::return_query_data)
        return data.size() >= 2 && data.size() % 2 == 0;
    if (data.size() != 2)
        return false;
    const std::uint16_t word = read_word(data, 0);
    if (what == diagnostic::restart_communications)
        return word == 0x0000 || word == 0xFF00;
    if (what == diagnostic::change_ascii_delimiter)
        return (word & 0xFF) == 0;
    return word == 0;
}

parsed parse_diagnostics(bytes pdu)
{
    if (pdu.size() < 3)
        return bad_value;
    const diagnostic what{read_word(pdu, 1)};
    if (!is_known(what))
        return exception_code::illegal_function;  // V1.1b3 section 6.8, figure 18: sub-function not supported
    const bytes data = pdu.subspan(3);
    if (!data_fits(what, data))
        return bad_value;
    return request{diagnostics{what, buffer(data.begin(), data.end())}};
}

constexpr std::uint8_t mei_device_identification = 0x0E;

parsed parse_encapsulated(bytes pdu)
{
    if (pdu.size() < 2 || pdu[1] != mei_device_identification)
        return exception_code::illegal_function;
    if (pdu.size() != 4 || pdu[2] < 1 || pdu[2] > 4)
        return bad_value;
    return request{read_device_identification{read_device_identification::access{pdu[2]}, pdu[3]}};
}

function read_function(table from)
{
    switch (from) {
    case table::coils: return function::read_coils;
    case table::discrete_inputs: return function::read_discrete_inputs;
    case table::input_registers: return function::read_input_registers;
    case table::holding_registers: break;
    }
    return function::read_holding_registers;
}

// Appends what follows the function code, one overload for each struct.
struct encoder {
    buffer& pdu;

    void operator()(const read_table& r) const { words(number(r.first), r.count); }
    void operator()(const write_single_coil& r) const
    {
        words(number(r.at), static_cast<std::uint16_t>(r.on ? 0xFF00 : 0x0000));
    }
    void operator()(const write_single_register& r) const { words(number(r.at), r.value); }
    void operator()(const write_multiple_coils& r) const
    {
        words(number(r.first), static_cast<std::uint16_t>(r.values.size()));
        pdu.push_back(static_cast<std::uint8_t>(packed_size(r.values.size())));
        append_bits(pdu, r.values);
    }
    void operator()(const write_multiple_registers& r) const
    {
        words(number(r.first), static_cast<std::uint16_t>(r.values.size()));
        counted(r.values);
    }
    void operator()(const mask_write_register& r) const
    {
        words(number(r.at), r.and_mask);
        append_word(pdu, r.or_mask);
    }
    void operator()(const read_write_multiple_registers& r) const
    {
        words(number(r.read_first), r.read_count);
        words(number(r.write_first), static_cast<std::uint16_t>(r.values.size()));
        counted(r.values);
    }

    void operator()(const read_exception_status&) const {}
    void operator()(const diagnostics& r) const
    {
        append_word(pdu, static_cast<std::uint16_t>(r.what));
        pdu.insert(pdu.end(), r.data.begin(), r.data.end());
    }
    void operator()(const get_comm_event_counter&) const {}
    void operator()(const get_comm_event_log&) const {}
    void operator()(const report_server_id&) const {}
    void operator()(const read_device_identification& r) const
    {
        pdu.push_back(mei_device_identification);
        pdu.push_back(static_cast<std::uint8_t>(r.how));
        pdu.push_back(r.first_object);
    }

private:
    void words(std::uint16_t first, std::uint16_t second) const
    {
        append_word(pdu, first);
        append_word(pdu, second);
    }
    void counted(const std::vector<std::uint16_t>& values) const
    {
        pdu.push_back(static_cast<std::uint8_t>(2 * values.size()));
        append_words(pdu, values);
    }
};

struct coder {
    function operator()(const read_table& r) const { return read_function(r.from); }
    function operator()(const write_single_coil&) const { return function::write_single_coil; }
    function operator()(const write_single_register&) const { return function::write_single_register; }
    function operator()(const write_multiple_coils&) const { return function::write_multiple_coils; }
    function operator()(const write_multiple_registers&) const { return function::write_multiple_registers; }
    function operator()(const mask_write_register&) const { return function::mask_write_register; }
    function operator()(const read_write_multiple_registers&) const { return function::read_write_multiple_registers; }
    function operator()(const read_exception_status&) const { return function::read_exception_status; }
    function operator()(const diagnostics&) const { return function::diagnostics; }
    function operator()(const get_comm_event_counter&) const { return function::get_comm_event_counter; }
    function operator()(const get_comm_event_log&) const { return function::get_comm_event_log; }
    function operator()(const report_server_id&) const { return function::report_server_id; }
    function operator()(const read_device_identification&) const { return function::encapsulated_interface; }
};

}  // namespace

function function_of(const request& r) { return std::visit(coder{}, r); }

parsed parse_request(bytes pdu)
{
    if (pdu.empty())
        return exception_code::illegal_function;
    switch (static_cast<function>(pdu[0])) {
    case function::read_coils: return parse_read(table::coils, max_read_bits, pdu);
    case function::read_discrete_inputs: return parse_read(table::discrete_inputs, max_read_bits, pdu);
    case function::read_holding_registers: return parse_read(table::holding_registers, max_read_registers, pdu);
    case function::read_input_registers: return parse_read(table::input_registers, max_read_registers, pdu);
    case function::write_single_coil: return parse_write_single_coil(pdu);
    case function::write_single_register: return parse_write_single_register(pdu);
    case function::read_exception_status: return parse_bare<read_exception_status>(pdu);
    case function::diagnostics: return parse_diagnostics(pdu);
    case function::get_comm_event_counter: return parse_bare<get_comm_event_counter>(pdu);
    case function::get_comm_event_log: return parse_bare<get_comm_event_log>(pdu);
    case function::report_server_id: return parse_bare<report_server_id>(pdu);
    case function::encapsulated_interface: return parse_encapsulated(pdu);
    case function::write_multiple_coils: return parse_write_multiple_coils(pdu);
    case function::write_multiple_registers: return parse_write_multiple_registers(pdu);
    case function::mask_write_register: return parse_mask_write(pdu);
    case function::read_write_multiple_registers: return parse_read_write(pdu);
    }
    return exception_code::illegal_function;
}

buffer encode_request(const request& r)
{
    buffer pdu{static_cast<std::uint8_t>(function_of(r))};
    std::visit(encoder{pdu}, r);
    return pdu;
}

}  // namespace plcgw::modbus
