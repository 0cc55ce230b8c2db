#include "daemon/plc_program.hpp"

#include <algorithm>

namespace plcgw {
namespace {

constexpr duration longest_pause = std::chrono::seconds(1);

plc::adprw_outcome outcome_of(const plc::adprw_question& question,
                              const std::optional<result<modbus::response>>& answer,
                              const std::optional<modbus::frame>& received)
{
    if (!answer)  // too many others wait for the line
        return plc::failure_of(make_error_code(errc::timed_out), question.unit, question.request);
    if (!*answer)
        return plc::failure_of(answer->error(), question.unit, question.request, received);
    return **answer;
}

}  // namespace

plc_program::plc_program(asio::io_context& loop, plc::adprw_runner runner, forward_gate& line,
                         const modbus::serial_options& timing, std::function<void()> settle)
    : runner_(std::move(runner)), line_(line), timing_(timing), settle_(std::move(settle)), pause_(loop), gate_(loop)
{
}

void plc_program::look()
{
    if (!gate_.is_open())
        return;
    runner_.scan();
    pause_.cancel();
}

asio::awaitable<void> plc_program::run()
{
    for (;;) {
        co_await gate_.wait();
        std::optional<plc::adprw_question> question = runner_.next(now());
        settle_();  // also a refused instruction changes devices
        if (question) {
            co_await ask(std::move(*question));
            continue;
        }
        const time_point wake = std::min(runner_.wake_at(now()), now() + longest_pause);
        pause_.expires_at(wake);
        co_await pause_.async_wait(no_throw);
    }
}

asio::awaitable<void> plc_program::ask(plc::adprw_question question)
{
    modbus::serial_options timing = timing_;
    timing.response_timeout = question.timing.response_timeout;
    timing.turnaround = question.timing.turnaround;
    timing.gap = question.timing.message_delay;
    timing.retries = question.timing.retries;
    timing.delimiter = question.timing.delimiter;
    std::optional<modbus::frame> received;  // by the last attempt
    forward_gate::on_fault heard = [&](const modbus::answer_fault& why) {
        runner_.attempt_failed(question, why);
        received = why.received;
    };
    const auto answer = co_await line_.ask(question.unit, question.request, timing, std::move(heard));
    runner_.finished(question, outcome_of(question, answer, received), now());
    settle_();
}

}  // namespace plcgw
