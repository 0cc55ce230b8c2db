#include "daemon/dds_commands.hpp"

#include "daemon/log.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>

namespace plcgw {

namespace {

constexpr int most_rounds = 64;  // each takes 64 of a topic: whoever writes faster than that is not waited for

}  // namespace

dds_commands::dds_commands(asio::io_context& loop, const dds_config& config, dds_identity who, carry_out how,
                           std::function<bool()> is_active)
    : loop_(loop), config_(config), who_(std::move(who)), carry_out_(std::move(how)), is_active_(std::move(is_active)),
      wakes_(loop)
{
}

void dds_commands::keep_open()
{
    if (!config_.settings.enabled)
        return;
    if (!port_ && open())
        asio::co_spawn(loop_, listen(), asio::detached);
    if (port_ && port_->drops() > said_drops_) {
        said_drops_ = port_->drops();
        log::warning("DDS: {} replies to write requests could not be sent so far", said_drops_);
    }
}

bool dds_commands::open()
{
    auto made = command_port::create(config_.settings, who_);
    if (!made) {
        if (!std::exchange(failed_, true))
            log::warning("DDS requests: {}. It is tried again until it works", made.error().text);
        return false;
    }
    const int descriptor = ::dup(made->descriptor());
    if (descriptor < 0)
        return false;
    failed_ = false;
    said_drops_ = 0;
    wakes_.assign(descriptor);
    port_.emplace(std::move(*made));
    return true;
}

void dds_commands::close()
{
    boost::system::error_code ignored;
    wakes_.close(ignored);
    port_.reset();
}

asio::awaitable<void> dds_commands::listen()
{
    for (;;) {
        const auto [ec] = co_await wakes_.async_wait(asio::posix::stream_descriptor::wait_read, no_throw);
        if (ec)
            co_return;
        take();
    }
}

bool dds_commands::take()
{
    if (!port_)
        return false;
    std::vector<command_news> news = port_->take();
    for (command_news& each : news) {
        if (auto* const request = std::get_if<order_request>(&each))
            take(std::move(*request));
        else if (auto* const said = std::get_if<order_reply>(&each))
            log_.heard(said->key, std::move(said->outcome), said->done);
    }
    return !news.empty();
}

void dds_commands::take_as_standby()
{
    for (int i = 0; i < most_rounds && take(); ++i) {
    }
}

void dds_commands::take(order_request request)
{
    const bool active = is_active_();
    const auto refuse = [&](order_result why, const char* text) {
        if (active)
            reply(request.key, {why, 0, text}, wall_now());
    };
    if (!request.malformed.empty()) {
        refuse(order_result::rejected, request.malformed.c_str());
        return;
    }
    if (!config_.writes) {
        refuse(order_result::denied, "this gateway obeys no DDS requests: dds/writes in its configuration allows them");
        return;
    }
    order_log::verdict verdict = log_.came(request.key, active ? order_log::role::active : order_log::role::standby);
    if (verdict.answer)
        reply(request.key, *verdict.answer, verdict.done == wall_time::never ? wall_now() : verdict.done);
    if (verdict.execute)
        asio::co_spawn(loop_, execute(std::move(request.key), std::move(request.what)), asio::detached);
}

asio::awaitable<void> dds_commands::execute(order_key key, order what)
{
    auto work = carry_out_(std::move(what));
    const auto outcome = co_await std::move(work);
    // The other member has this request, too, and answers it: with two answers nobody would know which one holds.
    if (!is_active_()) {
        log_.given_up(key);
        co_return;
    }
    const wall_time done = wall_now();
    log_.done(key, outcome, done);
    reply(key, outcome, done);
}

void dds_commands::reply(const order_key& to, const order_outcome& outcome, wall_time done)
{
    if (port_)
        port_->reply(to, outcome, done);
}

}  // namespace plcgw
