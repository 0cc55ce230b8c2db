#include "daemon/message_line.hpp"

#include "daemon/log.hpp"

#include <algorithm>

namespace plcgw {

using boost::system::error_code;
using general_purpose::expect;

namespace {

// Behind a device server nothing is marked.
general_purpose::marked_characters marks_of(const line_config& line)
{
    return general_purpose::marked_characters(line.check == parity::none ? errc::bad_stop_bit : errc::bad_parity);
}

}  // namespace

message_line::message_line(asio::io_context& loop, line_config config, messages::line_messages messages,
                           std::function<void()> settle)
    : content(std::move(messages)), config_(std::move(config)), settle_(std::move(settle)),
      connection_(make_connection(loop, config_)), marks_(marks_of(config_)), echo_(echo_of(config_)), gate_(loop)
{
}

asio::awaitable<void> message_line::run()
{
    content.start(now());
    for (;;) {
        const bool is_open = co_await connection_->open();
        if (is_open) {
            marks_ = marks_of(config_);
            echo_ = echo_filter(echo_of(config_) == local_echo::on ? local_echo::on : local_echo::off);
            line_free_from_ = now() + config_.gap;
            overruns_ = connection_->overruns();
            say_what_is_not_seen();
            content.port_opened();
            const error_code ec = co_await serve();
            connection_->close(ec);
        }
        content.port_lost();
        settle();
    }
}

void message_line::say_what_is_not_seen()
{
    if (!overruns_ && !config_.device.empty() && !std::exchange(said_overruns_, true))
        log::info("line {}: the driver of {} does not count lost characters: overruns are not seen", config_.name,
                  config_.device);
}

void message_line::show_in_ports()
{
    using messages::status_word;
    if (ports_.empty())
        return;
    const messages::port_news news = content.take_port_news();
    if (news.reset)
        ports_.reset_done();
    if (news.copied)
        ports_.copied();
    if (news.bad_send_count)
        ports_.note(plc::setting_error::send_count);
    if ((content.status(status_word::error_code) & general_purpose::receive_error::buffers_full) != 0)
        ports_.note(plc::receive_error::buffers_full);
    shown_.send_failed = (shown_.send_failed && !news.reset) || news.bad_send_count;
    shown_.message_waits = content.status(status_word::waiting) > 0;
    ports_.show(shown_);
}

void message_line::settle()
{
    show_in_ports();
    settle_();
}

void message_line::reset_channel()
{
    content.reset_channel();
    content.take_port_news();
    shown_ = {};
    ++resets_;
    if (reading_)
        connection_->interrupt();
}

void message_line::wake()
{
    if (idle_)
        connection_->interrupt();
}

asio::awaitable<error_code> message_line::serve()
{
    for (;;) {
        std::optional<messages::line_messages::question> question;
        if (gate_.is_open())
            question = content.next(now(), wall_now());
        show_in_ports();  // a reset goes before what follows it
        error_code ec;
        if (question)
            ec = co_await exchange(std::move(*question));
        else
            ec = co_await listen();
        if (ec)
            co_return ec;
    }
}

template <class Receiver>
void message_line::feed(Receiver& into, bytes received)
{
    if (config_.device.empty()) {
        into.feed(now(), echo_.feed(now(), received));
        return;
    }
    for (const auto& piece : marks_.feed(received)) {
        if (const auto* characters = std::get_if<buffer>(&piece))
            into.feed(now(), echo_.feed(now(), *characters));
        else
            into.fault(now(), std::get<errc>(piece));
    }
}

// Where in the stream they were lost is not known: the message that is being received, or the next one, is dropped.
template <class Receiver>
void message_line::look_for_overruns(Receiver& into)
{
    const auto counted = connection_->overruns();
    if (counted && overruns_ && *counted != *overruns_)
        into.fault(now(), errc::overrun);
    overruns_ = counted;
}

asio::awaitable<error_code> message_line::listen()
{
    take_messages();  // what an exchange left
    settle();
    constexpr duration standby_round = std::chrono::milliseconds(100);
    const time_point due = gate_.is_open() ? content.wake_at() : now() + standby_round;
    const time_point until = std::min(due, content.framer().deadline());
    idle_ = true;
    const auto size = co_await read(until);
    idle_ = false;
    if (size) {
        look_for_overruns(content.framer());
        feed(content.framer(), bytes(received_).first(*size));
        line_free_from_ = std::max(line_free_from_, now() + config_.gap);
    }
    else if (size.error() != asio::error::timed_out)
        co_return size.error();
    take_messages();
    co_return error_code{};
}

void message_line::take_messages()
{
    while (auto each = content.framer().next(now()))
        take(std::move(*each));
}

void message_line::take(result<buffer> message)
{
    if (message)
        connection_->meter().frames_received();
    else {
        connection_->meter().fault(message.error());
        ports_.note(static_cast<errc>(message.error().value()));
    }
    content.received(std::move(message), now(), wall_now());
}

asio::awaitable<boost::system::result<std::size_t>> message_line::read(time_point until)
{
    reading_ = true;
    const auto size = co_await connection_->read(until, asio::buffer(received_));
    reading_ = false;
    co_return size;
}

// The driver has the message before it has left.
asio::awaitable<error_code> message_line::send(bytes message)
{
    const time_point started = now();
    const unsigned resets = resets_;
    shown_.sending = true;
    settle();
    const error_code ec = co_await connection_->write(message);
    connection_->meter().frames_sent();
    if (resets == resets_) {
        shown_.sending = false;
        shown_.send_failed = ec.failed();
        if (!ec)
            ports_.sends(started + character_time(format_of(config_), message.size()));
        show_in_ports();
    }
    co_return ec;
}

asio::awaitable<error_code> message_line::exchange(messages::line_messages::question question)
{
    general_purpose::exchange asking(content.framer(), question.message, question.answer, question.timing,
                                     line_free_from_, now());
    const unsigned resets = resets_;
    for (;;) {
        const auto action = asking.next(now());
        if (std::holds_alternative<general_purpose::exchange::done>(action))
            break;
        if (resets != resets_) {
            content.given_up(question, now(), asking.attempts());
            line_free_from_ = asking.line_free_from();
            co_return error_code{};
        }
        error_code ec;
        if (const auto* to_send = std::get_if<general_purpose::exchange::send>(&action)) {
            if (!gate_.is_open()) {
                content.interrupted(question, now());
                line_free_from_ = asking.line_free_from();
                co_return error_code{};
            }
            const time_point started = now();
            if (question.answer == expect::nothing)
                echo_.sent(to_send->message, false, started + std::chrono::hours(1));  // in no doubt
            ec = co_await send(to_send->message);
            if (asking.attempts() == 0 && !ec)
                content.sent(question, wall_now());
            asking.sent(started);
        }
        else {
            const time_point until = std::get<general_purpose::exchange::wait>(action).until;
            const auto size = co_await read(until);
            if (size) {
                look_for_overruns(asking);
                feed(asking, bytes(received_).first(*size));
            }
            else if (size.error() != asio::error::timed_out)
                ec = size.error();
        }
        if (ec) {
            content.interrupted(question, now());
            co_return ec;
        }
    }
    line_free_from_ = asking.line_free_from();
    for (auto& each : asking.take_others())
        take(std::move(each));
    if (asking.outcome() && question.answer != expect::nothing)
        connection_->meter().frames_received();
    for (unsigned i = 0; i < asking.unanswered(); ++i)
        connection_->missed_answer();
    if (const auto& outcome = asking.outcome()) {
        content.answered(question, *outcome, now(), wall_now());
    }
    else {
        shown_.send_failed = asking.attempts() == 0 || outcome.error() == errc::collision;
        content.failed(question, outcome.error(), now(), asking.unanswered());
    }
    settle();
    co_return connection_->deaf() ? error_code(asio::error::timed_out) : error_code{};
}

}  // namespace plcgw
