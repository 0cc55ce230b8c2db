#include "daemon/map_command.hpp"

#include "bridge/plc/map_query.hpp"
#include "bridge/plc/simulated_plc.hpp"
#include "daemon/config/program_file.hpp"
#include "daemon/config/read.hpp"
#include "daemon/run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <memory>

namespace plcgw {
namespace {

using plc::device;
using plc::map_address;
using plc::simulated_plc;
using plcs = std::vector<std::unique_ptr<simulated_plc>>;
using modbus::table;

constexpr table tables[] = {table::coils, table::discrete_inputs, table::input_registers, table::holding_registers};

struct table_words {
    const char* name;
    const char* prefix;  // of a question
};

table_words words_of(table t)
{
    constexpr table_words words[] = {
        {"coil", "coil"}, {"discrete input", "di"}, {"input register", "ir"}, {"holding register", "hr"}};
    return words[static_cast<std::size_t>(t)];
}

std::string number_text(map_address at)
{
    return fmt::format("{}:{} (0x{:04X})", words_of(at.table).prefix, at.number, at.number);
}

std::string reference_text(map_address at)
{
    const plc::reference r = plc::reference_of(at);
    return r.five_digits.empty() ? r.six_digits : r.five_digits + " / " + r.six_digits;
}

std::string target_text(const simulated_plc& of, const plc::map_target& target)
{
    std::string text = plc::names_of(of.model(), target.first, target.last);
    if (target.of_device == plc::map_target::part::low_word)
        text += ", low word";
    if (target.of_device == plc::map_target::part::high_word)
        text += ", high word";
    return text;
}

// In one register: which of its bits the devices are.
std::string bits_text(const plc::map_target& target)
{
    if (!plc::is_bit_kind(target.first.kind))
        return {};
    return fmt::format(", bits {} to {}", target.first_bit,
                       target.first_bit + target.last.number - target.first.number);
}

void print_line(table t, std::uint32_t first, std::uint32_t last, const std::string& what)
{
    fmt::print("{:<17} {:>5}-{:<5}  {:04X}-{:04X}  {}\n", words_of(t).name, first, last, first, last, what);
}

void print_table(const simulated_plc& of, table t)
{
    std::uint32_t expected = 0;
    for (const plc::map_row& row : of.map().rows()) {
        if (row.table != t)
            continue;
        if (row.first > expected)
            print_line(t, expected, row.first - 1, "-");
        const plc::map_target behind = plc::target_of(of.model(), row);
        std::string what = target_text(of, behind);
        if (behind.first_bit != 0)
            what += fmt::format(", from bit {} on", behind.first_bit);
        print_line(t, row.first, row.first + row.count - 1, what);
        expected = row.first + row.count;
    }
    if (expected == 0)
        fmt::print("{:<17} none\n", words_of(t).name);
}

void print_header(const simulated_plc& of)
{
    const auto rows = of.map().rows();
    const auto& standard = of.model().standard_map;
    const bool is_standard = std::equal(
        rows.begin(), rows.end(), standard.begin(), standard.end(), [](const plc::map_row& a, const plc::map_row& b) {
            return a.table == b.table && a.first == b.first && a.count == b.count && a.head == b.head;
        });
    fmt::print("{}{}{}, {}\n", of.name(), of.name().empty() ? "" : ": ", of.model().name,
               is_standard ? "default map" : "coils and holding registers as D8470-D8485 allocate them");
    if (const auto& fault = of.fault())
        fmt::print("error 202, detail {}: {}\n", fault->detail, fault->reason);
}

void print_map(const simulated_plc& of)
{
    print_header(of);
    for (const table t : tables)
        print_table(of, t);
    fmt::print("What leads nowhere (-) is answered with exception 02.\n");
}

void print_trimmed(std::string line)
{
    line.erase(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", line);
}

// Where a device is found, one line each; nothing when no number leads to it.
bool answer_device(const simulated_plc& of, device d)
{
    const auto found = plc::addresses_of(of.model(), of.map().rows(), d);
    for (const plc::device_address& each : found) {
        std::string where;
        if (each.bit)
            where = fmt::format("bit {}", *each.bit);
        if (each.count == 2)
            where = "and the next, low word first";
        else if (each.count > 2)
            where = fmt::format("and the next {}, bit 0 first", each.count - 1);
        print_trimmed(fmt::format("{:<8} {:<17} {:<20} {:<15}  {}", plc::name_of(of.model(), d),
                                  words_of(each.at.table).name, number_text(each.at), reference_text(each.at), where));
    }
    return !found.empty();
}

std::string why_not(const simulated_plc& of, device d)
{
    const std::string name = plc::name_of(of.model(), d);
    if (plc::exists(of.model(), d))
        return fmt::format("{}: no MODBUS number leads to it", name);
    const std::string has = plc::ranges_of(of.model(), d.kind);
    return fmt::format("{}: an {} has no such device{}{}", name, of.model().name, has.empty() ? "" : ", but ", has);
}

bool answer(const simulated_plc& of, const std::vector<device>& devices)
{
    bool answered = false;
    for (const device& each : devices)
        answered = answer_device(of, each) || answered;
    if (!answered)
        fmt::print(stderr, "{}\n", why_not(of, devices.front()));
    return answered;
}

bool answer(const simulated_plc& of, map_address at)
{
    const auto target = plc::target_of(of.model(), of.map().rows(), at);
    if (!target) {
        fmt::print(stderr, "{}: leads nowhere in an {}, exception 02\n", number_text(at), of.model().name);
        return false;
    }
    const std::string bits = modbus::is_bit_table(at.table) ? "" : bits_text(*target);
    fmt::print("{:<17} {:<20} {:<15}  {}{}\n", words_of(at.table).name, number_text(at), reference_text(at),
               target_text(of, *target), bits);
    return true;
}

// Empty when some model can read the question: each has names of its own.
std::string mistake_in(const plcs& of, const std::string& text)
{
    std::string first;
    for (const auto& each : of) {
        const auto query = plc::parse_map_query(text, each->model());
        if (query)
            return {};
        if (first.empty())
            first = query.error();
    }
    return first;
}

int answer_all(const plcs& of, const std::vector<std::string>& queries)
{
    for (const std::string& text : queries) {
        const std::string mistake = mistake_in(of, text);
        if (mistake.empty())
            continue;
        fmt::print(stderr, "{}\n", mistake);
        return 1;
    }
    std::vector<bool> answered(queries.size(), false);
    for (const auto& each : of) {
        if (of.size() > 1)
            print_header(*each);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const auto query = plc::parse_map_query(queries[i], each->model());
            if (query && std::visit([&](const auto& q) { return answer(*each, q); }, *query))
                answered[i] = true;
        }
    }
    return std::find(answered.begin(), answered.end(), false) == answered.end() ? 0 : 1;
}

// As the gateway makes them.
plcs plcs_of(const config::loaded& from)
{
    plcs made;
    for (const plc_config& each : from.config.plcs)
        made.push_back(std::make_unique<simulated_plc>(
            each.name, *plc::find_model(each.model),
            plc::parse_setup_program(config::program_text(each, from.folder).value_or(""))));
    return made;
}

template <class List, class Name>
std::string joined(const List& list, Name name)
{
    std::string text;
    for (const auto& each : list)
        text.append(text.empty() ? "" : ", ").append(name(*each));
    return text;
}

plcs by_model(const std::string& name)
{
    plcs made;
    if (const plc::model* const model = plc::find_model(name))
        made.push_back(std::make_unique<simulated_plc>("", *model, plc::setup_program{}));
    else
        fmt::print(stderr, "--model is \"{}\", expected one of: {}\n", name,
                   joined(plc::all_models(), [](const plc::model& m) { return m.name; }));
    return made;
}

plcs by_configuration(const map_options& options)
{
    const config::loaded loaded = config::load_file(options.config_file);
    if (config::has_errors(loaded.found)) {
        check(options.config_file);  // says what is wrong with it
        return {};
    }
    plcs made = plcs_of(loaded);
    const std::string known = joined(made, [](const simulated_plc& p) { return p.name(); });
    if (!options.plc.empty())
        std::erase_if(made, [&](const auto& each) { return each->name() != options.plc; });
    if (made.empty())
        fmt::print(stderr, "{}: {}\n", options.config_file,
                   known.empty() ? "has no PLC" : fmt::format("has no PLC \"{}\", but {}", options.plc, known));
    return made;
}

}  // namespace

int show_map(const map_options& options)
{
    const plcs shown = options.model.empty() ? by_configuration(options) : by_model(options.model);
    if (shown.empty())
        return 1;
    if (!options.queries.empty())
        return answer_all(shown, options.queries);
    for (const auto& each : shown)
        print_map(*each);
    return 0;
}

}  // namespace plcgw
