#include "daemon/plc_links.hpp"

#include "daemon/line_events.hpp"
#include "daemon/log.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ip/host_name.hpp>

#include <algorithm>

namespace plcgw {
namespace {

constexpr duration open_again = std::chrono::seconds(1);
constexpr duration pair_round = std::chrono::milliseconds(100);  // that the role is looked at

}  // namespace

plc_links::plc_links(asio::io_context& loop, const gateway_config& config, wall_time started,
                     std::function<void()> settle)
    : loop_(loop),
      settings_(config.dds.settings), self_{config.gateway,
                                            config.dds.member.empty() ? asio::ip::host_name() : config.dds.member,
                                            started},
      settle_(std::move(settle)), wakes_(loop), timer_(loop), gate_(loop)
{
}

void plc_links::add(const plc_link_config& link, plc::simulated_plc& plc, fp7_ports& ports)
{
    const std::size_t index = links_.size();
    links_.emplace_back(link.name, plc, link.as, self_);
    ports.open(plc, link.as, [this, index] { reset(index); });
    log::info("PLC link {}: {} is station {}", link.name, plc.name(), link.as.station);
}

// Called while the memory's changes are drained, which sends what is due.
void plc_links::reset(std::size_t index)
{
    log::info("PLC link {}: channel reset, the stations are taken in anew", links_[index].link());
    links_[index].reset();
    timer_.cancel();
}

void plc_links::start() { asio::co_spawn(loop_, keep_time(), asio::detached); }

bool plc_links::open()
{
    auto made = plc_link_port::create(settings_, plc_link_pace{}.given_up);
    if (!made) {
        if (!std::exchange(failed_, true))
            say(line_event::severity::warning, "plc_link.failed", "dds",
                "PLC links: {}. It is tried again until it works", made.error().text);
        return false;
    }
    const int descriptor = ::dup(made->descriptor());
    if (descriptor < 0)
        return false;
    wakes_.assign(descriptor);
    port_.emplace(std::move(*made));
    failed_ = false;
    asio::co_spawn(loop_, listen(), asio::detached);
    return true;
}

void plc_links::close()
{
    port_.reset();
    boost::system::error_code ignored;
    wakes_.close(ignored);
    timer_.cancel();
}

asio::awaitable<void> plc_links::keep_time()
{
    for (;;) {
        co_await gate_.wait();
        while (!port_ && !open()) {
            timer_.expires_after(open_again);
            co_await timer_.async_wait(no_throw);
        }
        co_await take_part();
        if (gate_.is_open())
            continue;  // closed for a new domain
        // The others hear at once that its stations are gone, and take those of the other member in.
        close();
        for (plc_link_exchange& link : links_)
            link.reset();
    }
}

asio::awaitable<void> plc_links::take_part()
{
    while (port_ && gate_.is_open()) {
        // Words that came while this process stood still came in time: before somebody is given up.
        receive();
        for (plc_link_exchange& link : links_)
            link.look(now());
        log_events();
        send();
        timer_.expires_at(gate_.is_ever_closed() ? std::min(wake_at(), now() + pair_round) : wake_at());
        co_await timer_.async_wait(no_throw);
    }
}

asio::awaitable<void> plc_links::listen()
{
    for (;;) {
        const auto [ec] = co_await wakes_.async_wait(asio::posix::stream_descriptor::wait_read, no_throw);
        if (ec || !port_)
            co_return;  // what comes is taken when the timer looks
        receive();
    }
}

void plc_links::receive()
{
    if (!port_ || !gate_.is_open())
        return;
    const std::vector<plc_link_news> news = port_->take();
    for (const plc_link_news& each : news)
        for (plc_link_exchange& link : links_) {
            if (const auto* const area = std::get_if<plc_link_area>(&each))
                link.received(now(), *area);
            else
                link.gone(now(), std::get<plc_link_gone>(each));
        }
    log_events();
    if (!news.empty())
        settle_();
}

void plc_links::memory_changed(const plc::simulated_plc& plc, const plc::change& changed)
{
    for (plc_link_exchange& link : links_)
        link.memory_changed(plc, changed);
}

void plc_links::send()
{
    if (!port_ || !gate_.is_open())
        return;
    for (plc_link_exchange& link : links_)
        if (const auto area = link.next(now(), wall_now()))
            port_->publish(*area);
    if (wake_at() < timer_.expiry())
        timer_.cancel();
}

time_point plc_links::wake_at() const
{
    time_point at = time_point::max();
    for (const plc_link_exchange& link : links_)
        at = std::min(at, link.wake_at());
    return at;
}

void plc_links::log_events()
{
    for (plc_link_exchange& link : links_)
        for (const plc_link_event& event : link.take_events()) {
            const bool warns = event.level == plc_link_event::severity::warning;
            say(warns ? line_event::severity::warning : line_event::severity::info,
                warns ? "plc_link.warning" : "plc_link.info", link.link(), "{}", event.text);
        }
}

}  // namespace plcgw
