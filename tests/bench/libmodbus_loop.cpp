// What an engineer writes with libmodbus: reads the given blocks round and round as fast as it goes, until SIGTERM.
// usage: libmodbus-loop DEVICE BAUD UNIT FIRST:COUNT...
#include <modbus.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

int main(int argc, char** argv)
{
    if (argc < 5) {
        std::fputs("usage: libmodbus-loop DEVICE BAUD UNIT FIRST:COUNT...\n", stderr);
        return 2;
    }
    std::vector<std::pair<int, int>> blocks;
    for (int i = 4; i < argc; ++i) {
        std::pair<int, int>& block = blocks.emplace_back();
        if (std::sscanf(argv[i], "%d:%d", &block.first, &block.second) != 2)
            return 2;
    }
    const std::unique_ptr<modbus_t, decltype(&modbus_free)> line(modbus_new_rtu(argv[1], std::atoi(argv[2]), 'E', 8, 1),
                                                                 modbus_free);
    if (line == nullptr || modbus_set_slave(line.get(), std::atoi(argv[3])) != 0 || modbus_connect(line.get()) != 0) {
        std::fprintf(stderr, "libmodbus-loop: %s\n", modbus_strerror(errno));
        return 1;
    }
    std::array<std::uint16_t, 125> values{};
    for (std::size_t at = 0;; at = (at + 1) % blocks.size())
        if (modbus_read_registers(line.get(), blocks[at].first, blocks[at].second, values.data()) == -1)
            std::fprintf(stderr, "libmodbus-loop: %s\n", modbus_strerror(errno));
}
