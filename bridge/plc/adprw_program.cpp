#include "bridge/plc/adprw_program.hpp"

#include "bridge/plc/model.hpp"

#include <algorithm>

namespace plcgw::plc {
namespace {

constexpr std::uint32_t initial_pulse = 8002;
constexpr std::uint32_t configuration_request = 8411;

// Steps that an instruction takes in program memory; 0: it depends on the device.
struct length_row {
    std::string_view name;
    std::uint32_t steps;
};

constexpr length_row lengths[] = {
    {"LD", 1},  {"LDI", 1},  {"AND", 1},  {"ANI", 1},    {"OR", 1},      {"ORI", 1}, {"LDP", 2},
    {"LDF", 2}, {"ANDP", 2}, {"ANDF", 2}, {"ORP", 2},    {"ORF", 2},     {"OUT", 0}, {"SET", 0},
    {"RST", 0}, {"END", 1},  {"MOV", 5},  {"ADPRW", 11}, {"ADPRWP", 11},
};

std::uint32_t coil_length(const std::string& name, std::optional<device> at)
{
    if (!at)
        return 1;
    switch (at->kind) {
    case device_kind::d:
    case device_kind::r: return 3;
    case device_kind::ts:
    case device_kind::cs: return name == "OUT" ? 3 : 2;
    case device_kind::s: return 2;
    case device_kind::m: return at->number >= special_first ? 2 : 1;
    default: return 1;
    }
}

std::uint32_t length_of(const program_line& l)
{
    const auto row =
        std::find_if(std::begin(lengths), std::end(lengths), [&](const length_row& r) { return r.name == l.words[0]; });
    if (row == std::end(lengths))
        return 1;
    return row->steps != 0 ? row->steps
                           : coil_length(l.words[0], l.words.size() > 1 ? parse_device(l.words[1]) : std::nullopt);
}

std::optional<contact::kind> contact_kind(const std::string& instruction)
{
    if (instruction == "LD")
        return contact::kind::open;
    if (instruction == "LDI")
        return contact::kind::closed;
    if (instruction == "LDP")
        return contact::kind::rising;
    if (instruction == "LDF")
        return contact::kind::falling;
    return std::nullopt;
}

bool is_contact(std::string_view instruction)
{
    return instruction.starts_with("AND") || instruction.starts_with("ANI") || instruction.starts_with("OR");
}

bool is_register(const std::optional<device>& at)
{
    return at && (at->kind == device_kind::d || at->kind == device_kind::r);
}

std::optional<operand> parse_operand(const std::string& word)
{
    if (const auto constant = parse_constant(word))
        return *constant;
    const auto at = parse_device(word);
    switch (at ? at->kind : device_kind::tn) {
    case device_kind::x:
    case device_kind::y:
    case device_kind::m:
    case device_kind::s:
    case device_kind::d:
    case device_kind::r: return *at;
    default: return std::nullopt;
    }
}

std::string why_no_operand(const std::string& word)
{
    if (word[0] == 'K' || word[0] == 'H')
        return "is no constant: K-32768 to K65535 or H0 to HFFFF";
    const std::size_t index = word.find_first_of("ZV");
    if (index != 0 && index != std::string::npos)
        return "has an index register, which is not simulated: write the device itself";
    return "is none of K, H, D, R, M, X, Y, S";
}

class parser {
public:
    void take(const program_line& l)
    {
        step_ = l.step.value_or(step_);
        if (const auto kind = contact_kind(l.words[0]))
            begin_rung(*kind, l);
        else if (is_contact(l.words[0]))
            spoil(l.words[0] + " stands above it, but one contact alone drives an ADPRW");
        else if (l.words[0] == "MOV")
            take_move(l);
        else if (l.words[0] == "ADPRW" || l.words[0] == "ADPRWP")
            take_adprw(l);
        else if (l.words[0] == "END")
            spoil("END stands above it");
        step_ += length_of(l);
    }

    adprw_program result() { return std::move(program_); }

private:
    void begin_rung(contact::kind kind, const program_line& l)
    {
        contact_.reset();
        const auto at = l.words.size() == 2 ? parse_device(l.words[1]) : std::nullopt;
        if (!at || !is_bit_kind(at->kind))
            spoil("the contact above it is none");
        else if (at == device{device_kind::m, configuration_request})
            spoil("LD M8411 is for the MOVs of the communication setup");
        else
            contact_ = contact{kind, *at};
    }

    void spoil(std::string why)
    {
        contact_.reset();
        why_no_contact_ = std::move(why);
    }

    void take_move(const program_line& l)
    {
        const auto to = l.words.size() == 3 ? parse_device(l.words[2]) : std::nullopt;
        if (!contact_ || !is_register(to))
            return;
        const auto constant = parse_constant(l.words[1]);
        const auto from = parse_device(l.words[1]);
        if (constant)
            add(l, mov{*constant, *to});
        else if (is_register(from))
            add(l, mov{*from, *to});
    }

    void take_adprw(const program_line& l)
    {
        adprw made;
        if (!contact_)
            mistake(l, why_no_contact_ + ": put LD M8000 above it to run it always, LDP M0 for once");
        if (l.words.size() != made.operands.size() + 1) {
            mistake(l, "takes five operands, for example " + l.words[0] + " H5 H3 H0 K10 D100");
            return;
        }
        bool readable = true;
        for (std::size_t i = 0; i < made.operands.size(); ++i) {
            if (const auto read = parse_operand(l.words[i + 1])) {
                made.operands[i] = *read;
                continue;
            }
            readable = false;
            mistake(l,
                    "operand " + std::to_string(i + 1) + ", " + l.words[i + 1] + ", " + why_no_operand(l.words[i + 1]));
        }
        if (contact_ && readable)
            add(l, made);
    }

    void add(const program_line& l, std::variant<mov, adprw> what)
    {
        const bool edge = contact_->how == contact::kind::rising || contact_->how == contact::kind::falling;
        const bool once = edge || l.words[0] == "ADPRWP" ||
                          *contact_ == contact{contact::kind::open, {device_kind::m, initial_pulse}};
        program_.instructions.push_back({l.line, static_cast<std::uint16_t>(step_), *contact_, once, what});
    }

    void mistake(const program_line& l, const std::string& text)
    {
        program_.mistakes.push_back({l.line, l.words[0] + ": " + text});
    }

    adprw_program program_;
    std::optional<contact> contact_;  // of the rung
    std::string why_no_contact_ = "no contact stands above it";
    std::uint32_t step_ = 0;
};

}  // namespace

bool adprw_program::asks() const
{
    return std::any_of(instructions.begin(), instructions.end(),
                       [](const instruction& i) { return std::holds_alternative<adprw>(i.what); });
}

adprw_program parse_adprw_program(std::string_view text)
{
    parser p;
    for (const program_line& each : program_lines(text))
        p.take(each);
    return p.result();
}

}  // namespace plcgw::plc
