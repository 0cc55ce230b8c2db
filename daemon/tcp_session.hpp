// One client's connection to a MODBUS TCP server.
#pragma once

#include "bridge/port_meter.hpp"
#include "bridge/standby/line_voice.hpp"
#include "daemon/read_before.hpp"
#include "daemon/tcp_framing.hpp"
#include "daemon/through_writes.hpp"
#include "daemon/unit_table.hpp"

#include <boost/asio/ip/tcp.hpp>

#include <array>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace plcgw {

// What the clients of one listener share.
struct tcp_service {
    std::string endpoint;  // "127.0.0.1:1502", for the log
    port_meter meter;      // of all its clients
    unit_table units;
    through_writes* through = nullptr;
    std::function<void()> settle;       // called after replies went out, to drain what the requests changed
    const line_voice* voice = nullptr;  // of a pair: answers only while that says so
    duration idle_timeout{};
    unsigned max_outstanding = 1;  // forwarded requests of one client at a time

    // Some in each period: a client that sends nonsense all the time does not fill the log.
    bool may_complain();

    bool may_answer() const { return voice == nullptr || voice->may_speak(now()); }

private:
    time_point complaints_since_{};
    unsigned complaints_ = 0;
};

// Requests to PLCs are answered at once, in their order; those to lines when the line has the answer, in the order of
// the requests to the same station. While max_outstanding wait for lines, nothing more is read from the client.
class tcp_session : public std::enable_shared_from_this<tcp_session> {
public:
    // peer: for the log. The service outlives the session's work.
    tcp_session(asio::ip::tcp::socket client, std::string peer, std::unique_ptr<tcp_framing> framing,
                tcp_service& service);

    asio::awaitable<void> run();  // until the client leaves, or has to
    void dismiss() { close(); }   // another member of the pair answers

private:
    struct forwarded {
        modbus::transaction_id id{};
        modbus::unit_id unit{};  // as the client calls it
        modbus::request request;
    };
    struct station_queue {
        std::deque<forwarded> waiting;  // the first one is under way
        forward_gate::handle under_way;
    };
    using station_key = std::pair<forward_gate*, station_number>;

    void take_questions();
    void take(const modbus::tcp_frame& question);
    void append(const modbus::tcp_frame& reply);
    void take_broadcast(bytes pdu);
    void forward(const modbus::tcp_frame& question, const unit_target& to);
    static asio::awaitable<void> ask_station(std::shared_ptr<tcp_session> self, station_key to);
    static asio::awaitable<void> answer_later(std::shared_ptr<tcp_session> self, modbus::tcp_frame reply,
                                              through_writes::handle written);
    asio::awaitable<void> something_changed();
    bool is_full() const;
    bool is_late(time_point asked_at) const;
    bool has_hung_up();

    void flush();  // one write at a time, of all that is there
    void watch();  // that deadlines are kept
    void look();   // whether one has passed
    time_point overdue_at() const;
    void abandon();  // what waits for lines
    void close();

    asio::ip::tcp::socket socket_;
    std::string peer_;
    std::unique_ptr<tcp_framing> framing_;
    tcp_service& service_;
    const forward_asker as_;
    std::array<std::uint8_t, 4096> received_{};
    bool is_open_ = true;
    bool good_ = true;  // the stream can be trusted

    std::map<station_key, station_queue> stations_;
    std::size_t under_way_ = 0;  // in all of them
    bool abandoned_ = false;
    asio::steady_timer changed_;  // cancelled when something did

    buffer replies_;
    buffer sending_;  // while writing_
    bool writing_ = false;

    asio::steady_timer watch_;
    time_point looking_at_ = time_point::max();  // when the timer will look
    time_point quiet_since_;
    time_point part_since_;  // that only a part of a request is there
    time_point write_until_{};
};

}  // namespace plcgw
