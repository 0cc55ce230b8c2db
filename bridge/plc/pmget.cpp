#include "bridge/plc/pmget.hpp"

#include <algorithm>

namespace plcgw::plc {
namespace {

constexpr unsigned baud_rates[] = {300, 600, 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400};
constexpr std::uint16_t unlisted = 0xFFFF;

constexpr duration step{10};  // 0.01 ms
constexpr std::int64_t most_steps = 10000;

constexpr std::uint8_t first_uncounted = 8;

std::uint16_t word(std::size_t value) { return static_cast<std::uint16_t>(value); }

std::uint16_t bit(std::uint8_t number) { return word(1U << number); }

std::uint16_t baud_code(unsigned rate)
{
    const auto* const found = std::find(std::begin(baud_rates), std::end(baud_rates), rate);
    return found == std::end(baud_rates) ? unlisted : word(static_cast<std::size_t>(found - std::begin(baud_rates)));
}

std::uint16_t steps(duration t)
{
    return static_cast<std::uint16_t>(std::clamp<std::int64_t>(t / step, 0, most_steps));
}

}  // namespace

// D+11 is the modem, which is not initialised; D+12, D+13 and D+22 to D+25 are reserved.
std::array<std::uint16_t, pmget_parameters> parameter_words(const com_parameters& of)
{
    std::array<std::uint16_t, pmget_parameters> words{
        static_cast<std::uint16_t>(of.mode),
        word(of.station),
        baud_code(of.format.baud_rate),
        word(of.format.data_bits == 8 ? 1 : 0),
        static_cast<std::uint16_t>(of.format.check),  // none, odd, even in both
        word(of.format.stop_bits - 1),
        word(of.rs_cs ? 1 : 0),
        steps(of.send_wait),
        static_cast<std::uint16_t>(of.start),
        static_cast<std::uint16_t>(of.end),
        steps(of.end_silence),
    };
    if (of.mode == com_mode::plc_link && of.link) {
        const plc_link_settings& link = *of.link;
        const unsigned shown[] = {
            link.block,       effective_max_station(link), link.relay_words,   link.register_words, link.relay_first,
            link.relay_count, link.register_first,         link.register_count};
        std::transform(std::begin(shown), std::end(shown), words.begin() + 14, word);
    }
    return words;
}

std::array<std::uint16_t, pmget_monitor_words> monitor_words(const com_monitor& of)
{
    return {static_cast<std::uint16_t>(of.mode),
            static_cast<std::uint16_t>(of.card),
            of.receive_errors,
            of.receive_error_count,
            of.setting_errors,
            of.wrong_parameter,
            of.modem};
}

void note(com_monitor& in, receive_error what)
{
    const auto number = static_cast<std::uint8_t>(what);
    in.receive_errors = word(in.receive_errors | bit(number));
    if (number < first_uncounted)
        ++in.receive_error_count;
}

void note(com_monitor& in, setting_error what, std::uint16_t wrong_parameter)
{
    in.setting_errors = word(in.setting_errors | bit(static_cast<std::uint8_t>(what)));
    if (what == setting_error::parameters)
        in.wrong_parameter = wrong_parameter;
}

void clear_errors(com_monitor& in)
{
    in.receive_errors = 0;
    in.receive_error_count = 0;
    in.setting_errors = word(in.setting_errors & ~bit(static_cast<std::uint8_t>(setting_error::send_count)));
}

}  // namespace plcgw::plc
