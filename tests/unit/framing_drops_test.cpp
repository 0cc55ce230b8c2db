// What a server line makes of bytes that are no frame: FX3 manual 6.4 (bus communication errors) and 12.6, errors 0205
// and 0206.
#include "protocols/modbus/rtu_bus.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("modbus");

using namespace plcgw;
using namespace plcgw::modbus;
using namespace std::chrono_literals;

namespace {

const time_point t0{1s};

// Why everything that was received was dropped, and its size.
std::vector<std::pair<errc, std::size_t>> dropped(const buffer& received)
{
    rtu_bus_framer in({unit_id{1}}, 20ms);
    std::vector<std::pair<errc, std::size_t>> all;
    const auto collect = [&](time_point now) {
        while (const auto event = in.next(now)) {
            CHECK(event->what == bus_event::kind::dropped);
            all.emplace_back(event->why, event->size);
        }
    };
    in.feed(t0, received);
    collect(t0);
    collect(t0 + 20ms);
    return all;
}

using drops = std::vector<std::pair<errc, std::size_t>>;

}  // namespace

TEST_CASE("rtu bus: up to three characters are too short, what breaks off is incomplete, a wrong CRC is one")
{
    const buffer request{0x01, 0x03, 0x00, 0x00, 0x00, 0x01, 0x84, 0x0A};
    for (std::size_t size = 1; size <= 3; ++size) {
        CAPTURE(size);
        CHECK(dropped(buffer(size, 0x55)) == drops{{errc::too_short, size}});
        CHECK(dropped(buffer(request.begin(), request.begin() + static_cast<std::ptrdiff_t>(size))) ==
              drops{{errc::too_short, size}});
    }
    CHECK(dropped(buffer(request.begin(), request.end() - 1)) == drops{{errc::incomplete, 7}});
    for (std::size_t bit = 0; bit < 16; ++bit) {
        CAPTURE(bit);
        buffer damaged = request;
        damaged[6 + bit / 8] = static_cast<std::uint8_t>(damaged[6 + bit / 8] ^ 1U << bit % 8);
        CHECK(dropped(damaged) == drops{{errc::bad_checksum, 8}});
    }
}

TEST_CASE("rtu bus: more than 256 characters without a frame in them are an overrun")
{
    const auto reasons = dropped(buffer(300, 0x55));
    REQUIRE_FALSE(reasons.empty());
    CHECK(reasons.front().first == errc::overlong);
    CHECK(dropped(buffer(256, 0x55)) == drops{{errc::bad_checksum, 256}});
}

TEST_SUITE_END();
