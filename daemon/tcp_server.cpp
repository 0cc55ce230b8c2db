#include "daemon/tcp_server.hpp"

#include "daemon/log.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/write.hpp>

namespace plcgw {
namespace {

using asio::ip::tcp;
using boost::system::error_code;

constexpr milliseconds accept_pause{100};  // when the process is out of descriptors

buffer reply_to(const unit_table& units, const modbus::frame& question)
{
    plc::simulated_plc* const plc = units[modbus::number(question.unit)];
    if (plc == nullptr)
        return modbus::encode_exception(question.pdu[0], modbus::exception_code::gateway_path_unavailable);
    return serve_pdu(*plc, question.pdu);
}

std::string to_text(const tcp::endpoint& at)
{
    const std::string host = at.address().to_string();
    return at.address().is_v6() ? fmt::format("[{}]:{}", host, at.port()) : fmt::format("{}:{}", host, at.port());
}

// Small replies leave at once; a client that vanished is noticed by keep-alive. Both are wishes, not needs.
void set_options(tcp::socket& client)
{
    error_code ignored;
    client.set_option(tcp::no_delay(true), ignored);
    client.set_option(asio::socket_base::keep_alive(true), ignored);
}

}  // namespace

tcp_server::tcp_server(asio::io_context& loop, tcp_server_config config, const unit_table& units,
                       std::function<void()> settle)
    : config_(std::move(config)), units_(units), settle_(std::move(settle)), acceptor_(loop), pause_(loop)
{
}

std::string tcp_server::endpoint() const
{
    return to_text({asio::ip::make_address(config_.listen), static_cast<asio::ip::port_type>(config_.port)});
}

error_code tcp_server::listen()
{
    const tcp::endpoint at(asio::ip::make_address(config_.listen), static_cast<asio::ip::port_type>(config_.port));
    error_code ec;
    if (acceptor_.open(at.protocol(), ec); ec)
        return ec;
    if (acceptor_.set_option(asio::socket_base::reuse_address(true), ec); ec)
        return ec;
    if (acceptor_.bind(at, ec); ec)
        return ec;
    acceptor_.listen(asio::socket_base::max_listen_connections, ec);
    return ec;
}

asio::awaitable<void> tcp_server::accept_clients()
{
    for (;;) {
        tcp::endpoint from;
        auto [ec, client] = co_await acceptor_.async_accept(from, no_throw);
        if (ec) {
            log::warning("MODBUS TCP {}: a client could not be accepted: {}", endpoint(), ec.message());
            pause_.expires_after(accept_pause);
            co_await pause_.async_wait(no_throw);
            continue;
        }
        std::string peer = to_text(from);
        std::shared_ptr<void> place = take_place();
        if (!place) {
            if (!std::exchange(refusing_, true))
                log::warning("MODBUS TCP {}: {} is refused, there are {} clients already (max_clients)", endpoint(),
                             peer, config_.max_clients);
            continue;  // closes the connection
        }
        refusing_ = false;
        set_options(client);
        asio::co_spawn(acceptor_.get_executor(), serve(std::move(client), std::move(peer), std::move(place)),
                       asio::detached);
    }
}

std::shared_ptr<void> tcp_server::take_place()
{
    if (*clients_ >= config_.max_clients)
        return nullptr;
    ++*clients_;
    return {clients_.get(), [counter = clients_](void*) { --*counter; }};
}

asio::awaitable<void> tcp_server::serve(tcp::socket client, std::string peer, std::shared_ptr<void> place)
{
    log::debug("MODBUS TCP {}: {} connected", endpoint(), peer);
    modbus::mbap_framer in;
    std::array<std::uint8_t, 4096> received{};
    for (bool good = true; good;) {
        const auto [ec, size] = co_await client.async_read_some(asio::buffer(received), no_throw);
        if (ec)
            break;
        in.feed(bytes(received).first(size));
        buffer replies;
        good = answer(in, replies);
        if (!good)
            log::warning("MODBUS TCP {}: {} sent what is no MODBUS TCP, its connection is closed", endpoint(), peer);
        if (!replies.empty()) {
            const auto [failed, sent] = co_await asio::async_write(client, asio::buffer(replies), no_throw);
            good = good && !failed;
        }
        settle_();
    }
    log::debug("MODBUS TCP {}: {} is gone", endpoint(), peer);
    place.reset();
}

// What arrived together is answered together: one write. False when the stream is no MODBUS TCP.
bool tcp_server::answer(modbus::mbap_framer& in, buffer& replies)
{
    while (const auto next = in.next()) {
        if (!*next)
            return false;
        const modbus::tcp_frame& question = **next;
        modbus::append_mbap(replies, {question.id, {question.content.unit, reply_to(units_, question.content)}});
    }
    return true;
}

}  // namespace plcgw
