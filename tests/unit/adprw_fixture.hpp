// A simulated PLC with a program, and the line that its ADPRW instructions ask: questions as bytes, answers as bytes.
#pragma once

#include "bridge/plc/adprw_runner.hpp"
#include "tests/support/print.hpp"

namespace plcgw::test {

struct preset {
    const char* device;
    std::uint16_t value;  // of a bit device: 0 or 1
};

class adprw_fixture {
public:
    explicit adprw_fixture(const std::string& text, const char* model = "FX3U", unsigned channel = 1)
        : plc("main", *plc::find_model(model), parsed_setup(text)), runner(attached(text, channel))
    {
        for (const plc::program_mistake& each : runner.program().mistakes)
            FAIL_CHECK("line ", each.line, ": ", each.text);
    }

    // An ADPRW that runs always.
    static adprw_fixture always(const std::string& line, const char* model = "FX3U")
    {
        return adprw_fixture("LD M8000\n" + line, model);
    }

    plc::place at(const char* device) const { return plc.memory().find(*plc::parse_device(device)).value(); }
    std::uint16_t read(const char* device) const
    {
        const bool bit = plc::is_bit_kind(plc::parse_device(device)->kind);
        return bit ? std::uint16_t{plc.memory().bit(at(device))} : plc.memory().word(at(device));
    }
    void set(const char* device, std::uint16_t value)
    {
        if (plc::is_bit_kind(plc::parse_device(device)->kind))
            plc.memory().set_bit(at(device), value != 0);
        else
            plc.memory().set_word(at(device), value);
    }
    void set(const std::vector<preset>& all)
    {
        for (const preset& each : all)
            set(each.device, each.value);
    }
    void check(const std::vector<preset>& all) const
    {
        for (const preset& each : all) {
            CAPTURE(each.device);
            CHECK(read(each.device) == each.value);
        }
    }

    // Unit and PDU of the next question; empty when there is none.
    buffer next()
    {
        question = runner.next(now);
        if (!question)
            return {};
        buffer bytes{static_cast<std::uint8_t>(question->unit)};
        const buffer pdu = modbus::encode_request(question->request);
        bytes.insert(bytes.end(), pdu.begin(), pdu.end());
        return bytes;
    }

    void answer(const buffer& pdu)
    {
        REQUIRE(question.has_value());
        const auto parsed = modbus::parse_response(question->request, pdu);
        REQUIRE(parsed.has_value());
        runner.finished(*question, *parsed, now);
    }
    void finish(const plc::adprw_outcome& outcome)
    {
        REQUIRE(question.has_value());
        runner.finished(*question, outcome, now);
    }
    void fail(plc::modbus_error why, std::uint8_t received = 0) { finish(plc::adprw_failure{why, received}); }

    // One attempt ended so; the question is still out.
    void no_answer(errc why = errc::timed_out)
    {
        REQUIRE(question.has_value());
        runner.attempt_failed(*question, {why, {}});
    }

    plc::simulated_plc plc;
    plc::adprw_runner runner;
    time_point now{std::chrono::seconds(1000)};
    std::optional<plc::adprw_question> question;

private:
    static plc::setup_program parsed_setup(const std::string& text)
    {
        auto parsed = plc::parse_setup_program(text);
        for (const plc::program_mistake& each : parsed.mistakes)
            FAIL_CHECK("line ", each.line, ": ", each.text);
        return parsed;
    }

    plc::adprw_runner attached(const std::string& text, unsigned channel)
    {
        plc.attach(channel, plc::role::client);
        return {plc::parse_adprw_program(text), plc, channel};
    }
};

}  // namespace plcgw::test
