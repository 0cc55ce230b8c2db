#include "daemon/control_server.hpp"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <nlohmann/json.hpp>

#include <sys/stat.h>

namespace plcgw {
namespace {

using asio::local::stream_protocol;
using boost::system::error_code;

constexpr std::size_t longest_command = 64 * 1024;

// Nobody answers on a socket that a killed gateway left.
bool is_stale(asio::io_context& loop, const std::filesystem::path& path)
{
    stream_protocol::socket probe(loop);
    error_code ec;
    probe.connect(stream_protocol::endpoint(path.string()), ec);
    return ec == asio::error::connection_refused;
}

nlohmann::json refusal(const std::string& why) { return {{"ok", false}, {"error", why}}; }

}  // namespace

control_server::control_server(asio::io_context& loop, std::filesystem::path path, control_handler handler)
    : path_(std::move(path)), handler_(std::move(handler)), acceptor_(loop)
{
}

control_server::~control_server()
{
    std::error_code ignored;
    if (listens_)
        std::filesystem::remove(path_, ignored);
}

error_code control_server::listen()
{
    std::error_code failed;
    if (std::filesystem::create_directories(path_.parent_path(), failed))
        std::filesystem::permissions(path_.parent_path(), std::filesystem::perms::owner_all, failed);
    auto& loop = static_cast<asio::io_context&>(acceptor_.get_executor().context());
    if (std::filesystem::is_socket(path_, failed) && is_stale(loop, path_))
        std::filesystem::remove(path_, failed);

    error_code ec;
    if (acceptor_.open({}, ec); ec)
        return ec;
    const mode_t before = ::umask(0117);  // srw-rw----
    acceptor_.bind(stream_protocol::endpoint(path_.string()), ec);
    ::umask(before);
    if (ec)
        return ec;
    listens_ = true;
    acceptor_.listen(asio::socket_base::max_listen_connections, ec);
    return ec;
}

asio::awaitable<void> control_server::accept_clients()
{
    for (;;) {
        auto [ec, client] = co_await acceptor_.async_accept(no_throw);
        if (ec)
            co_return;
        asio::co_spawn(acceptor_.get_executor(), serve(std::move(client)), asio::detached);
    }
}

asio::awaitable<void> control_server::serve(stream_protocol::socket client)
{
    std::string received;
    for (;;) {
        auto into = asio::dynamic_buffer(received, longest_command);
        const auto [ec, size] = co_await asio::async_read_until(client, into, '\n', no_throw);
        if (ec)
            co_return;
        std::string line = received.substr(0, size);
        received.erase(0, size);
        const std::string reply = co_await answer(std::move(line));
        const auto [failed, sent] = co_await asio::async_write(client, asio::buffer(reply), no_throw);
        if (failed)
            co_return;
    }
}

asio::awaitable<std::string> control_server::answer(std::string line) const
{
    auto command = nlohmann::json::parse(line, nullptr, false);
    nlohmann::json reply = refusal("a command is one JSON object");
    try {
        if (command.is_object())
            reply = co_await handler_(std::move(command));
    }
    catch (const nlohmann::json::exception& wrong) {  // a value of another type than the command has
        reply = refusal(wrong.what());
    }
    co_return reply.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace plcgw
