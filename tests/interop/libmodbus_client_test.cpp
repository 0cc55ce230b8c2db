// libmodbus as a client of the MODBUS TCP server: every function that it knows, and the exceptions.
// usage: libmodbus_client_test PORT, of a gateway with a fresh PLC at unit 1 and none at unit 9.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>
#include <modbus/modbus.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <vector>

namespace {

int port = 0;

class client {
public:
    explicit client(int unit = 1) : context_(modbus_new_tcp("127.0.0.1", port))
    {
        REQUIRE(context_);
        modbus_set_response_timeout(get(), 10, 0);
        modbus_set_slave(get(), unit);
        REQUIRE(modbus_connect(get()) == 0);
    }
    modbus_t* get() const { return context_.get(); }

    // Sent as it is: libmodbus itself refuses counts that are out of range. Returns the error of the answer.
    int error_of(std::vector<std::uint8_t> request) const
    {
        std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> answer;
        REQUIRE(modbus_send_raw_request(get(), request.data(), static_cast<int>(request.size())) > 0);
        const int size = modbus_receive_confirmation(get(), answer.data());
        REQUIRE(size == 9);  // MBAP, function, exception
        CHECK(answer[7] == (request[1] | 0x80));
        return MODBUS_ENOBASE + answer[8];
    }

private:
    struct closer {
        void operator()(modbus_t* context) const
        {
            modbus_close(context);
            modbus_free(context);
        }
    };
    std::unique_ptr<modbus_t, closer> context_;
};

using words = std::vector<std::uint16_t>;
using bits = std::vector<std::uint8_t>;

template <class Values>
Values read(int (*function)(modbus_t*, int, int, typename Values::value_type*), const client& from, int first,
            int count)
{
    Values values(static_cast<std::size_t>(count));
    CHECK(function(from.get(), first, count, values.data()) == count);
    return values;
}

}  // namespace

TEST_CASE("libmodbus writes and reads bits")
{
    const client c;
    CHECK(modbus_write_bit(c.get(), 100, 1) == 1);
    const bits written{1, 0, 1, 1, 0, 0, 0, 0, 1, 1};
    CHECK(modbus_write_bits(c.get(), 101, 10, written.data()) == 10);
    const bits expected{0, 1, 1, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0};
    CHECK(read<bits>(modbus_read_bits, c, 99, 13) == expected);
    CHECK(read<bits>(modbus_read_input_bits, c, 99, 13) == expected);
    CHECK(read<bits>(modbus_read_bits, c, 0, MODBUS_MAX_READ_BITS)[100] == 1);
}

TEST_CASE("libmodbus writes and reads registers")
{
    const client c;
    CHECK(modbus_write_register(c.get(), 200, 0x1234) == 1);
    const words written{1, 0xFFFF, 0x8000};
    CHECK(modbus_write_registers(c.get(), 201, 3, written.data()) == 3);
    const words expected{0, 0x1234, 1, 0xFFFF, 0x8000, 0};
    CHECK(read<words>(modbus_read_registers, c, 199, 6) == expected);
    CHECK(read<words>(modbus_read_input_registers, c, 199, 6) == expected);

    CHECK(modbus_mask_write_register(c.get(), 200, 0x00F2, 0x0025) == 1);  // the example of V1.1b3 section 6.16
    CHECK(read<words>(modbus_read_registers, c, 200, 1)[0] == ((0x1234 & 0x00F2) | (0x0025 & ~0x00F2)));

    words answer(3);
    CHECK(modbus_write_and_read_registers(c.get(), 300, 3, written.data(), 301, 3, answer.data()) == 3);
    CHECK(answer == words{0xFFFF, 0x8000, 0});
}

TEST_CASE("libmodbus understands the exceptions")
{
    const client c;
    std::uint16_t value = 0;
    CHECK(c.error_of({1, 0x11}) == EMBXILFUN);
    CHECK(modbus_read_registers(c.get(), 0xFFFF, 1, &value) == -1);
    CHECK(errno == EMBXILADD);
    CHECK(modbus_write_register(c.get(), 0xFFFF, 1) == -1);
    CHECK(errno == EMBXILADD);
    CHECK(c.error_of({1, 0x03, 0, 0, 0, 126}) == EMBXILVAL);
    CHECK(c.error_of({1, 0x05, 0, 0, 0x12, 0x34}) == EMBXILVAL);
    CHECK(modbus_read_registers(client(9).get(), 0, 1, &value) == -1);
    CHECK(errno == EMBXGPATH);
    CHECK(read<words>(modbus_read_registers, c, 0, 1) == words{0});  // and the connection goes on
}

int main(int argc, char** argv)
{
    if (argc != 2 || (port = std::atoi(argv[1])) == 0) {
        std::cerr << "usage: libmodbus_client_test PORT\n";
        return 2;
    }
    return doctest::Context().run();
}
