// What a client and 31 servers say, at random: every function, strange lengths, data that looks like frames.
#pragma once

#include "protocols/modbus/rtu.hpp"

#include <algorithm>
#include <random>

namespace plcgw::test {

class bus_traffic {
public:
    explicit bus_traffic(unsigned seed) : dice(seed) {}

    std::mt19937 dice;

    static const std::vector<modbus::unit_id>& own()
    {
        static const std::vector<modbus::unit_id> units{modbus::unit_id{1}, modbus::unit_id{17}, modbus::unit_id{200}};
        return units;
    }

    unsigned below(unsigned n) { return static_cast<unsigned>(dice() % n); }
    bool happens(unsigned percent) { return below(100) < percent; }
    std::uint8_t byte() { return static_cast<std::uint8_t>(below(256)); }

    modbus::unit_id own_unit() { return own()[below(3)]; }

    modbus::unit_id neighbour()
    {
        const unsigned unit = 2 + below(31);
        return modbus::unit_id{static_cast<std::uint8_t>(unit == 17 ? 247 : unit)};
    }

    struct exchange {
        modbus::frame request;
        modbus::frame response;
    };

    exchange with_neighbour(bool unknown_functions)
    {
        exchange e = known();
        if (unknown_functions && happens(8)) {
            const std::uint8_t code = happens(50) ? 0x41 : 0x64;
            e.request.pdu = with_data({code}, 1 + below(40));
            e.response.pdu = with_data({code}, 1 + below(40));
        }
        e.request.unit = e.response.unit = neighbour();
        if (happens(7))
            e.response.pdu = {static_cast<std::uint8_t>(e.request.pdu[0] | 0x80),
                              static_cast<std::uint8_t>(1 + below(11))};
        return e;
    }

    modbus::frame to_us()
    {
        modbus::frame request = known().request;
        request.unit = own_unit();
        return request;
    }

    modbus::frame broadcast()
    {
        modbus::frame request;
        do
            request = known().request;
        while (request.pdu[0] != 0x05 && request.pdu[0] != 0x06 && request.pdu[0] != 0x0F && request.pdu[0] != 0x10);
        return request;
    }

    // Data as registers hold it: noise, zeros, and what a bus logger would hold: whole frames.
    buffer data(std::size_t size)
    {
        buffer result(size);
        if (!happens(30))
            for (std::uint8_t& each : result)
                each = happens(30) ? 0 : byte();
        if (happens(25)) {
            modbus::frame inner{happens(80) ? own_unit() : modbus::unit_id::broadcast,
                                {0x03, 0x00, byte(), 0x00, 0x01}};
            if (inner.unit == modbus::unit_id::broadcast)
                inner.pdu = {0x06, 0x00, byte(), byte(), byte()};
            const buffer adu = encode_rtu(inner);
            for (std::size_t at = below(4); at + adu.size() <= size; at += adu.size() + below(4))
                std::copy(adu.begin(), adu.end(), result.begin() + static_cast<std::ptrdiff_t>(at));
        }
        return result;
    }

private:
    buffer with_data(buffer pdu, std::size_t size)
    {
        const buffer more = data(size);
        pdu.insert(pdu.end(), more.begin(), more.end());
        return pdu;
    }

    buffer counted(std::uint8_t code, std::size_t size)
    {
        return with_data({code, static_cast<std::uint8_t>(size)}, size);
    }

    exchange known()
    {
        const std::uint8_t high = happens(50) ? 0 : byte();
        const std::uint8_t low = byte();
        const unsigned n = happens(80) ? 1 + below(10) : 1 + below(121);
        const auto count = static_cast<std::uint8_t>(n);
        const auto same = [](buffer pdu) { return exchange{{{}, pdu}, {{}, pdu}}; };
        switch (below(15)) {
        case 0: return {{{}, {0x01, high, low, 0, count}}, {{}, counted(0x01, (n + 7) / 8)}};
        case 1: return {{{}, {0x02, high, low, 0x07, 0xD0}}, {{}, counted(0x02, 250)}};
        case 2: return {{{}, {0x04, high, low, 0, count}}, {{}, counted(0x04, 2 * n)}};
        case 3: return same({0x05, high, low, static_cast<std::uint8_t>(happens(50) ? 0xFF : 0), 0});
        case 4: return same({0x06, high, low, byte(), byte()});
        case 5: return {{{}, {0x07}}, {{}, {0x07, byte()}}};
        case 6: return same({0x08, 0x00, static_cast<std::uint8_t>(below(0x13)), byte(), byte()});
        case 7: return {{{}, {0x0B}}, {{}, {0x0B, 0, 0, byte(), byte()}}};
        case 8: return {{{}, {0x0C}}, {{}, counted(0x0C, 6 + below(65))}};
        case 9: return {{{}, {0x11}}, {{}, {0x11, 0x02, 0xF3, 0xFF}}};
        case 10: return same({0x16, high, low, byte(), byte(), byte(), byte()});
        case 11: {
            const auto size = static_cast<std::uint8_t>(2 * count);
            return {{{}, with_data({0x10, high, low, 0, count, size}, size)}, {{}, {0x10, high, low, 0, count}}};
        }
        case 12: {
            const auto size = static_cast<std::uint8_t>((n + 7) / 8);
            return {{{}, with_data({0x0F, high, low, 0, count, size}, size)}, {{}, {0x0F, high, low, 0, count}}};
        }
        case 13: {
            const auto size = static_cast<std::uint8_t>(2 * count);
            return {{{}, with_data({0x17, high, low, 0, 3, high, low, 0, count, size}, size)}, {{}, counted(0x17, 6)}};
        }
        default: return {{{}, {0x03, high, low, 0, count}}, {{}, counted(0x03, 2 * n)}};
        }
    }
};

}  // namespace plcgw::test
