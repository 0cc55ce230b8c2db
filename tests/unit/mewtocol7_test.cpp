// MEWTOCOL7-COM: the vectors W01 to W12, responses in several frames, damaged frames.
#include "protocols/mewtocol/mewtocol7_conversation.hpp"
#include "protocols/mewtocol/text.hpp"
#include "tests/support/every_cut.hpp"
#include "tests/unit/mewtocol_damage.hpp"

#include <numeric>

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol7;
using namespace plcgw::test;
using mewtocol::append_hex;

namespace {

const state_read cps41e_in_run{0x07, 0x03, 0, 0x0453, 0x0453, 0x0453, 0x01, 0, 0, 0, "660100"};
constexpr std::uint16_t first_words[] = {5, 10};

struct vector7_row {
    const char* id;
    std::string request;
    std::string reply;  // empty: nobody answers
    std::optional<command> asked;
    std::optional<response> answer;
};

// clang-format off
const vector7_row rows[] = {
    {"W01", ">@EEE00#30STRD0043F1", ">@EEE00$30STRD00070300000453045304530100000000660100A7A5",
        read_status{}, cps41e_in_run},
    {"W04", ">@00100#00MMRDD001G0DT0000000000002****", ">@00100$00MMRD05000A0075BF",
        read_words{word_area::dt, 0, 2}, words_read{{5, 10}}},
    {"W05", ">@00100#00MMRDD001G0DT00000000000029377", ">@00100$00MMRD05000A0075BF",
        read_words{word_area::dt, 0, 2}, words_read{{5, 10}}},
    {"W06", ">@00101#00MMWTD001G0DT00000000000023412FF003632", ">@00101$00MMWTCDC4",
        write_words{word_area::dt, 0, {0x1234, 0x00FF}}, executed{}},
    {"W07", ">@001FF#00MMRDD001G0DT0000000000001BB93", ">@001FF$00MMRD00002B35",
        read_words{word_area::dt, 0, 1}, words_read{{0}}},
    {"W08", ">@00100#00MMRDD001G0DT0000000000001A1EC", ">@00100$00MMRD0000D43F",
        read_words{word_area::dt, 0, 1}, words_read{{0}}},
    {"W09", ">@00102#00XXXXD876", ">@00102!424620", std::nullopt, error_code::not_supported},
    {"W10", ">@00103#00MMRD6F8A", ">@00103!416800", std::nullopt, error_code::format},
    {"W11", ">@00104#00MMRDD001G0DT00000000000020000", ">@00104!402EA8", std::nullopt, error_code::check},
    {"W12", ">@01200#00MMRDD001G0DT000000000000191C3", "", read_words{word_area::dt, 0, 1}, std::nullopt},
};
// clang-format on

mewtocol_bench bench_for(const vector7_row& row)
{
    mewtocol_bench b;
    b.device.strd = cps41e_in_run;
    if (row.answer == response{words_read{{5, 10}}})
        b.device.set(word_area::dt, 0, {5, 10});
    return b;
}

std::string checked(std::string characters)
{
    append_hex(characters, crc16(characters), 4);
    return characters;
}

mewtocol::reception heard(const std::string& characters) { return {characters, {}, characters.size() + 1}; }

std::string text_of(const buffer& adu) { return {adu.begin(), adu.end() - 1}; }

}  // namespace

TEST_CASE("mewtocol7: the check value of the CRC")
{
    CHECK(crc16("123456789") == 0x6F91);
    CHECK(crc16("") == 0xFFFF);
}

TEST_CASE("mewtocol7 vectors: request -> command -> request, response -> answer -> response")
{
    const dialect d;
    for (const vector7_row& row : rows) {
        CAPTURE(row.id);
        const auto f = parse_frame(row.request);
        REQUIRE(f.has_value());
        if (f->checked != check::wrong)
            CHECK(encode_frame(*f) == with_cr(row.request));
        if (row.asked) {
            CHECK(*parse_command(std::string_view(f->text).substr(1), d) == *row.asked);
            CHECK(is_expressible(*row.asked, d));
            CHECK(f->text == "#" + encode_command(*row.asked, d));
        }
        if (row.reply.empty())
            continue;
        const auto r = parse_frame(row.reply);
        REQUIRE(r.has_value());
        CHECK(r->checked == check::good);
        CHECK(encode_frame(*r) == with_cr(row.reply));
        const command asked = row.asked.value_or(read_status{});
        CHECK(parse_response(asked, r->text, d).value() == *row.answer);
        CHECK(encode_response(asked, *row.answer, d) == r->text);
    }
}

