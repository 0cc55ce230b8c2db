#include "daemon/tcp_server.hpp"

#include "daemon/log.hpp"
#include "daemon/version.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/write.hpp>

#include <array>

namespace plcgw {
namespace {

using asio::ip::tcp;
using boost::system::error_code;

constexpr milliseconds accept_pause{100};                     // when the process is out of descriptors
constexpr duration frame_timeout = std::chrono::seconds(5);   // from the first byte of a request to its last
constexpr duration write_timeout = std::chrono::seconds(30);  // for a client that does not read
constexpr duration complaint_period = std::chrono::seconds(10);
constexpr unsigned most_complaints = 20;
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
                       std::function<void()> settle)
    : config_(std::move(config)), units_(units), settle_(std::move(settle)), acceptor_(loop), pause_(loop),
      idle_timeout_(config_.idle_timeout.count() == 0 ? for_ever : duration(config_.idle_timeout))
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
            if (may_complain())
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

// Some in each period: a client that sends nonsense all the time does not fill the log.
bool tcp_server::may_complain()
{
    if (now() - complaints_since_ >= complaint_period) {
        complaints_since_ = now();
        complaints_ = 0;
    }
    return ++complaints_ <= most_complaints;
}

std::shared_ptr<void> tcp_server::take_place()
{
    if (*clients_ >= config_.max_clients)
        return nullptr;
    ++*clients_;
    return {clients_.get(), [counter = clients_](void*) { --*counter; }};
}

// One client's connection.
struct tcp_server::session {
    explicit session(tcp::socket s) : socket(std::move(s)), guard(socket) {}

    tcp::socket socket;
    deadline_guard<tcp::socket> guard;
    modbus::mbap_framer in;
    buffer replies;
    std::array<std::uint8_t, 4096> received{};
};

asio::awaitable<void> tcp_server::serve(tcp::socket client, std::string peer, std::shared_ptr<void> place)
{
    log::debug("MODBUS TCP {}: {} connected", endpoint(), peer);
    session s(std::move(client));
    for (bool good = true; good;) {
        const duration patience = s.in.empty() ? idle_timeout_ : frame_timeout;
        const time_point deadline = now() + patience;
        const auto size = co_await read_before(deadline, s.socket, s.guard, asio::buffer(s.received));
        if (!size) {
            if (size.error() == asio::error::timed_out)
                log::info("MODBUS TCP {}: {} is silent for too long, its connection is closed", endpoint(), peer);
            break;
        }
        s.in.feed(bytes(s.received).first(*size));
        good = co_await answer(s);
        if (!good && may_complain())
            log::warning("MODBUS TCP {}: {} sent what is no MODBUS TCP, its connection is closed", endpoint(), peer);
        const bool taken = co_await write_replies(s);
        good = good && taken;
        settle_();
    }
    log::debug("MODBUS TCP {}: {} is gone", endpoint(), peer);
    place.reset();
}

// What arrived together is answered together, in its order. False when the stream is no MODBUS TCP.
asio::awaitable<bool> tcp_server::answer(session& s)
{
    while (const auto next = s.in.next()) {
        if (!*next)
            co_return false;
        const modbus::tcp_frame& question = **next;
        const unit_target& to = units_[modbus::number(question.content.unit)];
        buffer pdu;
        if (to.plc != nullptr) {
            pdu = serve_pdu(*to.plc, question.content.pdu, version);
        }
        else if (to.line != nullptr) {
            // What is answered already does not wait for the line.
            const bool taken = co_await write_replies(s);
            if (!taken)
                co_return true;
            pdu = co_await forward(to, question.content.pdu);
        }
        else {
            pdu = modbus::encode_exception(question.content.pdu[0], modbus::exception_code::gateway_path_unavailable);
        }
        modbus::append_mbap(s.replies, {question.id, {question.content.unit, std::move(pdu)}});
    }
    co_return true;
}

asio::awaitable<buffer> tcp_server::forward(const unit_target& to, bytes pdu)
{
    const auto question = modbus::parse_request(pdu);
    if (!question)
        co_return modbus::encode_exception(pdu[0], question.error());
    const auto answer = co_await to.line->ask(to.unit, *question, std::nullopt);
    co_return modbus::encode_response(*question, as_response(answer));
}

// False when the client is gone, or takes nothing for too long.
asio::awaitable<bool> tcp_server::write_replies(session& s)
{
    if (s.replies.empty())
        co_return true;
    s.guard.arm(now() + write_timeout);
    const auto [ec, size] = co_await asio::async_write(s.socket, asio::buffer(s.replies), no_throw);
    s.guard.disarm();
    s.replies.clear();
    co_return !ec;
}

}  // namespace plcgw
