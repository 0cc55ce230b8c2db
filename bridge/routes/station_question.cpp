#include "bridge/routes/station_question.hpp"

namespace plcgw {
namespace {

std::string exception_text(modbus::exception_code code)
{
    constexpr std::string_view digits = "0123456789ABCDEF";
    const auto value = static_cast<unsigned>(code);
    return std::string("exception ") + digits[value / 16 % 16] + digits[value % 16] + " (" +
           std::string(modbus::to_string(code)) + ")";
}

std::optional<station_refusal> refusal_of(const modbus::response& answer)
{
    const auto* const code = std::get_if<modbus::exception_code>(&answer);
    if (code == nullptr)
        return std::nullopt;
    const bool may_pass =
        *code == modbus::exception_code::acknowledge || *code == modbus::exception_code::server_device_busy;
    return station_refusal{exception_text(*code), may_pass, static_cast<std::uint16_t>(*code)};
}

std::string with_result(std::string text, mewtocol::result_code code)
{
    return std::move(text.append(", result ").append(std::to_string(static_cast<unsigned>(code))));
}

std::optional<station_refusal> refusal_of(const mewtocol::response& answer)
{
    const auto* const code = std::get_if<mewtocol::error_code>(&answer);
    if (code == nullptr)
        return std::nullopt;
    return station_refusal{with_result("error " + mewtocol::to_string(*code), mewtocol::result_code::bad_response),
                           mewtocol::is_passing(*code), static_cast<std::uint16_t>(*code)};
}

}  // namespace

bool is_bits(const station_place& p)
{
    if (const auto* const of_modbus = std::get_if<modbus_place>(&p))
        return modbus::is_bit_table(of_modbus->table);
    return mewtocol::is_contact(std::get<mewtocol::device>(p));
}

std::string area_name(const station_place& p)
{
    if (const auto* const of_modbus = std::get_if<modbus_place>(&p))
        return std::string(modbus::to_string(of_modbus->table));
    return std::string(mewtocol::area_name(std::get<mewtocol::device>(p)));
}

std::uint32_t number(const station_place& p)
{
    if (const auto* const of_modbus = std::get_if<modbus_place>(&p))
        return modbus::number(of_modbus->first);
    return mewtocol::number(std::get<mewtocol::device>(p));
}

std::optional<station_refusal> refusal_in(const station_answer& answer)
{
    return std::visit([](const auto& of_protocol) { return refusal_of(of_protocol); }, answer);
}

std::string reason_of(const station_question& asked, const boost::system::error_code& why)
{
    if (std::holds_alternative<modbus::request>(asked))
        return why.message();
    return with_result(why.message(), mewtocol::result_of(result<mewtocol::response>(why)));
}

}  // namespace plcgw
