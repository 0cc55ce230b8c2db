#include "tests/bench/wire_port.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cerrno>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

namespace plcgw::bench {

using field::check;

wire_port::wire_port(const std::filesystem::path& link, wire on) : link_(link), wire_(std::move(on))
{
    pty_pair pty;
    if (std::filesystem::is_symlink(link_))
        std::filesystem::remove(link_);
    std::filesystem::create_symlink(pty.device, link_);
    fd_ = std::move(pty.ours);
    theirs_ = std::move(pty.theirs);
}

wire_port::wire_port(std::uint16_t port, wire on) : wire_(std::move(on)), port_(port) { wait_for_client(); }

wire_port::~wire_port()
{
    std::error_code ignored;
    if (!link_.empty())
        std::filesystem::remove(link_, ignored);
}

void wire_port::wait_for_client()
{
    fd_ = field::unique_fd(check(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0), "socket"));
    const int again = 1;
    check(::setsockopt(fd(), SOL_SOCKET, SO_REUSEADDR, &again, sizeof again), "SO_REUSEADDR");
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port_);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    check(::bind(fd(), reinterpret_cast<const sockaddr*>(&address), sizeof address), "bind");
    check(::listen(fd(), 1), "listen");
    accepts_ = true;
}

void wire_port::hand_over(nanoseconds now, stillness& machine)
{
    if (deadline() > now)
        return;
    machine.note_late(now - deadline());
    const byte_vector chunk = wire_.due(now);
    if (accepts_)
        return;
    [[maybe_unused]] const auto written = ::write(fd(), chunk.data(), chunk.size());
}

bool wire_port::look(nanoseconds now)
{
    if (accepts_) {
        field::unique_fd client(check(::accept4(fd(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC), "accept4"));
        const int at_once = 1;
        check(::setsockopt(client.get(), IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once), "TCP_NODELAY");
        std::swap(fd_, client);
        accepts_ = false;
        return true;
    }
    std::array<std::uint8_t, 1024> room{};
    const auto size = ::read(fd(), room.data(), room.size());
    if (size > 0)
        wire_.heard(now, byte_span(room).first(static_cast<std::size_t>(size)));
    else if (port_ != 0 && (size == 0 || errno != EAGAIN)) {
        fd_ = {};
        wait_for_client();
        return true;
    }
    return false;
}

nlohmann::json wire_port::report()
{
    nlohmann::json said = wire_.window().report();
    said["link"] = link_.filename();
    said["baud"] = wire_.format().baud;
    said["rule_us"] = static_cast<double>(wire_.format().rule()) / 1000;
    return said;
}

}  // namespace plcgw::bench