TEST_CASE("mewtocol7 vectors: a station answers so, however the request is cut")
{
    for (const vector7_row& row : rows) {
        CAPTURE(row.id);
        every_cut(with_cr(row.request), [&](const pieces& received) {
            mewtocol_bench b = bench_for(row);
            buffer sent;
            for (const bytes piece : received) {
                const buffer reply = b.hear(piece);
                sent.insert(sent.end(), reply.begin(), reply.end());
            }
            CHECK(sent == (row.reply.empty() ? buffer{} : with_cr(row.reply)));
        });
    }
}

TEST_CASE("mewtocol7 vectors: the printed example of two frames")
{
    const auto asked = parse_frame(">@EEE00#00MMRDD001G0DT0000000001000C164");  // W02
    CHECK(asked->checked == check::good);
    CHECK(*parse_command(std::string_view(asked->text).substr(1), {}) == command{read_words{word_area::dt, 0, 1000}});
    conversation talk(station_id::any, read_words{word_area::dt, 0, 1000}, 0);
    CHECK(text_of(talk.begin()) == ">@EEE00#00MMRDD001G0DT0000000001000C164");
    const auto said = talk.hear(heard(checked(">@EEE00$00MMRD" + std::string(2000, '0')) + "&"));
    CHECK(text_of(std::get<mewtocol::ask_on>(said).request) == ">@EEE0117C0&");  // W03
    const auto ended = talk.hear(heard(checked(">@EEE01" + std::string(2000, '0'))));
    CHECK(std::get<response>(ended) == response{words_read{std::vector<std::uint16_t>(1000)}});
    CHECK(talk.next_number() == 2);
}

TEST_CASE("mewtocol7: both protocols on one port, the header tells which")
{
    mewtocol_bench b;
    b.device.strd = cps41e_in_run;
    CHECK(b.say("%EE#RT00").starts_with("%EE$RT"));
    CHECK(b.say(">@EEE00#30STRD0043F1").starts_with(">@EEE00$30STRD"));
}

TEST_CASE("mewtocol7: a damaged request is never executed, a damaged response is no answer")
{
    for (const vector7_row& row : rows) {
        CAPTURE(row.id);
        const auto number = parse_frame(row.request)->number;
        const auto station = parse_frame(row.request)->station;
        const bool believed = row.request.ends_with('*');  // without a check
        const auto executed_in = [&](const buffer& received) {
            unsigned count = 0;
            mewtocol::line_framer framer(1s);
            framer.feed(t0, received);
            server s({.own = station_id{1}, .dialect = {}});
            while (const auto r = framer.next(t0 + 1s))
                count += std::holds_alternative<command>(s.hear(t0, *r)) ? 1U : 0U;
            return count;
        };
        const auto is_answered = [&](const buffer& received) {
            mewtocol::line_framer framer(1s);
            framer.feed(t0, received);
            conversation talk(station, row.asked.value_or(read_words{word_area::dt, 0, 2}), number);
            talk.begin();
            while (const auto r = framer.next(t0 + 1s)) {
                const auto said = talk.hear(*r);
                if (std::holds_alternative<response>(said) || std::holds_alternative<mewtocol::ask_on>(said) ||
                    std::holds_alternative<mewtocol::not_now<response>>(said))
                    return true;
            }
            return false;
        };
        const buffer request = with_cr(row.request);
        const bool is_executed = row.asked && !row.reply.empty();
        CHECK(executed_in(request) == (is_executed ? 1U : 0U));
        buffer twice = request;
        twice.insert(twice.end(), request.begin(), request.end());
        CHECK(executed_in(twice) == (is_executed ? 2U : 0U));
        if (!believed)
            every_damage(request, [&](const buffer& damaged) { CHECK(executed_in(damaged) == 0); });
        if (row.reply.empty())
            continue;
        CHECK(is_answered(with_cr(row.reply)));
        every_damage(with_cr(row.reply), [&](const buffer& damaged) { CHECK_FALSE(is_answered(damaged)); });
    }
}

