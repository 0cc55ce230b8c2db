#include "daemon/tcp_server.hpp"

#include "daemon/line_events.hpp"
#include "daemon/log.hpp"
#include "daemon/serial_framing.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>

namespace plcgw {
namespace {

using asio::ip::tcp;
using boost::system::error_code;

constexpr duration network_silence = std::chrono::milliseconds(50);  // longer than a network tears a frame apart
constexpr milliseconds accept_pause{100};                            // when the process is out of descriptors
constexpr duration for_ever = std::chrono::hours(24 * 365);

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
    using idle = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPIDLE>;
    using interval = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPINTVL>;
    using count = asio::detail::socket_option::integer<IPPROTO_TCP, TCP_KEEPCNT>;
    client.set_option(idle(30), ignored);
    client.set_option(interval(10), ignored);
    client.set_option(count(3), ignored);
}

}  // namespace

tcp_server::tcp_server(asio::io_context& loop, tcp_server_config config, const unit_table& units,
                       through_writes& through, std::function<void()> settle)
    : config_(std::move(config)), acceptor_(loop), pause_(loop)
{
    service_.endpoint = to_text(address());
    service_.meter = port_meter("modbus-tcp/" + service_.endpoint);
    service_.units = units;
    service_.through = &through;
    service_.settle = std::move(settle);
    service_.max_outstanding = config_.max_outstanding;
    service_.idle_timeout = config_.idle_timeout.count() == 0 ? for_ever : duration(config_.idle_timeout);
}

tcp::endpoint tcp_server::address() const
{
    return {asio::ip::make_address(config_.listen), static_cast<asio::ip::port_type>(config_.port)};
}

error_code tcp_server::listen()
{
    const tcp::endpoint at = address();
    error_code ec;
    if (acceptor_.open(at.protocol(), ec); ec)
        return ec;
    if (acceptor_.set_option(asio::socket_base::reuse_address(true), ec); ec)
        return ec;
    acceptor_.bind(at, ec);
    if (!ec)
        acceptor_.listen(asio::socket_base::max_listen_connections, ec);
    error_code ignored;
    if (ec)
        acceptor_.close(ignored);  // a member of a pair tries again
    else
        service_.meter.opened(wall_now());
    return ec;
}

void tcp_server::stop()
{
    ++turn_;
    error_code ignored;
    acceptor_.close(ignored);
    for (const auto& each : std::exchange(sessions_, {}))
        if (const auto session = each.lock())
            session->dismiss();
}

asio::awaitable<void> tcp_server::accept_clients()
{
    for (const unsigned turn = turn_; turn == turn_;) {
        tcp::endpoint from;
        auto [ec, client] = co_await acceptor_.async_accept(from, no_throw);
        if (turn != turn_)
            co_return;
        if (ec) {
            if (service_.may_complain())
                log::warning("MODBUS TCP {}: a client could not be accepted: {}", endpoint(), ec.message());
            pause_.expires_after(accept_pause);
            co_await pause_.async_wait(no_throw);
            continue;
        }
        std::string peer = to_text(from);
        std::shared_ptr<void> place = take_place();
        if (!place) {
            if (!std::exchange(refusing_, true))
                say(line_event::severity::warning, "client.refused", port().port,
                    "MODBUS TCP {}: {} is refused, there are {} clients already (max_clients)", endpoint(), peer,
                    config_.max_clients);
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

std::unique_ptr<tcp_framing> tcp_server::make_framing() const
{
    if (config_.framing == server_framing::tcp)
        return std::make_unique<mbap_framing>();
    std::vector<modbus::unit_id> own;
    for (unsigned unit = 1; unit < service_.units.size(); ++unit)
        if (service_.units[unit].plc != nullptr || service_.units[unit].line != nullptr)
            own.push_back(modbus::unit_id{static_cast<std::uint8_t>(unit)});
    const auto mode = config_.framing == server_framing::ascii ? modbus::framing::ascii : modbus::framing::rtu;
    return std::make_unique<serial_framing>(mode, std::move(own), network_silence);
}

asio::awaitable<void> tcp_server::serve(tcp::socket client, std::string peer, std::shared_ptr<void> place)
{
    auto framing = make_framing();
    const auto session =
        std::make_shared<tcp_session>(std::move(client), std::move(peer), std::move(framing), service_);
    if (service_.voice != nullptr) {
        std::erase_if(sessions_, [](const auto& each) { return each.expired(); });
        sessions_.push_back(session);
    }
    co_await session->run();
    place.reset();
}

}  // namespace plcgw
