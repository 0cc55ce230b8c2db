#include "daemon/serial_line.hpp"

namespace plcgw {

using boost::system::error_code;

asio::awaitable<error_code> serial_line::exchange(client_line::question question)
{
    if (echoes_ && question.timing.echo == local_echo::automatic)
        question.timing.echo = local_echo::on;
    modbus::serial_transaction transaction(unit_of(question.unit), question.request(), question.timing, line_free_from_,
                                           now());
    const error_code ec = co_await carry_out(transaction, question);
    if (ec)
        co_return ec;
    const unanswered_requests late = take_leave(transaction);
    show_ended(!transaction.outcome() || refusal_in(*transaction.outcome()));
    if (transaction.outcome() && !refusal_in(*transaction.outcome()))
        routes_.responded(question, transaction.response_time());
    if (const auto& outcome = transaction.outcome())
        routes_.answered(question, *outcome, now(), wall_now(), late, transaction.response_time());
    else
        routes_.failed(question, outcome.error(), now(), late);
    co_return error_code{};
}

}  // namespace plcgw
