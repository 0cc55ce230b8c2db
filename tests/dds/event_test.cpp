#include "bridge/dds/event_table.hpp"
#include "bridge/dds/event_text.hpp"

#include <doctest/doctest.h>

using namespace plcgw;

namespace {

constexpr std::int64_t second = 1'000'000'000;
constexpr wall_time t0{1'700'000'000 * second};

constexpr wall_time after(std::int64_t seconds) { return wall_time{static_cast<std::int64_t>(t0) + seconds * second}; }

received_block block(const std::string& route, quality state, std::vector<std::uint16_t> words)
{
    const auto count = static_cast<std::uint32_t>(words.size());
    return {"gw", "m1", 1, 192, {route, "holding", 100, sample_format::words, count, std::move(words), state, t0}};
}

received_status status(std::uint64_t beat) { return {{"gw", "m1", "0.1.0", ""}, {{}, 0, t0, 1, 2}, beat}; }

}  // namespace

TEST_CASE("event text: times and ages")
{
    CHECK(iso_time(wall_time{1'700'000'000'123'456'789}) == "2023-11-14T22:13:20.123Z");
    CHECK(iso_time(wall_time{-1}) == "1969-12-31T23:59:59.999Z");
    CHECK(iso_time(wall_time::never) == "never");
    CHECK(age_text(wall_time::never, t0) == "-");
    CHECK(age_text(t0, t0) == "0.0 s");
    CHECK(age_text(after(5), t0) == "0.0 s");  // a clock ahead of ours
    CHECK(age_text(t0, after(35)) == "35 s");
    CHECK(age_text(t0, after(600)) == "10 min");
    CHECK(age_text(t0, after(7200)) == "2 h");
    CHECK(age_text(t0, after(10 * 86400)) == "10 d");
    CHECK(age_text(wall_time{INT64_MIN}, wall_time{INT64_MAX}).ends_with(" d"));
}

TEST_CASE("event text: values, lines, and nothing that steers a terminal")
{
    sample bits{"in", "discrete", 8, sample_format::bits, 18, {0x8001, 0x0002}, quality::good, t0};
    CHECK(values_text(bits) == "100000000000000101");
    bits.count = 4'000'000'000;  // a foreign writer's mistake
    CHECK(values_of(bits).size() == 32);

    CHECK(line_of(block("speed", quality::good, {1, 65535})) ==
          "2023-11-14T22:13:20.000Z gw speed holding 100..101 good: 1 65535");
    CHECK(line_of(status(3)) == "gateway gw, member m1: solo, routes 1/2 up");
    CHECK(line_of(gone_block{"gw", "speed", "holding", 100, gone_reason::disposed}) ==
          "- gw speed holding 100 gone: disposed");
    serial_message message{"scale", message_direction::received, "weighing", "", {'1', 0x1B, 0xFF}, t0};
    CHECK(line_of(received_message{"gw", "m1", 1, message}) ==
          "2023-11-14T22:13:20.000Z gw scale received weighing: 1<ESC>\\xFF");
    message.name.clear();
    message.reason = "weighing: at byte 1\x1b";
    CHECK(line_of(received_message{"gw", "m1", 1, message}) ==
          "2023-11-14T22:13:20.000Z gw scale received -: 1<ESC>\\xFF REFUSED: weighing: at byte 1?");
    CHECK(printable("a\x1b[2Jb\x7f\u009bc\u00b5") == "a?[2Jb??c\u00b5");
    CHECK(printable("\xC2z") == "\xC2z");
}

TEST_CASE("event table: says what changed and marks what is not good")
{
    event_table table;
    CHECK(table.lines(t0, 80, 24).empty());
    CHECK(table.apply(block("speed", quality::good, {1}), t0));
    CHECK_FALSE(table.apply(block("speed", quality::good, {1}), t0));
    CHECK(table.apply(block("speed", quality::good, {2}), t0));
    CHECK(table.apply(block("temp", quality::comm_error, {9}), t0));
    CHECK(table.lines(t0, 80, 24).at(0) == table_line{line_style::warning, "gateway gw: no status"});
    CHECK(table.apply(status(1), t0));
    CHECK_FALSE(table.apply(status(2), t0));

    const auto lines = table.lines(after(1), 90, 24);
    REQUIRE(lines.size() == 4);
    CHECK(lines[0].text == "gateway gw, member m1 0.1.0: solo, routes 1/2 up, beat 2, heard 1.0 s ago");
    CHECK(lines[2] ==
          table_line{line_style::plain, "  speed                holding 100        good           1.0 s  2"});
    CHECK(lines[3] ==
          table_line{line_style::error, "! temp                 holding 100        comm error     1.0 s  9"});
    CHECK(table.lines(after(16), 90, 24)[0].text.ends_with("beat 2, SILENT for 16 s"));
}

TEST_CASE("event table: a gateway that is gone is seen, a disposed route disappears")
{
    event_table table;
    table.apply(status(1), t0);
    table.apply(block("speed", quality::good, {1}), t0);
    table.apply(block("temp", quality::good, {9}), t0);
    CHECK(table.apply(gone_gateway{"gw", "m1", gone_reason::writer_lost}, t0));
    CHECK(table.apply(gone_block{"gw", "speed", "holding", 100, gone_reason::writer_lost}, t0));
    CHECK(table.apply(gone_block{"gw", "temp", "holding", 100, gone_reason::disposed}, t0));
    CHECK_FALSE(table.apply(gone_block{"gw", "never heard", "holding", 1, gone_reason::disposed}, t0));

    const auto lines = table.lines(after(2), 90, 24);
    REQUIRE(lines.size() == 3);
    CHECK(lines[0] == table_line{line_style::error, "gateway gw, member m1 0.1.0: GATEWAY GONE since 2.0 s"});
    CHECK(lines[2] == table_line{line_style::old, "x speed                holding 100        gone           2.0 s  1"});

    CHECK(table.apply(block("speed", quality::good, {1}), t0));  // the same value, but somebody writes it again
    CHECK(table.lines(t0, 90, 24)[2].style == line_style::plain);
}

TEST_CASE("event table: fits the terminal")
{
    event_table table;
    for (int i = 0; i < 30; ++i)
        table.apply(block("r\u00e4der-" + std::to_string(10 + i), quality::good, std::vector<std::uint16_t>(100, 7)),
                    t0);
    const auto lines = table.lines(t0, 30, 10);
    REQUIRE(lines.size() == 10);
    CHECK(lines[9].text == "... 23 more lines");
    CHECK(lines[2].text == "  r\u00e4der-10             hold...");
    for (const std::size_t width : {0U, 1U, 2U, 3U, 4U})
        for (const auto& line : table.lines(t0, width, 3))
            CHECK(line.text.size() <= width);
    CHECK(table.lines(t0, 80, 0).empty());
}

TEST_CASE("event table: ports and devices with their states, and the last events as lines")
{
    event_table table;
    const port_status bus{"bus 1", link_state::up, t0, 10, 11, 100, 110, 2, 1, "bad checksum"};
    const device_status pump{"pump", "bus 1", link_state::up, t0, t0, 11, 1, 0, 12'300, 100'000, ""};
    CHECK(table.apply(received_port{"gw", "m1", bus}, t0));
    CHECK(table.apply(received_device{"gw", "m1", pump}, t0));
    port_status moved = bus;
    moved.rx_frames = 99;
    CHECK_FALSE(table.apply(received_port{"gw", "m1", moved}, t0));  // a counter is no news
    device_status down = pump;
    down.state = link_state::down;
    down.detail = "does not answer\x1b";
    CHECK(table.apply(received_device{"gw", "m1", down}, t0));
    for (std::uint64_t i = 1; i <= 20; ++i)
        CHECK(table.apply(received_event{"gw", "m1", i, t0, line_event::severity::warning, "device.down", "pump",
                                         "number " + std::to_string(i)},
                          t0));

    const auto lines = table.lines(after(5), 200, 100);
    const auto at = [&](const std::string& part) {
        for (const table_line& each : lines)
            if (each.text.find(part) != std::string::npos)
                return each;
        return table_line{};
    };
    CHECK(at("99/11").text == "  bus 1                99/11              up             5.0 s  2, last: bad checksum");
    CHECK(at("99/11").style == line_style::plain);
    CHECK(at("does not answer").text ==
          "! pump                 bus 1              down           5.0 s  12.3/100.0, 1/11: does not answer?");
    CHECK(at("does not answer").style == line_style::error);
    CHECK(at("number 20").text == "  2023-11-14T22:13:20.000Z gw warning device.down pump: number 20");
    CHECK(at("number 12").text.empty());

    CHECK(table.apply(gone_device{"gw", "pump", gone_reason::writer_lost}, t0));
    CHECK(table.apply(gone_port{"gw", "bus 1", gone_reason::disposed}, t0));
    CHECK_FALSE(table.apply(gone_port{"gw", "bus 1", gone_reason::disposed}, t0));
    bool lost = false;
    for (const table_line& each : table.lines(after(5), 200, 100)) {
        CHECK(each.text.find("99/11") == std::string::npos);
        lost = lost || each.text.starts_with("x pump");
    }
    CHECK(lost);
}

TEST_CASE("event text: ports, devices and events as lines")
{
    const port_status bus{"bus 1", link_state::down, t0, 1, 2, 3, 4, 5, 6, "unplugged"};
    CHECK(line_of(received_port{"gw", "m1", bus}) ==
          "gw port bus 1: down since 2023-11-14T22:13:20.000Z, 1 frames in, 2 out, 5 errors, 6 reopens (unplugged)");
    const device_status pump{"pump", "bus 1", link_state::degraded, t0, t0, 7, 8, 9, 0, 100'000, ""};
    CHECK(line_of(received_device{"gw", "m1", pump}) ==
          "gw device pump on bus 1: degraded since 2023-11-14T22:13:20.000Z, 7 requests, 8 timeouts, 9 exceptions, "
          "answers in -, cycle 100.0 ms");
    CHECK(line_of(gone_device{"gw", "pump", gone_reason::disposed}) == "- gw device pump gone: disposed");
}
