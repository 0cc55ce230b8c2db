#include "bridge/link_time.hpp"

namespace plcgw {
namespace {

enum class payload : std::uint8_t {
    fixed,
    bits_in_response,
    words_in_response,
    bits_in_request,
    words_in_request,
    both
};

struct size_row {
    modbus::function code;
    std::size_t request;  // bytes without items
    std::size_t response;
    payload items;
    std::size_t most;  // items
};

constexpr std::size_t most_events = 64;

constexpr size_row rows[] = {
    {modbus::function::read_coils, 5, 2, payload::bits_in_response, modbus::max_read_bits},
    {modbus::function::read_discrete_inputs, 5, 2, payload::bits_in_response, modbus::max_read_bits},
    {modbus::function::read_holding_registers, 5, 2, payload::words_in_response, modbus::max_read_registers},
    {modbus::function::read_input_registers, 5, 2, payload::words_in_response, modbus::max_read_registers},
    {modbus::function::write_single_coil, 5, 5, payload::fixed, 1},
    {modbus::function::write_single_register, 5, 5, payload::fixed, 1},
    {modbus::function::read_exception_status, 1, 2, payload::fixed, 1},
    {modbus::function::diagnostics, 5, 5, payload::fixed, 1},
    {modbus::function::get_comm_event_counter, 1, 5, payload::fixed, 1},
    {modbus::function::write_multiple_coils, 6, 5, payload::bits_in_request, modbus::max_write_coils},
    {modbus::function::write_multiple_registers, 6, 5, payload::words_in_request, modbus::max_write_registers},
    {modbus::function::report_server_id, 1, 4, payload::fixed, 1},
    {modbus::function::mask_write_register, 7, 7, payload::fixed, 1},
    {modbus::function::read_write_multiple_registers, 10, 2, payload::both, modbus::max_read_registers},
};

}  // namespace

std::optional<pdu_sizes> sizes_of(modbus::function f, std::size_t count, std::size_t write_count)
{
    if (f == modbus::function::get_comm_event_log)
        return count > most_events ? std::nullopt : std::optional(pdu_sizes{1, 8 + count});
    const auto* const row =
        std::find_if(std::begin(rows), std::end(rows), [f](const size_row& r) { return r.code == f; });
    if (row == std::end(rows) || count < 1 || count > row->most)
        return std::nullopt;
    switch (row->items) {
    case payload::fixed: return pdu_sizes{row->request, row->response};
    case payload::bits_in_response: return pdu_sizes{row->request, row->response + (count + 7) / 8};
    case payload::words_in_response: return pdu_sizes{row->request, row->response + 2 * count};
    case payload::bits_in_request: return pdu_sizes{row->request + (count + 7) / 8, row->response};
    case payload::words_in_request: return pdu_sizes{row->request + 2 * count, row->response};
    case payload::both: break;
    }
    if (write_count < 1 || write_count > modbus::max_read_write_registers)
        return std::nullopt;
    return pdu_sizes{row->request + 2 * write_count, row->response + 2 * count};
}

}  // namespace plcgw
