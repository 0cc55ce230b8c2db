// Two members of a pair in virtual time: processes that stop and die, a network that parts, cables that are pulled.
#pragma once

#include "bridge/standby/pair.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace plcgw::test {

using namespace std::chrono_literals;

class pair_world {
public:
    static constexpr duration step = 10ms;
    static constexpr duration lease = 500ms;
    static constexpr duration quiet = 800ms;
    static constexpr duration limit = 2s;
    static constexpr duration period = 100ms;  // of the only poll on each line
    static constexpr duration exchange = 40ms;
    static constexpr std::size_t lines = 2;

    struct wire {
        bool has_device = true;
        time_point busy_until{};  // somebody's exchange
        int speaker = -1;
    };

    struct process {
        std::unique_ptr<standby_pair> pair;
        bool stopped = false;
        std::array<bool, lines> plugged{true, true};
        std::array<bool, lines> present{true, true};  // the adapter
        std::array<line_heard, lines> heard{};
        std::array<time_point, lines> next_question{};
        std::vector<pair_beat> inbox;
        time_point next_look{};
        time_point said_at{};
        bool gone_told = true;  // to the other one
    };

    explicit pair_world(bool hand_back = true) : hand_back_(hand_back)
    {
        start(0);
        start(1);
    }

    void start(int who)
    {
        process& p = members[index(who)];
        const auto plugged = p.plugged;
        const auto present = p.present;
        p = process{};
        p.plugged = plugged;
        p.present = present;
        pair_settings s;
        s.member = who == 0 ? "a" : "b";
        s.priority = who == 0 ? 100 : 50;
        s.hand_back = hand_back_;
        s.lease = lease;
        s.listen = 2s;
        s.hand_back_after = 3s;
        s.lines = {{"one", quiet, limit, true}, {"two", quiet, limit, true}};
        p.pair = std::make_unique<standby_pair>(s, now);
        for (std::size_t line = 0; line < lines; ++line) {
            p.heard[line].listens = true;
            attach(who, line, present[line]);
        }
    }
    void attach(int who, std::size_t line, bool on)
    {
        process& p = members[index(who)];
        p.present[line] = on;
        p.heard[line].port_open = on;
        p.heard[line].open_since = now;
    }
    void kill(int who)
    {
        members[index(who)].pair.reset();
        members[index(who)].stopped = false;
    }
    void end(int who)
    {
        process& p = members[index(who)];
        p.pair->leave(now);
        say(who);
        kill(who);
        p.gone_told = true;
    }
    void stop(int who) { members[index(who)].stopped = members[index(who)].pair != nullptr; }
    void go_on(int who) { members[index(who)].stopped = false; }
    void plug(int who, std::size_t line, bool in) { members[index(who)].plugged[line] = in; }

    void run(duration how_long)
    {
        for (const time_point end = now + how_long; now < end; now += step)
            tick();
    }

    // Until somebody's questions are answered on that line again; no longer than `most`.
    duration until_spoken(int who, std::size_t line, duration most)
    {
        const time_point begin = now;
        const auto before = questions[index(who)][line];
        while (questions[index(who)][line] == before && now - begin < most)
            run(step);
        return now - begin;
    }

    bool works(int who) const
    {
        const process& p = members[index(who)];
        return p.pair && !p.stopped;
    }
    bool is_active(int who) const { return works(who) && members[index(who)].pair->is_active(now); }

    time_point now = time_point{} + 1h;
    bool network = true;
    std::array<process, 2> members;
    std::array<wire, lines> wires;
    std::array<std::array<unsigned, lines>, 2> questions{};
    std::array<time_point, lines> last_question{now, now};
    std::vector<std::string> collisions;
    unsigned both_active = 0;  // steps

private:
    static std::size_t index(int who) { return static_cast<std::size_t>(who); }

    void say(int who)
    {
        process& p = members[index(who)];
        process& other = members[index(1 - who)];
        p.said_at = now;
        p.gone_told = false;
        if (network && other.pair)
            other.inbox.push_back(p.pair->beat());
    }

    void tick()
    {
        for (const int who : {0, 1}) {
            process& p = members[index(who)];
            process& other = members[index(1 - who)];
            // What the middleware does: also of a process that died.
            if (!p.gone_told && now - p.said_at > lease && works(1 - who)) {
                p.gone_told = true;
                other.pair->lost();
            }
            if (!works(who))
                continue;
            // After SIGCONT a driver may well be the first that runs.
            for (std::size_t line = 0; line < lines; ++line)
                drive(who, line);
            for (const pair_beat& each : std::exchange(p.inbox, {}))
                p.pair->heard(now, each);
            if (now >= p.next_look || !p.inbox.empty()) {
                p.next_look = now + p.pair->beat_period();
                p.pair->look(now, p.heard);
                for (const pair_event& each : p.pair->take_events())
                    if (std::getenv("PAIR_LOG") != nullptr)
                        std::printf("%8lld %s: %s\n", static_cast<long long>(now.time_since_epoch() / 1ms),
                                    who == 0 ? "a" : "b", each.text.c_str());
                say(who);
            }
            if (p.pair->take_news())
                say(who);
        }
        both_active += is_active(0) && is_active(1) && network ? 1 : 0;
    }

    void drive(int who, std::size_t line)
    {
        process& p = members[index(who)];
        wire& w = wires[line];
        if (now < p.next_question[line] || now >= p.pair->speaks_until(line))
            return;
        if (!p.heard[line].port_open)
            return;
        p.heard[line].asked = now;
        p.next_question[line] = now + (p.plugged[line] && w.has_device ? period : 300ms);
        if (!p.plugged[line])
            return;
        if (now < w.busy_until && w.speaker != who)
            collisions.push_back("line " + std::to_string(line) + " at " +
                                 std::to_string(now.time_since_epoch() / 1ms) + " by " + std::to_string(who));
        w.busy_until = now + exchange;
        w.speaker = who;
        ++questions[index(who)][line];
        last_question[line] = now;
        process& other = members[index(1 - who)];
        if (other.pair && other.plugged[line] && other.present[line])
            other.heard[line].foreign_request = other.heard[line].anything = now;
        if (!w.has_device)
            return;
        for (process* each : {&p, &other})
            if (each->pair && each->plugged[line] && each->present[line])
                each->heard[line].anything = now + exchange;
    }

    bool hand_back_;
};

}  // namespace plcgw::test
