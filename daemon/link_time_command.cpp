#include "daemon/link_time_command.hpp"

#include "bridge/link_time.hpp"
#include "bridge/plc_link.hpp"
#include "bridge/plc_link_time.hpp"

#include <fmt/core.h>

#include <charconv>
#include <cmath>

namespace plcgw {
namespace {

// "8N1": data bits, parity, stop bits.
std::optional<character_format> parse_bits(unsigned baud_rate, const std::string& text)
{
    constexpr std::string_view letters = "NOE";
    if (text.size() != 3 || (text[0] != '7' && text[0] != '8') || (text[2] != '1' && text[2] != '2'))
        return std::nullopt;
    const std::size_t letter = letters.find(static_cast<char>(text[1] & ~0x20));
    if (letter == std::string_view::npos)
        return std::nullopt;
    return character_format{baud_rate, text[0] == '7' ? 7U : 8U, static_cast<parity>(letter), text[2] == '1' ? 1U : 2U};
}

std::optional<modbus::function> parse_function(std::string_view text)
{
    const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
    if (hexadecimal)
        text.remove_prefix(2);
    std::uint8_t code = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), code, hexadecimal ? 16 : 10);
    if (error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return modbus::function{code};
}

duration from_ms(double ms) { return duration{std::llround(ms * 1000)}; }

void print_part(const char* name, duration time, const std::string& what)
{
    fmt::print("  {:<4}{:>10.1f} ms  {}\n", name, static_cast<double>(time.count()) / 1000, what);
}

void print(const client_link_time& t, const link_time_input& in)
{
    const std::string delay =
        in.message_delay < t.t4 ? "message delay: 3.5 characters at least (D8411)" : "message delay (D8411)";
    fmt::print("Tm, the time of the client's PLC\n");
    print_part("T4", t.t4, delay);
    print_part("T1", t.t1, "(INT(T4 / scan) + 1) * scan");
    print_part("T6", t.t6, "less than 1 ms");
    print_part("T7", t.t7, fmt::format("request, {} bytes, + 1 ms", in.request_bytes));
    print_part("T8", t.t8, "server delay");
    print_part("T9", t.t9, fmt::format("response, {} bytes, + 1 ms", in.response_bytes));
    print_part("T10", t.t10, in.mode == plc::framing::rtu ? "3.5 characters + 1 ms" : "nothing in ASCII");
    print_part("T5", t.t5, "T6 + T7 + T8 + T9 + T10");
    print_part("T2", t.t2, "(INT(T5 / scan) + 1) * scan");
    print_part("T3", t.t3, "less than 1 ms");
    print_part("Tm", t.total, "T1 + T2 + T3");
}

void print(const server_link_time& t, const link_time_input& in)
{
    fmt::print("Ts, the time of the server's PLC\n");
    print_part("T14", t.t14, fmt::format("request, {} bytes, + 1 ms", in.request_bytes));
    print_part("T15", t.t15, "message delay (D8411)");
    print_part("T11", t.t11, "T14 + T15 + scan");
    print_part("T12", t.t12, "less than 1 ms");
    print_part("T13", t.t13, fmt::format("response, {} bytes, + 1 ms", in.response_bytes));
    print_part("Ts", t.total, "T11 + T12 + T13");
}

struct question {
    link_time_input in;
    std::string wrong;  // which option, and what it may be
};

question read(const link_time_options& o)
{
    const auto format = parse_bits(o.baud_rate, o.bits);
    const auto function = parse_function(o.function);
    const plc::framing mode = o.framing == "ascii" ? plc::framing::ascii : plc::framing::rtu;
    if (!format)
        return {{}, fmt::format("--bits is \"{}\", expected data bits, parity and stop bits, such as 8E1", o.bits)};
    if (mode == plc::framing::rtu && format->data_bits != 8)
        return {{}, "--bits has 7 data bits, but RTU needs 8"};
    if (o.baud_rate == 0)
        return {{}, "--baud is 0"};
    if (!(o.scan_ms > 0) || from_ms(o.scan_ms) == duration{0})
        return {{}, "--scan is the longest scan time in milliseconds, more than 0"};
    if (!(o.delay_ms >= 0) || !(o.server_delay_ms >= 0))
        return {{}, "--delay and --slave-delay are milliseconds, 0 or more"};
    const auto sizes = function ? sizes_of(*function, o.count, o.write_count) : std::nullopt;
    if (!sizes && !(o.request_bytes && o.response_bytes))
        return {{},
                fmt::format("function {} with --count {} does not exist: expected 1 to 8, 0x0B, 0x0C, 0x0F, 0x10, "
                            "0x11, 0x16 or 0x17 and a count it allows",
                            o.function, o.count)};
    link_time_input in{.format = *format, .mode = mode};
    in.request_bytes = o.request_bytes ? *o.request_bytes : adu_size(sizes->request, mode);
    in.response_bytes = o.response_bytes ? *o.response_bytes : adu_size(sizes->response, mode);
    in.message_delay = from_ms(o.delay_ms);
    in.max_scan = from_ms(o.scan_ms);
    in.server_delay = from_ms(o.server_delay_ms);
    return {in, {}};
}

std::string mistake_in_link(const link_time_options& o)
{
    if (o.link_stations < 2 || o.link_stations > most_link_stations)
        return "--plc-link is the number of stations, 2 to 16";
    if (o.absent >= o.link_stations)
        return "--absent leaves nobody: it is fewer than --plc-link";
    if (o.relay_words.value_or(0) > link_block_relay_words || o.register_words.value_or(0) > link_block_registers)
        return "--relay-words is at most 64, --register-words at most 128";
    if (!(o.scan_ms > 0))
        return "--scan is the scan time of each PLC in milliseconds, more than 0";
    return {};
}

int show_plc_link(const link_time_options& o)
{
    if (const std::string mistake = mistake_in_link(o); !mistake.empty()) {
        fmt::print(stderr, "{}\n", mistake);
        return 1;
    }
    const link_load each{.relay_words = o.relay_words.value_or(link_block_relay_words / o.link_stations),
                         .register_words = o.register_words.value_or(link_block_registers / o.link_stations),
                         .scan = from_ms(o.scan_ms)};
    const std::vector<link_load> joined(o.link_stations - o.absent, each);
    const plc_link_time t =
        round_time({.stations = joined, .master_scan = each.scan, .somebody_absent = o.absent != 0});
    fmt::print("PLC link at {} bit/s, {} stations, {} of them absent, scan {} ms\n", plc_link_baud, o.link_stations,
               o.absent, o.scan_ms);
    fmt::print("T, the longest round\n");
    print_part(
        "Tpc", link_send_time(each),
        fmt::format("{} bytes: {} relay words, {} registers", link_bytes(each), each.relay_words, each.register_words));
    print_part("Ts", t.ts.front(), fmt::format("scan + Tpc, {} times", joined.size()));
    print_part("Tlt", t.tlt, "link table");
    print_part("Tso", t.tso, "scan of the master station");
    print_part("Tlk", t.tlk, o.absent == 0 ? "nobody is absent" : "waits for those that are absent");
    print_part("T", t.total(), "all Ts + Tlt + Tso + Tlk");
    return 0;
}

}  // namespace

int show_link_time(const link_time_options& options)
{
    if (options.link_stations != 0)
        return show_plc_link(options);
    const question q = read(options);
    if (!q.wrong.empty()) {
        fmt::print(stderr, "{}\n", q.wrong);
        return 1;
    }
    fmt::print("{} bit/s, {} bits per character, {}, longest scan {} ms\n", q.in.format.baud_rate,
               bits_per_character(q.in.format), q.in.mode == plc::framing::rtu ? "RTU" : "ASCII", options.scan_ms);
    print(client_time(q.in), q.in);
    print(server_time(q.in), q.in);
    return 0;
}

}  // namespace plcgw
