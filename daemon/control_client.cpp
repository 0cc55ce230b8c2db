#include "daemon/control_client.hpp"

#include "daemon/control_path.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace plcgw {
namespace {

namespace asio = boost::asio;

nlohmann::json failure(const std::string& path, const boost::system::error_code& why)
{
    return {{"ok", false},
            {"unreachable", true},
            {"error", fmt::format("no gateway answers on {} ({}): does it run, and may you use it? --socket names "
                                  "another one",
                                  path, why.message())}};
}

}  // namespace

nlohmann::json ask_gateway(const std::string& socket, const nlohmann::json& command)
{
    const std::string path = control_socket(socket).string();
    asio::io_context loop;
    asio::local::stream_protocol::socket gateway(loop);
    boost::system::error_code ec;
    if (gateway.connect(asio::local::stream_protocol::endpoint(path), ec); ec)
        return failure(path, ec);
    asio::write(gateway, asio::buffer(command.dump() + "\n"), ec);
    std::string reply;
    if (!ec)
        asio::read_until(gateway, asio::dynamic_buffer(reply), '\n', ec);
    if (ec)
        return failure(path, ec);
    return nlohmann::json::parse(reply, nullptr, false);
}

}  // namespace plcgw
