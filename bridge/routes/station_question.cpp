#include "bridge/routes/station_question.hpp"

#include <algorithm>

namespace plcgw {
namespace {

std::string exception_text(modbus::exception_code code)
{
    constexpr std::string_view digits = "0123456789ABCDEF";
    const auto value = static_cast<unsigned>(code);
    return std::string("exception ") + digits[value / 16 % 16] + digits[value % 16] + " (" +
           std::string(modbus::to_string(code)) + ")";
}

station_refusal::cause cause_of(modbus::exception_code code)
{
    switch (code) {
    case modbus::exception_code::illegal_data_address: return station_refusal::cause::place;
    case modbus::exception_code::illegal_data_value: return station_refusal::cause::length;
    default: return station_refusal::cause::other;
    }
}

station_refusal::cause cause_of(mewtocol::error_code code)
{
    switch (code) {
    case mewtocol::error_code::parameter:
    case mewtocol::error_code::data:
    case mewtocol::error_code::address: return station_refusal::cause::place;
    case mewtocol::error_code::frame_too_long: return station_refusal::cause::length;
    default: return station_refusal::cause::other;
    }
}

std::optional<station_refusal> refusal_of(const modbus::response& answer)
{
    const auto* const code = std::get_if<modbus::exception_code>(&answer);
    if (code == nullptr)
        return std::nullopt;
    const bool may_pass =
        *code == modbus::exception_code::acknowledge || *code == modbus::exception_code::server_device_busy;
    return station_refusal{exception_text(*code), may_pass, cause_of(*code), static_cast<std::uint16_t>(*code)};
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
                           mewtocol::is_passing(*code), cause_of(*code), static_cast<std::uint16_t>(*code)};
}

// One overload for each response that carries values; the others stay as they are.
struct cutter {
    std::size_t offset;
    std::size_t count;

    void operator()(modbus::bits_read& answer) const { cut(answer.values); }
    void operator()(modbus::registers_read& answer) const { cut(answer.values); }
    void operator()(mewtocol::contacts_read& answer) const { cut(answer.values); }
    void operator()(mewtocol::words_read& answer) const { cut(answer.values); }
    template <class Other>
    void operator()(Other&) const
    {
    }

private:
    template <class Values>
    void cut(Values& values) const
    {
        const auto at = [&](std::size_t i) { return static_cast<std::ptrdiff_t>(std::min(i, values.size())); };
        values = Values(values.begin() + at(offset), values.begin() + at(offset + count));
    }
};

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

station_place moved_to(station_place p, std::uint32_t number)
{
    if (auto* const of_modbus = std::get_if<modbus_place>(&p)) {
        of_modbus->first = modbus::address{static_cast<std::uint16_t>(number)};
        return p;
    }
    auto& device = std::get<mewtocol::device>(p);
    if (auto* const contact = std::get_if<mewtocol::contact>(&device))
        contact->number = static_cast<std::uint16_t>(number);
    else
        std::get<mewtocol::word_device>(device).number = number;
    return p;
}

station_question read_question(const station_place& first, std::uint32_t count)
{
    if (const auto* const of_modbus = std::get_if<modbus_place>(&first))
        return modbus::request{
            modbus::read_table{of_modbus->table, of_modbus->first, static_cast<std::uint16_t>(count)}};
    const auto& device = std::get<mewtocol::device>(first);
    if (const auto* const contact = std::get_if<mewtocol::contact>(&device))
        return mewtocol::block{mewtocol::read_run{*contact, count}};
    const auto& word = std::get<mewtocol::word_device>(device);
    return mewtocol::block{mewtocol::read_words{word.area, word.number, count}};
}

station_answer part_of(const station_answer& answer, std::size_t offset, std::size_t count)
{
    station_answer part = answer;
    std::visit([&](auto& of_protocol) { std::visit(cutter{offset, count}, of_protocol); }, part);
    return part;
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
