#include "daemon/mewtocol_line.hpp"

#include "bridge/services/mewtocol_forward.hpp"

namespace plcgw {

using boost::system::error_code;

mewtocol::line_options options_of(const modbus::serial_options& timing)
{
    // A PLC may pause inside an answer, and only an answer that lost its CR costs this time.
    constexpr duration least_silence = std::chrono::milliseconds(100);
    return {.format = timing.format,
            .response_timeout = timing.response_timeout,
            .retries = timing.retries,
            .turnaround = timing.turnaround,
            .gap = timing.gap,
            .silence = std::max(timing.silence, least_silence)};
}

mewtocol::station_id com_station(station_number n)
{
    const auto station = mewtocol::station_of_send(number(n));
    return station.value_or(mewtocol::station_id::none);
}

mewtocol7::station_id com7_station(station_number n)
{
    const mewtocol7::station_id station{n.value};
    return mewtocol7::is_server_number(station) ? station : mewtocol7::station_id::none;
}

asio::awaitable<error_code> mewtocol_line::exchange(client_line::question question)
{
    std::vector<mewtocol::block> blocks;
    if (const auto* const own = std::get_if<mewtocol::block>(&question.asked)) {
        blocks.push_back(*own);
    }
    else if (auto meant = blocks_of(question.request())) {
        blocks = std::move(*meant);
    }
    else {
        routes_.answered(question, modbus::response{meant.error()}, now(), wall_now());
        co_return error_code{};
    }
    error_code ec;
    if (config_.protocol == line_protocol::mewtocol7_com) {
        mewtocol::com7_client client{com7_station(question.unit), config_.mewtocol.dialect, next_number_};
        ec = co_await ask(client, std::move(blocks), question);
    }
    else {
        const auto which = config_.mewtocol.expansion ? mewtocol::headers::automatic : mewtocol::headers::normal;
        mewtocol::com_client client{com_station(question.unit), which};
        ec = co_await ask(client, std::move(blocks), question);
    }
    co_return ec;
}

template <class Client>
asio::awaitable<error_code> mewtocol_line::ask(Client client, std::vector<mewtocol::block> blocks,
                                               const client_line::question& question)
{
    mewtocol::block_transaction<Client> transaction(client, std::move(blocks), options_of(question.timing),
                                                    line_free_from_, now());
    const error_code ec = co_await carry_out(transaction, question);
    if (ec)
        co_return ec;
    const unanswered_requests late = take_leave(transaction);
    const auto& outcome = transaction.outcome();
    const duration after = transaction.response_time();
    const bool own = std::holds_alternative<mewtocol::block>(question.asked);
    show_ended(!outcome || refusal_in(outcome->back()));
    if (!own && outcome.has_error() && outcome.error() == errc::not_expressible && client.asks_one())
        routes_.answered(question, modbus::response{modbus::exception_code::illegal_data_address}, now(), wall_now());
    else if (!outcome)
        routes_.failed(question, outcome.error(), now(), late);
    else if (own) {
        if (!refusal_in(outcome->back()))
            routes_.responded(question, after);
        routes_.answered(question, outcome->back(), now(), wall_now(), late, after);
    }
    else
        routes_.answered(question, modbus_answer(question.request(), *outcome), now(), wall_now(), late, after);
    co_return error_code{};
}

}  // namespace plcgw
