#include "bridge/messages/words.hpp"
#include "tests/support/messages.hpp"

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::messages;
using namespace plcgw::test;
using general_purpose::ending;

namespace {

using memory = std::vector<std::uint16_t>;

constexpr std::uint16_t untouched = 0xAAAA;

}  // namespace

TEST_CASE("message words: 12345 as the manual shows it, DT200 and following (9.4.2)")
{
    memory dt(10, untouched);
    CHECK(*store_message(raw("12345"), dt) == 4);
    CHECK(dt == memory{5, 0x3231, 0x3433, 0x0035, untouched, untouched, untouched, untouched, untouched, untouched});
}

TEST_CASE("message words: an even number of bytes, none, and the most")
{
    memory dt(4, untouched);
    CHECK(*store_message(raw("1234"), dt) == 3);
    CHECK(dt == memory{4, 0x3231, 0x3433, untouched});
    CHECK(*store_message({}, dt) == 1);
    CHECK(dt == memory{0, 0x3231, 0x3433, untouched});

    memory large(2049);
    CHECK(*store_message(buffer(4096, 0xFF), large) == 2049);
    CHECK(large.front() == 4096);
    CHECK(large.back() == 0xFFFF);
}

TEST_CASE("message words: an area that is too small is left alone")
{
    memory dt(3, untouched);
    CHECK(store_message(raw("12345"), dt).error() == errc::overlong);
    CHECK(dt == memory(3, untouched));
    CHECK(store_message(raw("1234"), dt).has_value());
    CHECK(store_message({}, words{}).error() == errc::overlong);
    memory large(3000);
    CHECK(store_message(buffer(4097), large).error() == errc::overlong);
}

TEST_CASE("message words: what was stored is sent as it was, at every length")
{
    for (std::size_t size = 1; size <= 4094; size += size < 20 ? 1 : 97) {
        buffer content;
        for (std::size_t i = 0; i < size; ++i)
            content.push_back(static_cast<std::uint8_t>(i * 7 + size));
        memory dt(words_of(size));
        REQUIRE(store_message(content, dt).has_value());
        const auto back = message_in(dt);
        REQUIRE(back.has_value());
        CHECK(back->content == content);
        CHECK(back->how == ending::with_end_code);
    }
}

TEST_CASE("message words: 1 to 4094 bytes are sent, -1 to -4096 without an end code (9.3.3)")
{
    const struct {
        int count;
        bool good;
    } counts[] = {{1, true},  {4094, true},  {4095, false},  {4096, false},   {0, false},
                  {-1, true}, {-4096, true}, {-4097, false}, {-32768, false}, {32767, false}};
    memory dt(2049, 0x4241);
    for (const auto& each : counts) {
        CAPTURE(each.count);
        dt.front() = static_cast<std::uint16_t>(each.count);
        const auto message = message_in(dt);
        REQUIRE(message.has_value() == each.good);
        if (!message) {
            CHECK(message.error() == errc::bad_count);
            continue;
        }
        CHECK(message->content.size() == static_cast<std::size_t>(std::abs(each.count)));
        CHECK(message->content.front() == 'A');
        CHECK((message->how == ending::without_end_code) == (each.count < 0));
    }
}

TEST_CASE("message words: a count beyond the area is no message")
{
    CHECK(message_in(memory{3, 0x3231}).error() == errc::bad_count);
    CHECK(message_in(memory{2, 0x3231})->content == raw("12"));
    CHECK(message_in(memory{1, 0x3231})->content == raw("1"));
    CHECK(message_in(memory{}).error() == errc::bad_count);
}

TEST_SUITE_END();
