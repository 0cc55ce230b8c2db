#include "bridge/plc/setup_program.hpp"

#include "bridge/plc/device.hpp"

#include <algorithm>

namespace plcgw::plc {
namespace {

constexpr std::uint32_t configuration_request = 8411;  // M8411

// Valid values of the registers that are checked one by one (FX3 manual 6.1). D8470-D8485 are checked as sets by
// modbus_map, D8412 is limited to 20 and not refused.
struct register_rule {
    std::uint32_t number;
    std::uint32_t first_valid;
    std::uint32_t last_valid;
};

constexpr register_rule rules[] = {
    {8409, 0, 32767}, {8429, 0, 32767},  // response timeout, ms
    {8410, 0, 32767}, {8430, 0, 32767},  // turnaround delay, ms
    {8411, 0, 16382}, {8431, 0, 16382},  // message to message delay, ms
    {8414, 1, 247},   {8434, 1, 247},    // own station number
};

constexpr std::uint32_t settable[][2] = {{8400, 8401}, {8406, 8406}, {8409, 8417}, {8420, 8421},
                                         {8426, 8426}, {8429, 8437}, {8470, 8485}};

bool is_settable(std::uint32_t number)
{
    return std::any_of(std::begin(settable), std::end(settable),
                       [&](const auto& range) { return number >= range[0] && number <= range[1]; });
}

class parser {
public:
    void take(std::size_t line, const std::vector<std::string>& words)
    {
        const std::string& instruction = words[0];
        if (instruction == "LD")
            load(line, words);
        else if (instruction == "MOV")
            move(line, words);
        else if (instruction == "LDI" || instruction == "LDP" || instruction == "LDF")
            other_contact(line, words);
        else if (instruction == "ADPRW" || instruction == "ADPRWP")
            adprw();
        else if (instruction == "END")
            in_block_ = false;
        else if (instruction == "AND" || instruction == "ANI" || instruction == "OR" || instruction == "ORI" ||
                 instruction == "OUT" || instruction == "SET" || instruction == "RST")
            contact_or_coil(line, words);
        else
            mistake(line, "unknown instruction \"" + instruction + "\": a program holds LD, MOV, ADPRW and END");
    }

    setup_program result()
    {
        if (!saw_block_ && program_.mistakes.empty() && saw_move_ && !saw_adprw_)
            mistake(1, "no LD M8411: the MOVs of a setup program stand below it");
        return std::move(program_);
    }

private:
    void load(std::size_t line, const std::vector<std::string>& words)
    {
        if (words.size() != 2 || !parse_device(words[1])) {
            mistake(line, "LD takes one device, for example LD M8411");
            return;
        }
        in_block_ = *parse_device(words[1]) == device{device_kind::m, configuration_request};
        below_contact_ = true;
        doubt_.reset();
        if (!in_block_)
            return;
        // With two blocks only the last counts (5.4, caution 3): forget what the one before said.
        saw_block_ = true;
        program_.is_void = false;
        program_.registers.clear();
        program_.lines.clear();
        program_.fault.reset();
    }

    void move(std::size_t line, const std::vector<std::string>& words)
    {
        saw_move_ = true;
        const auto to = words.size() == 3 ? parse_device(words[2]) : std::nullopt;
        if (!to) {
            mistake(line, "MOV takes a constant and a device, for example MOV K10 D8411");
            return;
        }
        if (!in_block_) {
            if (saw_block_ || below_contact_)
                return;  // ordinary program below another contact: not ours
            mistake(line, "MOV stands above LD M8411");
            return;
        }
        if (doubt_ && (to->kind != device_kind::d || !is_settable(to->number))) {
            in_block_ = false;  // the contact has begun an ordinary rung
            return;
        }
        if (doubt_) {
            make_void(doubt_->line, between(doubt_->text));
            return;
        }
        const auto value = parse_constant(words[1]);
        if (!value && parse_device(words[1])) {
            make_void(line, "the source " + words[1] + " is no constant: the whole block is void (5.4, caution 4)");
            return;
        }
        if (!value) {
            mistake(line, words[1] + " is no constant: K-32768 to K65535 or H0 to HFFFF");
            return;
        }
        if (to->kind != device_kind::d || !is_settable(to->number)) {
            mistake(line, to_string(*to) + " is no MODBUS setting: D8400-D8439 and D8470-D8485 are");
            return;
        }
        set(line, to->number, *value);
    }

    void set(std::size_t line, std::uint32_t number, std::uint16_t value)
    {
        if (program_.is_void)
            return;
        const auto rule = std::find_if(std::begin(rules), std::end(rules),
                                       [&](const register_rule& r) { return r.number == number; });
        if (rule != std::end(rules) && (value < rule->first_valid || value > rule->last_valid)) {
            fault(line, number,
                  "D" + std::to_string(number) + " = " + std::to_string(value) + " is not within " +
                      std::to_string(rule->first_valid) + " to " + std::to_string(rule->last_valid));
            return;
        }
        program_.registers[number] = value;
        program_.lines[number] = line;
    }

    void contact_or_coil(std::size_t line, const std::vector<std::string>& words)
    {
        if (words.size() < 2 || !parse_device(words[1]))
            mistake(line, words[0] + " takes a device");
        else if (in_block_ && !doubt_)
            make_void(line, between(words[0] + " " + words[1]));
    }

    // They begin a rung as LD does. Whether an LDI stands between the MOVs is known at the next one.
    void other_contact(std::size_t line, const std::vector<std::string>& words)
    {
        below_contact_ = true;
        if (words.size() < 2 || !parse_device(words[1]))
            mistake(line, words[0] + " takes a device");
        else if (words[0] != "LDI")
            in_block_ = false;
        else if (in_block_ && !doubt_)
            doubt_ = program_mistake{line, words[0] + " " + words[1]};
    }

    void adprw()
    {
        saw_adprw_ = true;
        if (doubt_)
            in_block_ = false;
    }

    static std::string between(const std::string& what)
    {
        return what + " between LD M8411 and its MOVs: the whole block is void (5.4, caution 3)";
    }

    void make_void(std::size_t line, std::string reason)
    {
        program_.registers.clear();
        program_.lines.clear();
        program_.fault.reset();
        program_.is_void = true;
        fault(line, configuration_request, std::move(reason));
    }

    void fault(std::size_t line, std::uint32_t detail, std::string reason)
    {
        if (!program_.fault)
            program_.fault = parameter_fault{detail, line, std::move(reason)};
    }

    void mistake(std::size_t line, std::string text) { program_.mistakes.push_back({line, std::move(text)}); }

    setup_program program_;
    bool in_block_ = false;
    bool saw_block_ = false;
    bool saw_move_ = false;
    bool saw_adprw_ = false;
    bool below_contact_ = false;
    std::optional<program_mistake> doubt_;  // an LDI that may stand between LD M8411 and its MOVs
};

}  // namespace

setup_program parse_setup_program(std::string_view text)
{
    parser p;
    for (const program_line& each : program_lines(text))
        p.take(each.line, each.words);
    return p.result();
}

}  // namespace plcgw::plc
