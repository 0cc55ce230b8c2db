// Which MODBUS TCP servers can listen side by side: our decision, and the kernel's.
#include "tests/config/plant.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <doctest/doctest.h>

#include <fstream>

TEST_SUITE_BEGIN("check");

using namespace plcgw::config;
namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

enum class together { yes, no };

struct {
    const char* first;
    const char* second;
    together can;
} const rows[] = {
    {"127.0.0.1", "127.0.0.1", together::no},
    {"127.0.0.1", "127.0.0.2", together::yes},
    {"127.0.0.1", "0.0.0.0", together::no},
    {"0.0.0.0", "127.0.0.1", together::no},
    {"0.0.0.0", "0.0.0.0", together::no},
    {"127.0.0.1", "::1", together::yes},
    {"::1", "0:0:0:0:0:0:0:1", together::no},
    {"0.0.0.0", "::1", together::yes},
    {"::1", "::", together::no},
    {"::", "::1", together::no},
    {"::", "127.0.0.1", together::no},
    {"127.0.0.1", "::", together::no},
    {"::", "0.0.0.0", together::no},
    {"127.0.0.1", "::ffff:127.0.0.1", together::no},
    {"::ffff:127.0.0.2", "127.0.0.1", together::yes},
    {"::ffff:127.0.0.1", "0.0.0.0", together::no},
};

std::string two_servers(const char* first, const char* second, int second_port)
{
    return std::string(R"({"plcs": [{"name": "a"}], "modbus_tcp": [{"port": 1502, "other_units": "a", "listen": ")") +
           first + "\"},\n{\"other_units\": \"a\", \"listen\": \"" + second +
           "\",\n\"port\": " + std::to_string(second_port) + "}]}";
}

// As daemon/tcp_server.cpp does it.
boost::system::error_code listen(tcp::acceptor& on, const char* address, unsigned short port)
{
    const tcp::endpoint at(asio::ip::make_address(address), port);
    boost::system::error_code ec;
    if (on.open(at.protocol(), ec) || on.set_option(asio::socket_base::reuse_address(true), ec) || on.bind(at, ec))
        return ec;
    return on.listen(asio::socket_base::max_listen_connections, ec);
}

bool ipv6_listens_for_ipv4()
{
    std::ifstream setting("/proc/sys/net/ipv6/bindv6only");
    int only = 1;
    setting >> only;
    return setting && only == 0;
}

}  // namespace

TEST_CASE("check: two servers on one port")
{
    for (const auto& row : rows) {
        INFO(std::string(row.first) << " and " << std::string(row.second));
        CHECK(said(two_servers(row.first, row.second, 1502)) ==
              (row.can == together::yes ? ""
                                        : "3 /modbus_tcp/1/port is 1502, which /modbus_tcp/0 takes already: listen on "
                                          "another port or address"));
        CHECK(said(two_servers(row.first, row.second, 1503)) == "");
    }
}

TEST_CASE("check: Linux agrees about servers on one port")
{
    asio::io_context loop;
    for (const auto& row : rows) {
        INFO(std::string(row.first) << " and " << std::string(row.second));
        tcp::acceptor first(loop);
        if (const auto ec = listen(first, row.first, 0)) {
            REQUIRE_MESSAGE(std::string(row.first).find(':') != std::string::npos, ec.message());
            continue;  // a machine without IPv6
        }
        tcp::acceptor second(loop);
        const auto ec = listen(second, row.second, first.local_endpoint().port());
        const bool v6 = std::string(row.first).find(':') != std::string::npos ||
                        std::string(row.second).find(':') != std::string::npos;
        if (v6 && !ipv6_listens_for_ipv4())
            continue;
        if (row.can == together::no)
            CHECK(ec == asio::error::address_in_use);
        else
            CHECK_MESSAGE(!ec, ec.message());
    }
}

TEST_CASE("check: a port that is not written is 502 for both")
{
    CHECK(said("{\"plcs\": [{\"name\": \"a\"}],\n\"modbus_tcp\": [\n{\"other_units\": \"a\"},\n{\"other_units\": "
               "\"a\"}]}") ==
          "4 /modbus_tcp/1/port is 502, which /modbus_tcp/0 takes already: listen on another port or address");
}

TEST_CASE("check: addresses and units of a server")
{
    const change_row changes[] = {
        {R"("listen": "127.0.0.1",
      "port": 1502)",
         R"("listen": "localhost", "port": 1502)",
         R"(61 /modbus_tcp/0/listen is "localhost", expected an IP address such as 0.0.0.0)"},
        {R"("listen": "127.0.0.1",
      "port": 1502)",
         R"("listen": "127.0.0.256", "port": 1502)",
         R"(61 /modbus_tcp/0/listen is "127.0.0.256", expected an IP address such as 0.0.0.0)"},
        {R"("listen": "127.0.0.1",
      "port": 1502)",
         R"("listen": "127.0.0.1:1502", "port": 1502)",
         R"(61 /modbus_tcp/0/listen is "127.0.0.1:1502", expected an IP address such as 0.0.0.0)"},
        {R"("listen": "127.0.0.1",
      "port": 1502)",
         R"("listen": "[::1]", "port": 1502)",
         R"(61 /modbus_tcp/0/listen is "[::1]", expected an IP address such as 0.0.0.0)"},
        {R"("listen": "127.0.0.1",
      "port": 1502)",
         R"("listen": "127.1", "port": 1502)",
         R"(61 /modbus_tcp/0/listen is "127.1", expected an IP address such as 0.0.0.0)"},
        {R"("listen": "127.0.0.1",
      "port": 1502)",
         R"("listen": "fe80::1%lo", "port": 1502)", ""},
        {R"(
      "other_units": "spare")",
         R"("max_clients": 1)", R"(67 /modbus_tcp/1 leads to no PLC: give "units" or "other_units")"},
        {R"("other_units": "spare")", R"("units": [], "other_units": "")",
         R"(67 /modbus_tcp/1 leads to no PLC: give "units" or "other_units")"},
    };
    for (const change_row& row : changes)
        check_row(row);
}
