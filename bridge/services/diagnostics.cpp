#include "bridge/services/diagnostics.hpp"

#include "protocols/modbus/wire.hpp"

namespace plcgw {
namespace {

using modbus::diagnostic;

constexpr std::uint32_t first_error_flag = 8060;  // M8060
constexpr unsigned serial_error_bit = 3;          // M8063

constexpr std::uint16_t no_program_command = 0x0000;  // an FX3 has no program commands (7.12)

constexpr std::uint8_t fx3u_id = 0xF3;  // as in computer link (9.1)

buffer word(std::uint16_t value)
{
    buffer data;
    modbus::append_word(data, value);
    return data;
}

}  // namespace

std::uint8_t diagnostic_byte(const diagnosed& d)
{
    unsigned byte = 0;
    for (unsigned i = 0; i < 8; ++i) {
        const std::uint32_t flag = i == serial_error_bit ? d.channel.flags.serial_error : first_error_flag + i;
        byte |= (d.plc.flag(flag) ? 1U : 0U) << i;
    }
    return static_cast<std::uint8_t>(byte);
}

modbus::response serve(const diagnosed& d, const modbus::read_exception_status&)
{
    return modbus::exception_status_read{diagnostic_byte(d)};
}

modbus::response serve(const diagnosed& d, const modbus::diagnostics& r)
{
    switch (r.what) {
    case diagnostic::return_query_data:
    case diagnostic::restart_communications:
    case diagnostic::change_ascii_delimiter:
    case diagnostic::clear_counters: return modbus::diagnostics_answered{r.data};
    case diagnostic::force_listen_only: return modbus::no_response{};
    case diagnostic::return_diagnostic_register: return modbus::diagnostics_answered{word(diagnostic_byte(d))};
    case diagnostic::bus_message_count:
    case diagnostic::bus_communication_error_count:
    case diagnostic::bus_exception_error_count:
    case diagnostic::server_message_count:
    case diagnostic::server_no_response_count:
    case diagnostic::server_nak_count:
    case diagnostic::server_busy_count:
    case diagnostic::bus_character_overrun_count: break;
    }
    return modbus::diagnostics_answered{word(d.counters[counter_of(r.what)])};
}

modbus::response serve(const diagnosed& d, const modbus::get_comm_event_counter&)
{
    return modbus::event_counter_read{no_program_command, d.counters[counter::event]};
}

modbus::response serve(const diagnosed& d, const modbus::get_comm_event_log&)
{
    return modbus::event_log_read{no_program_command, d.counters[counter::event], d.counters[counter::bus_message],
                                  d.log.newest_first()};
}

modbus::response serve(const diagnosed& d, const modbus::report_server_id&)
{
    const bool running = d.plc.state() == plc::run_state::run;
    return modbus::server_id_read{{fx3u_id, running ? std::uint8_t{0xFF} : std::uint8_t{0x00}}};
}

}  // namespace plcgw