TEST_CASE("mewtocol7: 1019 words fit into one frame, more come in several, a lost one can be asked again")
{
    mewtocol_bench b;
    auto& dt = b.device.memory.at(word_area::dt);
    std::iota(dt.begin(), dt.end(), std::uint16_t{0});
    CHECK(b.say(checked(">@00100#00MMRDD001G0DT0000000001019")).size() == 14 + 4 * 1019 + 4);

    const std::string first = b.say(checked(">@00110#00MMRDD001G0DT0000000002500"));
    CHECK(first.size() + 1 == max_frame_size);
    CHECK(first.back() == '&');
    const std::string second = b.say(checked(">@00111") + "&");
    CHECK(second.starts_with(">@00111"));
    CHECK(second.back() == '&');
    CHECK(b.say(checked(">@00111") + "&") == second);                 // it was lost: once more
    CHECK(b.say(checked(">@00113") + "&") == checked(">@00113!43"));  // one too far
    CHECK(b.say(checked(">@EEE12") + "&") == checked(">@EEE12!43"));  // not who asked
    const std::string third = b.say(checked(">@00112") + "&");
    CHECK(third.back() != '&');
    CHECK(b.say(checked(">@00113") + "&") == checked(">@00113!43"));  // there is no more

    conversation talk(station_id{1}, read_words{word_area::dt, 0, 2500}, 0x10);
    talk.begin();
    for (const std::string& each : {first, second})
        CHECK(std::holds_alternative<mewtocol::ask_on>(talk.hear(heard(each))));
    const auto said = talk.hear(heard(third));
    REQUIRE(std::holds_alternative<response>(said));
    const auto& words = std::get<words_read>(std::get<response>(said)).values;
    CHECK(words.size() == 2500);
    CHECK(words[2499] == 2499);
    CHECK(words[1019] == 1019);
}

TEST_CASE("mewtocol7: a new command or time forgets the rest")
{
    mewtocol_bench b;
    CHECK(b.say(checked(">@001FF#00MMRDD001G0DT0000000002500")).back() == '&');
    CHECK(b.say(checked(">@00110#00MMRDD001G0DT0000000000001")) == checked(">@00110$00MMRD0000"));
    CHECK(b.say(checked(">@00100") + "&") == checked(">@00100!43"));
    CHECK(b.say(checked(">@001FF#00MMRDD001G0DT0000000002500")).back() == '&');
    CHECK(b.say(checked(">@00100") + "&").starts_with(">@00100"));  // 0 follows FF
    b.now += 31s;
    CHECK(b.say(checked(">@00101") + "&") == checked(">@00101!43"));
}

