#include "daemon/tcp_session.hpp"

#include "bridge/services/modbus_service.hpp"
#include "daemon/log.hpp"
#include "daemon/version.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/write.hpp>

#include <poll.h>
#include <set>

namespace plcgw {
namespace {

using boost::system::error_code;

constexpr duration frame_timeout = std::chrono::seconds(5);   // from the first byte of a request to its last
constexpr duration write_timeout = std::chrono::seconds(30);  // for a client that does not read
constexpr std::size_t most_unsent = 65'536;  // bytes; more is not answered to a client that reads slowly
constexpr milliseconds hang_up_period{200};  // between looks for a client that is not read from
constexpr duration longest_watch = std::chrono::hours(1);
constexpr duration shortest_watch = std::chrono::milliseconds(10);
constexpr duration complaint_period = std::chrono::seconds(10);
constexpr unsigned most_complaints = 20;

bool is_write(bytes pdu)
{
    switch (modbus::function{pdu[0]}) {
    case modbus::function::write_single_coil:
    case modbus::function::write_single_register:
    case modbus::function::write_multiple_coils:
    case modbus::function::write_multiple_registers:
    case modbus::function::mask_write_register:
    case modbus::function::read_write_multiple_registers: return true;
    default: return false;
    }
}

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
    : socket_(std::move(client)), peer_(std::move(peer)), framing_(std::move(framing)), service_(service),
      as_(new_asker()), changed_(socket_.get_executor()), watch_(socket_.get_executor()), quiet_since_(now()),
      part_since_(quiet_since_)
{
}

asio::awaitable<void> tcp_session::run()
{
    log::debug("MODBUS TCP {}: {} connected", service_.endpoint, peer_);
    watch();
    while (is_open_ && good_) {
        if (is_full()) {
            co_await something_changed();
            if (under_way_ > 0 && has_hung_up())
                break;
            take_questions();
            continue;
        }
        const auto [ec, size] = co_await socket_.async_read_some(asio::buffer(received_), no_throw);
        if (ec)
            break;
        quiet_since_ = now();
        service_.meter.received(size);
        framing_->feed(quiet_since_, bytes(received_).first(size));
        take_questions();
    }
    // What came before nonsense is answered, a client that left waits for nothing.
    while (is_open_ && !good_ && under_way_ > 0 && !has_hung_up())
        co_await something_changed();
    abandon();
    while (is_open_ && writing_)
        co_await something_changed();
    close();
    log::debug("MODBUS TCP {}: {} is gone", service_.endpoint, peer_);
}

// What arrived together is answered together, in its order, as far as it needs no line.
void tcp_session::take_questions()
{
    if (!service_.may_answer()) {
        close();
        return;
    }
    while (is_open_ && good_ && !is_full()) {
        const auto next = framing_->next(now());
        if (!next)
            break;
        part_since_ = now();
        good_ = next->has_value();
        if (good_)
            service_.meter.frames_received();
        else
            service_.meter.fault(next->error());
        if (good_)
            take(**next);
        else if (service_.may_complain())
            log::warning("MODBUS TCP {}: {} sent what is no {}, its connection is closed", service_.endpoint, peer_,
                         framing_->name());
    }
    if (framing_->empty())
        part_since_ = time_point::max();
    else if (part_since_ == time_point::max())
        part_since_ = now();
    flush();
    service_.settle();
    watch();
}

void tcp_session::append(const modbus::tcp_frame& reply)
{
    framing_->append(replies_, reply);
    service_.meter.frames_sent();
}

void tcp_session::take(const modbus::tcp_frame& question)
{
    if (framing_->is_serial() && question.content.unit == modbus::unit_id::broadcast) {
        take_broadcast(question.content.pdu);
        return;
    }
    const unit_target& to = service_.units[modbus::number(question.content.unit)];
    if (to.plc == nullptr && to.line != nullptr) {
        forward(question, to);
        return;
    }
    buffer pdu = to.plc != nullptr ? serve_pdu(*to.plc, question.content.pdu, version)
                                   : modbus::encode_exception(question.content.pdu[0],
                                                              modbus::exception_code::gateway_path_unavailable);
    modbus::tcp_frame reply{question.id, {question.content.unit, std::move(pdu)}};
    // A write that is taken by the PLC only goes on to the station, where a write-through route leads.
    if (to.plc != nullptr && is_write(question.content.pdu) && reply.content.pdu[0] == question.content.pdu[0]) {
        if (auto written = service_.through->begin(*to.plc)) {
            ++under_way_;
            asio::co_spawn(socket_.get_executor(),
                           answer_later(shared_from_this(), std::move(reply), std::move(written)), asio::detached);
            return;
        }
    }
    append(reply);
}

// The client hears what the station said.
asio::awaitable<void> tcp_session::answer_later(std::shared_ptr<tcp_session> self, modbus::tcp_frame reply,
                                                through_writes::handle written)
{
    const time_point asked_at = now();
    const auto failed = co_await through_writes::finish(std::move(written));
    --self->under_way_;
    if (failed)
        reply.content.pdu = modbus::encode_exception(reply.content.pdu[0], *failed);
    if (!self->abandoned_ && !self->is_late(asked_at))
        self->append(reply);
    self->quiet_since_ = now();
    self->flush();
    self->changed_.cancel();
}

// Executed by every PLC that stands here for a station, answered by nobody.
void tcp_session::take_broadcast(bytes pdu)
{
    std::set<plc::simulated_plc*> plcs;
    for (const unit_target& each : service_.units)
        if (each.plc != nullptr && plcs.insert(each.plc).second)
            serve_pdu(*each.plc, pdu, version);
}

void tcp_session::forward(const modbus::tcp_frame& question, const unit_target& to)
{
    const auto request = modbus::parse_request(question.content.pdu);
    if (!request) {
        buffer pdu = modbus::encode_exception(question.content.pdu[0], request.error());
        append({question.id, {question.content.unit, std::move(pdu)}});
        return;
    }
    const station_key key{to.line, to.unit};
    std::deque<forwarded>& waiting = stations_[key].waiting;
    waiting.push_back({question.id, question.content.unit, *request});
    ++under_way_;
    if (waiting.size() == 1)
        asio::co_spawn(socket_.get_executor(), ask_station(shared_from_this(), key), asio::detached);
}

// One after the other: requests to one station keep their order, whatever carries them.
asio::awaitable<void> tcp_session::ask_station(std::shared_ptr<tcp_session> self, station_key to)
{
    station_queue& queue = self->stations_[to];
    while (!self->abandoned_ && !queue.waiting.empty()) {
        const forwarded& first = queue.waiting.front();
        std::optional<result<modbus::response>> answer;
        const time_point asked_at = now();
        queue.under_way = to.first->begin(self->as_, to.second, first.request);
        if (queue.under_way) {
            auto answered = co_await forward_gate::finish(queue.under_way);
            answer = std::move(answered);
        }
        queue.under_way = nullptr;
        if (self->abandoned_)
            break;
        buffer pdu = modbus::encode_response(first.request, as_response(answer));
        const bool answers = !pdu.empty();  // nobody answers a broadcast, or the command to listen only
        if (answers && !self->is_late(asked_at))
            self->append({first.id, {first.unit, std::move(pdu)}});
        queue.waiting.pop_front();
        --self->under_way_;
        self->quiet_since_ = now();
        self->flush();
        self->changed_.cancel();
    }
    self->stations_.erase(to);
}

// The client asks something else meanwhile, and without transaction ids it would take this answer for that of its next
// question.
bool tcp_session::is_late(time_point asked_at) const
{
    error_code ignored;
    return framing_->is_serial() && (quiet_since_ > asked_at || socket_.available(ignored) > 0);
}

asio::awaitable<void> tcp_session::something_changed()
{
    changed_.expires_after(hang_up_period);
    co_await changed_.async_wait(no_throw);
}

bool tcp_session::is_full() const
{
    const std::size_t most = framing_->is_serial() ? 1 : service_.max_outstanding;
    return under_way_ >= most || replies_.size() + sending_.size() >= most_unsent;
}

// Also behind bytes that are not read yet; Asio does not wait for that.
bool tcp_session::has_hung_up()
{
    pollfd look{socket_.native_handle(), POLLRDHUP, 0};
    return !is_open_ || (::poll(&look, 1, 0) > 0 && look.revents != 0);
}

void tcp_session::flush()
{
    if (!service_.may_answer())
        replies_.clear();
    if (writing_ || !is_open_ || replies_.empty())
        return;
    sending_.swap(replies_);
    writing_ = true;
    write_until_ = now() + write_timeout;
    asio::async_write(socket_, asio::buffer(sending_), [self = shared_from_this()](error_code ec, std::size_t size) {
        self->service_.meter.sent(size);
        self->writing_ = false;
        self->sending_.clear();
        if (ec)
            self->close();
        self->flush();
        self->changed_.cancel();
    });
    watch();
}

// A timer for the whole connection, set anew only for an earlier deadline.
void tcp_session::watch()
{
    const time_point next = std::min({overdue_at(), framing_->deadline(), now() + longest_watch});
    if (!is_open_ || next >= looking_at_)
        return;
    looking_at_ = std::max(next, now() + shortest_watch);
    watch_.expires_at(looking_at_);
    watch_.async_wait([self = shared_from_this()](error_code cancelled) {
        if (!cancelled)
            self->look();
    });
}

void tcp_session::look()
{
    looking_at_ = time_point::max();
    if (framing_->deadline() <= now())
        take_questions();
    if (!good_)
        close();
    if (is_open_ && overdue_at() <= now()) {
        // Bytes may have come while this process or its machine stood still: they were in time, we were late.
        error_code ignored;
        if (writing_ || socket_.available(ignored) == 0) {
            log::info("MODBUS TCP {}: {} {} for too long, its connection is closed", service_.endpoint, peer_,
                      writing_ ? "does not take its answers" : "is silent");
            close();
        }
    }
    watch();
}

time_point tcp_session::overdue_at() const
{
    if (writing_)
        return write_until_;
    if (under_way_ > 0)
        return time_point::max();
    if (!framing_->empty())
        return part_since_ + frame_timeout;
    return quiet_since_ + service_.idle_timeout;
}

void tcp_session::abandon()
{
    abandoned_ = true;
    for (const auto& [to, queue] : stations_)
        if (queue.under_way)
            to.first->cancel(queue.under_way);
}

void tcp_session::close()
{
    is_open_ = false;
    abandon();
    watch_.cancel();
    changed_.cancel();
    error_code ignored;
    socket_.close(ignored);
}

}  // namespace plcgw
