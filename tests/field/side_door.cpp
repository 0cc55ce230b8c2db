#include "tests/field/side_door.hpp"

#include <cerrno>
#include <stdexcept>
#include <string>

namespace plcgw::field {

side_door::side_door(int port) : context_(modbus_new_tcp("127.0.0.1", port))
{
    if (!context_)
        throw std::runtime_error("TCP port " + std::to_string(port) + ": " + modbus_strerror(errno));
    listener_ = unique_fd(check(modbus_tcp_listen(context_.get(), 8), "127.0.0.1:" + std::to_string(port)));
    modbus_set_response_timeout(context_.get(), 0, 1000);  // it sleeps this long before some exception responses
    modbus_set_byte_timeout(context_.get(), 0, 20'000);    // half a request must not hold up the line
}

void side_door::watch(std::vector<pollfd>& watched) const
{
    watched.push_back({.fd = listener_.get(), .events = POLLIN, .revents = 0});
    for (const unique_fd& client : clients_)
        watched.push_back({.fd = client.get(), .events = POLLIN, .revents = 0});
}

void side_door::serve(std::span<const pollfd> rows, const std::function<modbus_mapping_t&()>& registers)
{
    std::vector<unique_fd> staying;
    for (std::size_t i = 0; i < clients_.size(); ++i) {
        if (rows[i + 1].revents == 0 || answer(clients_[i], registers))
            staying.push_back(std::move(clients_[i]));
    }
    clients_ = std::move(staying);

    int listener = listener_.get();
    if (rows[0].revents != 0) {
        const int client = modbus_tcp_accept(context_.get(), &listener);
        if (client != -1)
            clients_.emplace_back(client);
    }
}

bool side_door::answer(const unique_fd& client, const std::function<modbus_mapping_t&()>& registers)
{
    request_buffer room;
    modbus_set_socket(context_.get(), client.get());
    const int size = modbus_receive(context_.get(), room.data());
    if (size > 0)
        modbus_reply(context_.get(), room.data(), size, &registers());
    return size >= 0;
}

}  // namespace plcgw::field