TEST_CASE("mewtocol7: MMWT takes 1014 words in a frame, longer blocks are cut")
{
    const dialect d;
    CHECK(max_words_written(d) == 1014);
    const std::vector<std::uint16_t> words(1014, 0xABCD);
    const command longest = write_words{word_area::dt, 100'000, words};
    CHECK(is_expressible(longest, d));
    const buffer adu = encode_frame({.station = station_id{1}, .text = "#" + encode_command(longest, d)});
    CHECK(adu.size() == max_frame_size);
    CHECK_FALSE(is_expressible(write_words{word_area::dt, 0, std::vector<std::uint16_t>(1015)}, d));

    CHECK(plan_write({word_area::dt, 5, words}, d)->size() == 1);
    const auto two = plan_write({word_area::dt, 5, std::vector<std::uint16_t>(1015, 1)}, d).value();
    CHECK(two[0] == command{write_words{word_area::dt, 5, std::vector<std::uint16_t>(1014, 1)}});
    CHECK(two[1] == command{write_words{word_area::dt, 1019, {1}}});
    CHECK_FALSE(plan_write({word_area::dt, 0, {}}, d));
    CHECK_FALSE(plan_write({word_area::fl, 0, {1}}, d));  // no name for it
    CHECK_FALSE(plan_write({word_area::dt, 99'999'999, {1, 2}}, d));
}

TEST_CASE("mewtocol7: each kind of bad input has its error code")
{
    const std::string zeros(4100, '0');
    struct {
        std::string text;
        const char* code;
    } const refusals[] = {
        {"", "41"},
        {"#", "41"},
        {"00MMRD", "41"},
        {"$00MMRD", "41"},
        {"#00MMR", "41"},
        {"#01MMRDD001G0DT0000000000001", "42"},
        {"#30STRD", "41"},
        {"#30STRD01", "41"},
        {"#00MMRDD002G0DT0000000000001", "60"},
        {"#00MMRDD001G1DT0000000000001", "60"},
        {"#00MMRDD001G0ZZ0000000000001", "60"},
        {"#00MMRDD001G0DT000000000000", "41"},
        {"#00MMRDD001G0DT00000000000010", "41"},
        {"#00MMRDD001G0DT000000000000A", "61"},
        {"#00MMRDD001G0DT00000000A0001", "61"},
        {"#00MMRDD001G0DT0000000000000", "61"},
        {"#00MMRDD001G0DT0010000000001", "61"},
        {"#00MMWTD001G0DT0000000000001", "41"},
        {"#00MMWTD001G0DT000000000000100", "41"},
        {"#00MMWTD001G0DT000000000000100GG", "61"},
    };
    for (const auto& row : refusals) {
        CAPTURE(row.text);
        mewtocol_bench b;
        CHECK(b.say(checked(">@00107" + row.text)) == checked(std::string(">@00107!") + row.code));
        CHECK(b.say(checked(">@99907" + row.text)).empty());
        CHECK(b.device.writes == 0);
    }
    mewtocol_bench b;
    CHECK(b.say(">@00107#" + zeros) == checked(">@00107!27"));
    CHECK(b.say(checked(">@00107#00MMWTD001G0DT") + "&") == checked(">@00107!43"));
    CHECK(b.say(checked(">@00107!61")).empty());
    CHECK(b.say(checked(">@00007#30STRD00")).empty());
}

TEST_CASE("mewtocol7: what is not published is the dialect's, on both sides")
{
    dialect other;
    other.item = "W01";
    other.scope = "";
    other.address_digits = 6;
    other.count_digits = 4;
    other.base = number_base::hexadecimal;
    other.words = byte_order::high_byte_first;
    other.before_words = "01";
    other.before_error = "00";
    other.before_piece = "+";
    other.devices = {{word_area::fl, "FIL"}};

    const command asked = read_words{word_area::fl, 0x1234, 16};
    CHECK(encode_command(asked, other) == "00MMRDW01FIL0012340010");
    CHECK(*parse_command("00MMRDW01FIL0012340010", other) == asked);
    const command write = write_words{word_area::fl, 0, {0x1234}};
    CHECK(encode_command(write, other) == "00MMWTW01FIL00000000011234");
    CHECK(*parse_command("00MMWTW01FIL00000000011234", other) == write);
    CHECK_FALSE(is_expressible(read_words{word_area::dt, 0, 1}, other));

    const command two = read_words{word_area::fl, 0, 2};
    const response words = words_read{{0x1234, 0xABCD}};
    CHECK(encode_response(two, words, other) == "$00MMRD011234ABCD");
    CHECK(parse_response(two, "$00MMRD011234ABCD", other).value() == words);
    CHECK(encode_response(two, error_code::data, other) == "!0061");
    CHECK(parse_response(two, "!0061", other).value() == response{error_code::data});
    CHECK(parse_response(two, "!61", other).error() == errc::unexpected_answer);

    // A long response, frame by frame.
    server station({.own = station_id{1}, .dialect = other});
    conversation talk(station_id{1}, read_words{word_area::fl, 0, 3000}, 0xFE, other);
    buffer question = talk.begin();
    const std::vector<std::uint16_t> values(3000, 0x1234);
    for (int frames = 1;; ++frames) {
        const auto action = station.hear(t0, heard(text_of(question)));
        const buffer reply = std::holds_alternative<command>(action) ? station.answer(t0, words_read{values}).value()
                                                                     : std::get<buffer>(action);
        CHECK(reply.size() <= max_frame_size);
        auto said = talk.hear(heard(text_of(reply)));
        if (auto* more = std::get_if<mewtocol::ask_on>(&said)) {
            question = std::move(more->request);
            continue;
        }
        CHECK(frames == 3);
        CHECK(std::get<response>(said) == response{words_read{values}});
        break;
    }
}

TEST_SUITE_END();
