#include "daemon/line_ear.hpp"

#include "daemon/line_connection.hpp"
#include "daemon/running_line.hpp"

#include <algorithm>

namespace plcgw {
namespace {

// Permissions end by themselves; values age although nothing is heard.
constexpr duration round = std::chrono::milliseconds(100);
constexpr duration stood_still = 10 * round;

}  // namespace

line_ear::line_ear(asio::io_context& loop, const line_config& line, client_line& routes)
    : line_(line), routes_(routes), pause_(loop)
{
}

void line_ear::obey(line_voice& voice)
{
    voice_ = &voice;
    speaks_ = false;
    routes_.fall_silent();
    if (line_.device.empty())
        return;
    listener_ = listener_of(line_);
    voice.heard.listens = true;
}

line_listener line_ear::listener_of(const line_config& line) const
{
    const modbus::serial_options timing = timing_of(line);
    if (is_mewtocol(line.protocol)) {
        constexpr duration least_silence = std::chrono::milliseconds(100);  // as of those who ask
        return line_listener(
            mewtocol::bus_listener(timing.response_timeout, std::max<duration>(timing.silence, least_silence)));
    }
    modbus::bus_listener made(timing);
    for (const station& each : routes_.stations())
        made.set_timeout(unit_of(each.unit), each.timing.response_timeout);
    return line_listener(std::move(made));
}

bool line_ear::look()
{
    if (voice_ == nullptr)
        return true;
    awake_at_ = now();
    const bool may = voice_->may_speak(now());
    if (std::exchange(speaks_, may) == may)
        return may;
    if (!may)
        routes_.fall_silent();
    else if (open_)
        routes_.begin_to_speak(now());
    return may;
}

asio::awaitable<void> line_ear::wait()
{
    pause_.expires_after(round);
    co_await pause_.async_wait(no_throw);
}

void line_ear::opened()
{
    open_ = true;
    if (voice_ == nullptr) {
        routes_.port_opened();
        return;
    }
    if (look())
        routes_.begin_to_speak(now());
    voice_->heard.port_open = true;
    voice_->heard.open_since = now();
}

void line_ear::closed()
{
    open_ = false;
    if (voice_ != nullptr)
        voice_->heard.port_open = false;
}

bool line_ear::heard(bytes received)
{
    if (!listener_)
        return true;
    voice_->heard.anything = now();
    const bool is_late = now() - std::exchange(awake_at_, now()) > stood_still;
    if (is_late && !may_speak())
        return false;
    listener_->feed(now(), received);
    tell();
    return true;
}

void line_ear::spoke(bytes ours)
{
    if (!listener_)
        return;
    awake_at_ = now();
    voice_->heard.asked = now();
    listener_->spoke(now(), ours);
    tell();
}

time_point line_ear::look_again_at() const
{
    const time_point latest = now() + round;
    return listener_ ? std::min(latest, std::max(listener_->deadline(), now())) : latest;
}

void line_ear::tell()
{
    if (!listener_)
        return;
    while (const auto each = listener_->next(now()))
        routes_.overheard(each->unit, each->asked, each->answer, now(), wall_now());
    voice_->heard.foreign_request = listener_->foreign_question();
}

}  // namespace plcgw
