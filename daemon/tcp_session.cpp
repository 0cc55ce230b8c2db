#include "daemon/tcp_session.hpp"

#include "bridge/services/modbus_service.hpp"
#include "daemon/log.hpp"
#include "daemon/version.hpp"

#include <boost/asio/write.hpp>

namespace plcgw {
namespace {

constexpr duration frame_timeout = std::chrono::seconds(5);   // from the first byte of a request to its last
constexpr duration write_timeout = std::chrono::seconds(30);  // for a client that does not read
constexpr duration complaint_period = std::chrono::seconds(10);
constexpr unsigned most_complaints = 20;

}  // namespace

bool tcp_service::may_complain()
{
    if (now() - complaints_since_ >= complaint_period) {
        complaints_since_ = now();
        complaints_ = 0;
    }
    return ++complaints_ <= most_complaints;
}

tcp_session::tcp_session(asio::ip::tcp::socket client, std::string peer, std::unique_ptr<tcp_framing> framing,
                         tcp_service& service)
    : socket_(std::move(client)), guard_(socket_), peer_(std::move(peer)), framing_(std::move(framing)),
      service_(service)
{
}

asio::awaitable<void> tcp_session::run()
{
    log::debug("MODBUS TCP {}: {} connected", service_.endpoint, peer_);
    for (bool good = true; good;) {
        const duration patience = framing_->empty() ? service_.idle_timeout : frame_timeout;
        const time_point deadline = now() + patience;
        const auto size = co_await read_before(deadline, socket_, guard_, asio::buffer(received_));
        if (!size) {
            if (size.error() == asio::error::timed_out)
                log::info("MODBUS TCP {}: {} is silent for too long, its connection is closed", service_.endpoint,
                          peer_);
            break;
        }
        framing_->feed(now(), bytes(received_).first(*size));
        good = co_await answer();
        if (!good && service_.may_complain())
            log::warning("MODBUS TCP {}: {} sent what is no {}, its connection is closed", service_.endpoint, peer_,
                         framing_->name());
        const bool taken = co_await write_replies();
        good = good && taken;
        service_.settle();
    }
    log::debug("MODBUS TCP {}: {} is gone", service_.endpoint, peer_);
}

// What arrived together is answered together, in its order. False when the stream cannot be trusted.
asio::awaitable<bool> tcp_session::answer()
{
    while (const auto next = framing_->next(now())) {
        if (!*next)
            co_return false;
        const modbus::tcp_frame& question = **next;
        const unit_target& to = service_.units[modbus::number(question.content.unit)];
        buffer pdu;
        if (to.plc != nullptr) {
            pdu = serve_pdu(*to.plc, question.content.pdu, version);
        }
        else if (to.line != nullptr) {
            // What is answered already does not wait for the line.
            const bool taken = co_await write_replies();
            if (!taken)
                co_return true;
            pdu = co_await forward(to, question.content.pdu);
        }
        else {
            pdu = modbus::encode_exception(question.content.pdu[0], modbus::exception_code::gateway_path_unavailable);
        }
        framing_->append(replies_, {question.id, {question.content.unit, std::move(pdu)}});
    }
    co_return true;
}

asio::awaitable<buffer> tcp_session::forward(const unit_target& to, bytes pdu)
{
    const auto question = modbus::parse_request(pdu);
    if (!question)
        co_return modbus::encode_exception(pdu[0], question.error());
    const auto answer = co_await to.line->ask(to.unit, *question, std::nullopt);
    co_return modbus::encode_response(*question, as_response(answer));
}

// False when the client is gone, or takes nothing for too long.
asio::awaitable<bool> tcp_session::write_replies()
{
    if (replies_.empty())
        co_return true;
    guard_.arm(now() + write_timeout);
    const auto [ec, size] = co_await asio::async_write(socket_, asio::buffer(replies_), no_throw);
    guard_.disarm();
    replies_.clear();
    co_return !ec;
}

}  // namespace plcgw
