#include "daemon/standby.hpp"

#include "daemon/log.hpp"
#include "daemon/pair_lines.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/ip/host_name.hpp>

#include <limits>

namespace plcgw {
namespace {

constexpr duration open_pause = std::chrono::seconds(1);
constexpr duration publish_pause = std::chrono::milliseconds(20);

pair_settings settings_of(const gateway_config& config, const std::string& member)
{
    pair_settings s;
    s.member = member;
    s.priority = config.standby.priority.value_or(0);
    s.hand_back = config.standby.hand_back;
    s.lease = config.standby.lease;
    s.listen = config.standby.listen;
    s.hand_back_after = config.standby.hand_back_after;
    return s;
}

pair_settings settings_of(const gateway_config& config, const std::string& member, const pair_mirror::line_list& lines)
{
    pair_settings s = settings_of(config, member);
    for (const auto& each : lines)
        s.lines.push_back(pair_line_of(config, each->config));
    return s;
}

}  // namespace

standby_member::standby_member(asio::io_context& loop, const gateway_config& config, wall_time started,
                               const std::vector<std::unique_ptr<plc::simulated_plc>>& plcs,
                               const pair_mirror::line_list& lines, dds_link& dds, work does)
    : loop_(loop),
      config_(config), self_{config.gateway, config.dds.member.empty() ? asio::ip::host_name() : config.dds.member,
                             started},
      lines_(lines), dds_(dds), work_(std::move(does)), pair_(settings_of(config, self_.member, lines), now()),
      mirror_(plcs, lines,
              [this](std::size_t line, time_point at) {
                  const line_heard& heard = voices_[line].heard;
                  return heard.listens && heard.port_open && heard.anything &&
                         at - *heard.anything < config_.standby.line_silence;
              }),
      wakes_(loop), timer_(loop), soon_(loop)
{
    for (const auto& each : lines) {
        voices_.emplace_back();
        each->driver->obey(voices_.back());
    }
    dds_.obey(answers_);
}

void standby_member::start()
{
    log::info("member {} of a pair, priority {}: {}", self_.member, config_.standby.priority.value_or(0), pair_.why());
    asio::co_spawn(loop_, keep_time(), asio::detached);
}

void standby_member::open()
{
    if (port_ || now() < open_again_)
        return;
    open_again_ = now() + open_pause;
    auto made = pair_port::create(config_.dds.settings, self_, config_.standby.lease);
    if (!made) {
        if (!std::exchange(failed_, true))
            log::warning(
                "pair: {}. It is tried again until it works; until then only the lines tell of the other member",
                made.error().text);
        return;
    }
    const int descriptor = ::dup(made->descriptor());
    if (descriptor < 0)
        return;
    port_.emplace(std::move(*made));
    wakes_.assign(descriptor);
    asio::co_spawn(loop_, listen(descriptor), asio::detached);
}

void standby_member::renew_dds()
{
    boost::system::error_code ignored;
    wakes_.close(ignored);
    port_.reset();
    open_again_ = {};
}

asio::awaitable<void> standby_member::listen(int descriptor)
{
    while (wakes_.is_open() && wakes_.native_handle() == descriptor) {
        const auto [ec] = co_await wakes_.async_wait(asio::posix::stream_descriptor::wait_read, no_throw);
        if (ec)
            co_return;  // what comes is taken when the timer looks
        receive();
        if (pair_.take_news()) {
            obey_roles();
            say_beat();
        }
        log_events();
    }
}

asio::awaitable<void> standby_member::keep_time()
{
    for (;;) {
        open();
        receive();  // what came while this process stood still came before it looks around
        look();
        timer_.expires_after(pair_.beat_period());
        co_await timer_.async_wait(no_throw);
    }
}

void standby_member::receive()
{
    if (!port_)
        return;
    const std::vector<pair_news> news = port_->take();
    bool took_any = false;
    for (const pair_news& each : news) {
        if (const auto* const beat = std::get_if<pair_beat>(&each))
            heard(*beat);
        else if (const auto* const lost = std::get_if<pair_lost>(&each)) {
            if (pair_.other() && pair_.other()->member == lost->member)
                pair_.lost();
        }
        else if (!is_active()) {
            took_any = true;
            if (const auto* const chunk = std::get_if<memory_chunk>(&each))
                mirror_.take(*chunk, now());
            else
                mirror_.take(std::get<route_record>(each), now(), wall_now());
        }
    }
    if (!mirror_.misfit().empty() && std::exchange(said_misfit_, mirror_.misfit()) != mirror_.misfit())
        log::warning("pair: the other member is configured differently: {} is not the same here", mirror_.misfit());
    if (took_any)
        work_.settle();
}

void standby_member::heard(const pair_beat& beat)
{
    const bool is_namesake = beat.member.empty() || beat.member == self_.member + "'";
    if (is_namesake && !std::exchange(said_namesake_, true))
        log::error("pair: two members of {} are called {}: give each its own \"member\" in \"dds\". The one that "
                   "started first goes on",
                   self_.gateway, self_.member);
    pair_.heard(now(), beat);
}

void standby_member::look()
{
    std::vector<line_heard> heard;
    for (const line_voice& each : voices_)
        heard.push_back(each.heard);
    pair_.look(now(), heard);
    pair_.take_news();
    obey_roles();
    say_beat();
    repeat();
    log_events();
}

// A subscriber drops what the new member says as long as it takes the old one for the stronger: until it hears of the
// new strength, or until the old one's lease has run out for it, too. DDS does not keep that for it.
void standby_member::repeat()
{
    if (repeat_at_.empty() || now() < repeat_at_.front())
        return;
    repeat_at_.pop_front();
    if (works_)
        work_.repeat();
}

void standby_member::obey_roles()
{
    const bool works = pair_.is_active(now());
    if (works && !works_)
        work_.prepare();
    if (works)
        answers_.speak_until(pair_.lease_until());
    else
        answers_.be_silent();
    if (works && !works_) {
        strength_ =
            static_cast<std::int32_t>(std::min<std::uint64_t>(pair_.term(), std::numeric_limits<std::int32_t>::max()));
        for (const auto& each : lines_)
            each->routes.forget_written();
    }
    for (std::size_t i = 0; i < voices_.size(); ++i) {
        const bool before = voices_[i].may_speak(now());
        voices_[i].speak_until(pair_.speaks_until(i));
        if (before != voices_[i].may_speak(now()))
            lines_[i]->driver->wake();
    }
    if (works)
        dds_.assert_liveliness();
    if (std::exchange(works_, works) == works)
        return;
    dds_.set_strength(works ? strength_ : 0);
    if (works) {
        mirror_.say_everything();
        repeat_at_ = {now() + pair_.beat_period(), now() + config_.standby.lease * 3 / 2};
        work_.begin();
        publish();
    }
    else {
        work_.end();
    }
}

void standby_member::say_beat()
{
    if (port_)
        port_->publish(pair_.beat());
}

void standby_member::leave()
{
    pair_.leave(now());
    obey_roles();
    say_beat();
    log_events();
}

void standby_member::memory_changed(const plc::simulated_plc& plc, const plc::change& changed)
{
    mirror_.memory_changed(plc, changed);
}

void standby_member::settled(const running_line& line)
{
    if (is_active())
        mirror_.say_writes(line);
}

void standby_member::say(const std::vector<sample>& samples)
{
    if (!is_active() || samples.empty())
        return;
    for (const sample& each : samples)
        mirror_.say_route(each.route);
    published_at_ = {};
    publish();
}

// At once, but not more often than the other member needs it.
void standby_member::publish()
{
    if (!port_ || !is_active())
        return;
    const bool is_too_soon = now() - published_at_ < publish_pause;
    if (!is_too_soon) {
        published_at_ = now();
        if (mirror_.publish(*port_, pair_.term()))
            return;
    }
    if (std::exchange(publish_soon_, true))
        return;
    soon_.expires_after(publish_pause);
    soon_.async_wait([this](boost::system::error_code) {
        publish_soon_ = false;
        published_at_ = {};
        publish();
    });
}

std::optional<std::string> standby_member::switch_over()
{
    auto refused = pair_.switch_over(now());
    if (pair_.take_news())
        say_beat();
    return refused;
}

void standby_member::log_events()
{
    for (const pair_event& each : pair_.take_events()) {
        if (each.level == pair_event::severity::warning)
            log::warning("pair: {}", each.text);
        else
            log::info("pair: {}", each.text);
    }
}

}  // namespace plcgw
