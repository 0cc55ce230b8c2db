#include "tests/bench/stations.hpp"

namespace plcgw::bench {
namespace {

unsigned word_at(byte_span from, std::size_t at) { return static_cast<unsigned>(from[at]) << 8 | from[at + 1]; }

void append_word(byte_vector& to, unsigned word)
{
    to.push_back(static_cast<std::uint8_t>(word >> 8 & 0xFF));
    to.push_back(static_cast<std::uint8_t>(word & 0xFF));
}

byte_vector exception(std::uint8_t function, std::uint8_t code)
{
    return {static_cast<std::uint8_t>(function | 0x80), code};
}

byte_vector read_registers(station& of, byte_span pdu, unsigned first, unsigned count)
{
    if (of.moving != 0 && ++of.reads % of.moving == 0)
        for (unsigned i = 0; i < count; ++i)
            ++of.registers[first + i];
    byte_vector answer{pdu[0], static_cast<std::uint8_t>(2 * count)};
    for (unsigned i = 0; i < count; ++i)
        append_word(answer, of.registers[first + i]);
    return answer;
}

}  // namespace

std::uint16_t modbus_crc(byte_span bytes)
{
    unsigned crc = 0xFFFF;
    for (const std::uint8_t each : bytes) {
        crc ^= each;
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc & 1) != 0 ? crc >> 1 ^ 0xA001 : crc >> 1;
    }
    return static_cast<std::uint16_t>(crc);
}

std::optional<std::size_t> request_size(byte_span begun)
{
    if (begun.size() < 2)
        return 0;
    if (begun[1] == 3 || begun[1] == 4 || begun[1] == 6)
        return 8;
    if (begun[1] == 16)
        return begun.size() < 7 ? 0 : std::size_t{9} + begun[6];
    return std::nullopt;
}

std::optional<station_answer> station_table::ask(byte_span adu)
{
    const byte_span body = adu.first(adu.size() - 2);
    const std::uint16_t crc = modbus_crc(body);
    if (adu[adu.size() - 2] != (crc & 0xFF) || adu[adu.size() - 1] != crc >> 8)
        return std::nullopt;
    const auto found = stations_.find(body[0]);
    if (found == stations_.end() || found->second.dead)
        return std::nullopt;
    station_answer answer{found->second.turnaround, {body[0]}};
    const byte_vector pdu = serve(found->second, body.subspan(1));
    answer.response.insert(answer.response.end(), pdu.begin(), pdu.end());
    const std::uint16_t check = modbus_crc(answer.response);
    answer.response.push_back(static_cast<std::uint8_t>(check & 0xFF));
    answer.response.push_back(static_cast<std::uint8_t>(check >> 8));
    return answer;
}

byte_vector station_table::serve(station& of, byte_span pdu)
{
    if (of.refuses != 0)
        return exception(pdu[0], of.refuses);
    const unsigned first = word_at(pdu, 1);
    const unsigned second = word_at(pdu, 3);  // how many, or the value of a single register
    const unsigned count = pdu[0] == 6 ? 1 : second;
    if (count == 0 || count > 125 || (pdu[0] == 16 && pdu.size() != 6 + std::size_t{2} * count))
        return exception(pdu[0], 3);
    if (first + count > of.registers.size())
        return exception(pdu[0], 2);
    if (pdu[0] == 3 || pdu[0] == 4)
        return read_registers(of, pdu, first, count);
    for (unsigned i = 0; i < count; ++i)
        of.registers[first + i] =
            static_cast<std::uint16_t>(pdu[0] == 6 ? second : word_at(pdu, 6 + std::size_t{2} * i));
    return {pdu.begin(), pdu.begin() + 5};
}

}  // namespace plcgw::bench
