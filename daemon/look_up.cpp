#include "daemon/look_up.hpp"

#include <boost/asio/posix/stream_descriptor.hpp>

#include <algorithm>
#include <atomic>
#include <memory>
#include <netdb.h>
#include <sys/socket.h>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace plcgw {
namespace {

using boost::system::error_code;
using found_addresses = boost::system::result<tcp_endpoints>;

// Shared with the thread, which may outlive everything else: it touches only this. It tells that it is done by shutting
// down its end of a pair of sockets.
struct question {
    ~question()
    {
        if (thread_end >= 0)
            ::close(thread_end);
    }
    int thread_end = -1;
    std::atomic<bool> answered = false;
    found_addresses answer = error_code(asio::error::host_not_found);
};

void answer_in_thread(std::shared_ptr<question> asked, const std::string& host, unsigned port, const resolver& resolve)
{
    asked->answer = resolve(host, port);
    asked->answered = true;
    ::shutdown(asked->thread_end, SHUT_RDWR);
}

}  // namespace

found_addresses ask_resolver(const std::string& host, unsigned port)
{
    addrinfo wanted{};
    wanted.ai_family = AF_UNSPEC;
    wanted.ai_socktype = SOCK_STREAM;
    wanted.ai_flags = AI_ADDRCONFIG;
    addrinfo* first = nullptr;
    const std::string service = std::to_string(port);
    const int failed = ::getaddrinfo(host.c_str(), service.c_str(), &wanted, &first);
    if (failed == EAI_AGAIN)
        return error_code(asio::error::host_not_found_try_again);
    if (failed != 0)
        return error_code(asio::error::host_not_found);
    tcp_endpoints all;
    for (const addrinfo* each = first; each != nullptr; each = each->ai_next) {
        asio::ip::tcp::endpoint& at = all.emplace_back();
        at.resize(each->ai_addrlen);
        std::copy_n(reinterpret_cast<const unsigned char*>(each->ai_addr), each->ai_addrlen,
                    reinterpret_cast<unsigned char*>(at.data()));
    }
    ::freeaddrinfo(first);
    return all;
}

asio::awaitable<found_addresses> look_up(time_point deadline, asio::any_io_executor executor, std::string host,
                                         unsigned port, resolver resolve)
{
    error_code no_address;
    const auto address = asio::ip::make_address(host, no_address);
    if (!no_address) {
        tcp_endpoints only;
        only.emplace_back(address, static_cast<asio::ip::port_type>(port));
        co_return only;
    }

    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends) != 0)
        co_return error_code(errno, boost::system::system_category());
    asio::posix::stream_descriptor done(executor, ends[0]);
    const auto asked = std::make_shared<question>();
    asked->thread_end = ends[1];
    try {
        std::thread(answer_in_thread, asked, host, port, std::move(resolve)).detach();
    }
    catch (const std::system_error& error) {
        co_return error_code(error.code());
    }
    deadline_guard<asio::posix::stream_descriptor> guard(done);
    std::uint8_t none = 0;
    const auto told = co_await read_before(deadline, done, guard, asio::buffer(&none, 1));
    if (!asked->answered)
        co_return told ? error_code(asio::error::timed_out) : told.error();
    co_return std::move(asked->answer);
}

}  // namespace plcgw
