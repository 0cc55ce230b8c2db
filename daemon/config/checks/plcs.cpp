#include "bridge/plc/adprw_program.hpp"
#include "bridge/plc/simulated_plc.hpp"
#include "daemon/config/checks/checks.hpp"
#include "daemon/config/program_file.hpp"

#include <algorithm>

namespace plcgw::config {
namespace {

void complain_program(check_context& c, std::size_t i, const plc_config& p, std::size_t line, const std::string& what,
                      mistake::weight how)
{
    if (!p.program_file.empty()) {
        c.complain(item("plcs", i, "program_file"), p.program_file + " line " + std::to_string(line) + ": " + what,
                   how);
        return;
    }
    const std::string row = line == 0 ? "" : "/" + std::to_string(line - 1);
    c.complain(item("plcs", i, "program") + row, what, how);
}

// " in D8402 and D8403", as far as the model has them.
std::string shown_in(const plc::model& model, unsigned channel)
{
    for (const plc::channel& each : model.channels)
        if (each.number == channel && each.registers.error_detail != 0)
            return " in D" + std::to_string(each.registers.error_code) + " and D" +
                   std::to_string(each.registers.error_detail);
    return {};
}

void check_program(check_context& c, std::size_t i, const plc_config& p, const plc::model& model,
                   const std::string& text)
{
    plc::setup_program program = plc::parse_setup_program(text);
    for (const plc::program_mistake& m : program.mistakes)
        complain_program(c, i, p, m.line, m.text, mistake::weight::error);
    for (const plc::program_mistake& m : plc::parse_adprw_program(text).mistakes)
        complain_program(c, i, p, m.line, m.text, mistake::weight::error);
    const plc::simulated_plc powered_on(p.name, model, std::move(program));
    for (const plc::setup_fault& fault : powered_on.faults())
        complain_program(c, i, p, fault.what.line,
                         fault.what.reason + "; the PLC runs without it and shows error " +
                             std::to_string(static_cast<unsigned>(fault.code)) + " with detail " +
                             std::to_string(fault.what.detail) + shown_in(model, fault.channel),
                         mistake::weight::warning);
}

// A COM port of an FP7: whose line it is that its flags and PMGET show. 1.1.4 and 7.1: MEWTOCOL7-COM has no master.
void check_com_ports(check_context& c, std::size_t i, const plc_config& p, const plc::model& model)
{
    for (std::size_t n = 0; n < p.channels.size(); ++n) {
        const std::string at = item("plcs", i, "channels") + "/" + std::to_string(n);
        const auto* const line = c.line(p.channels[n].line, at + "/line");
        constexpr line_protocol spoken[] = {line_protocol::general_purpose, line_protocol::modbus_rtu,
                                            line_protocol::mewtocol_com};
        if (line != nullptr && line->role != line_role::client)
            c.complain(at + "/line", "is a server line: give it a unit with this \"channel\" instead");
        else if (line != nullptr && std::find(std::begin(spoken), std::end(spoken), line->protocol) == std::end(spoken))
            c.complain(at + "/line", "speaks what no COM port of a " + std::string(model.name) +
                                         " asks with: it is general-purpose, modbus-rtu or mewtocol-com");
        const bool exists = std::any_of(model.channels.begin(), model.channels.end(),
                                        [&](const plc::channel& each) { return each.number == p.channels[n].channel; });
        if (!exists && c.is_sound(at))
            c.complain(at + "/channel", "is a port that a " + std::string(model.name) + " does not have");
    }
}

void check_channels(check_context& c, std::size_t i, const plc_config& p, const plc::model& model)
{
    for (std::size_t n = 0; n < p.channels.size(); ++n) {
        const std::string at = item("plcs", i, "channels") + "/" + std::to_string(n);
        const auto* const line = c.line(p.channels[n].line, at + "/line");
        if (line != nullptr && line->protocol == line_protocol::general_purpose)
            c.complain(at + "/line", "is a general-purpose line: ADPRW cannot ask there");
        else if (line != nullptr && line->role != line_role::client)
            c.complain(at + "/line", "is a server line: a PLC asks on a client line; on a server line give it a unit");
        if (line != nullptr && line->protocol == line_protocol::modbus_ascii && !model.ascii)
            c.complain(at + "/line", "is an ASCII line, but a " + std::string(model.name) + " speaks RTU only");
        const bool exists = std::any_of(model.channels.begin(), model.channels.end(), [&](const plc::channel& each) {
            return each.number == p.channels[n].channel && each.client;
        });
        if (!exists && c.is_sound(at))
            c.complain(at + "/channel", "is " + std::to_string(p.channels[n].channel) + ", where a " +
                                            std::string(model.name) + " cannot be client");
    }
}

void check_plc(check_context& c, std::size_t i, const plc_config& p)
{
    const plc::model* const model = plc::find_model(p.model);
    if (model == nullptr) {
        std::string known;
        for (const plc::model* each : plc::all_models())
            known.append(known.empty() ? "" : ", ").append(each->name);
        c.complain(item("plcs", i, "model"), "is \"" + p.model + "\", expected one of: " + known);
        return;
    }
    if (!p.program.empty() && !p.program_file.empty())
        c.complain(item("plcs", i, "program_file"), "stands beside \"program\": keep one of them");
    const auto program = program_text(p, c.folder);
    if (!program) {
        c.complain(item("plcs", i, "program_file"), "names \"" + p.program_file + "\", which cannot be read");
        return;
    }
    if (!model->programs && !(p.program.empty() && p.program_file.empty()))
        c.complain(item("plcs", i, p.program.empty() ? "program_file" : "program"),
                   "does not belong to a " + std::string(model->name) +
                       ", which has neither D8400-D8485 nor ADPRW: remove it, the lines say how it communicates");
    else if (c.is_sound(item("plcs", i, "program")))
        check_program(c, i, p, *model, *program);
    if (model->mewtocol)
        check_com_ports(c, i, p, *model);
    else
        check_channels(c, i, p, *model);
}

}  // namespace

void check_plcs(check_context& c)
{
    for (std::size_t i = 0; i < c.config.plcs.size(); ++i)
        check_plc(c, i, c.config.plcs[i]);
}

}  // namespace plcgw::config
