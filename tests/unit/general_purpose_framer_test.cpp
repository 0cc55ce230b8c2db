#include "protocols/general_purpose/encode.hpp"
#include "tests/support/messages.hpp"

#include <random>

TEST_SUITE_BEGIN("messages");

using namespace plcgw;
using namespace plcgw::general_purpose;
using namespace plcgw::test;

namespace {

static_assert(framer<message_framer>);

constexpr message_form cr{start_code::none, end_code::cr, {}, {}};
constexpr message_form cr_lf{start_code::none, end_code::cr_lf, {}, {}};
constexpr message_form quiet{start_code::none, end_code::silence, 2ms, {}};
constexpr message_form stx_etx{start_code::stx, end_code::etx, {}, {}};
constexpr message_form stx_cr_lf{start_code::stx, end_code::cr_lf, {}, {}};
constexpr message_form stx_quiet{start_code::stx, end_code::silence, 2ms, {}};

const std::string restarted = "! a new frame or message began inside this one";
const std::string overlong = "! longer than any frame";

// All that comes out of pieces that come 1 ms apart, with a second of silence behind.
texts receive(const message_form& form, const pieces& received)
{
    texts all;
    message_framer in(form);
    time_point now = t0;
    for (const bytes piece : received) {
        in.feed(now, piece);
        drain(in, now, all);
        now += 1ms;
    }
    drain(in, now + 1s, all);
    return all;
}

texts receive(const message_form& form, std::string_view received)
{
    const buffer whole = raw(received);
    return receive(form, pieces{whole});
}

struct row {
    const char* name;
    message_form form;
    std::string_view received;
    texts messages;
};

using namespace std::string_view_literals;

// clang-format off
const row rows[] = {
    {"the manual's example, 9.4.2",            cr,        "12345\r",                 {"12345"}},
    {"two in a row",                           cr,        "12\r34\r",                {"12", "34"}},
    {"one that has not ended",                 cr,        "12\r34",                  {"12"}},
    {"an empty message is one",                cr,        "\r12\r\r",                {"", "12", ""}},
    {"LF is data where CR ends",               cr,        "12\r\n34\r",              {"12", "\n34"}},
    {"STX and ETX are data without them",      cr,        "\00212\003\r",         {"\00212\003"}},
    {"zeros and ones are data",                cr,        "\0\xFF\r"sv,              {std::string("\0\xFF", 2)}},
    {"CR+LF",                                  cr_lf,     "12\r\n34\r\n",            {"12", "34"}},
    {"CR alone is data",                       cr_lf,     "1\r2\r\n",                {"1\r2"}},
    {"LF alone is data",                       cr_lf,     "1\n2\r\n",                {"1\n2"}},
    {"the last of many CR ends",               cr_lf,     "1\r\r\r\n",               {"1\r\r"}},
    {"LF and CR are not CR and LF",            cr_lf,     "1\n\r2\r\n",              {"1\n\r2"}},
    {"CR+LF alone are an empty message",       cr_lf,     "\r\n1\r\n",               {"", "1"}},
    {"STX and ETX are taken off",              stx_etx,   "\00212\003",           {"12"}},
    {"CR is data where ETX ends",              stx_etx,   "\0021\r\n2\003",       {"1\r\n2"}},
    {"a message without STX is one (9.5.2)",   stx_etx,   "12\003\00234\003",     {"12", "34"}},
    {"STX begins anew (9.5.2)",                stx_etx,   "\00212\00234\003",  {restarted, "34"}},
    {"every STX does",                         stx_etx,   "\0021\0022\0023\003", {restarted, restarted, "3"}},
    {"nothing is lost between two STX",        stx_etx,   "\002\00234\003",       {"34"}},
    {"nothing between STX and ETX",            stx_etx,   "\002\003",                {""}},
    {"CR+LF behind ETX is not of the next",    stx_etx,   "\0021\003\r\n\0022\003", {"1", restarted, "2"}},
    {"STX between CR and LF",                  stx_cr_lf, "\0021\r\002\n2\r\n",   {restarted, "\n2"}},
    {"silence ends",                           quiet,     "1\r\n2\003",              {"1\r\n2\003"}},
    {"silence ends, STX taken off",            stx_quiet, "\00212",               {"12"}},
    {"STX begins anew where silence ends",     stx_quiet, "\00212\00234",      {restarted, "34"}},
    {"nothing came",                           quiet,     "",                        {}},
};
// clang-format on

}  // namespace

TEST_CASE("general purpose: messages come out the same at every cut")
{
    for (const row& each : rows) {
        CAPTURE(each.name);
        every_cut(raw(each.received), [&](const pieces& cut) { CHECK(receive(each.form, cut) == each.messages); });
    }
}

TEST_CASE("general purpose: doubled, a message comes twice")
{
    CHECK(receive(cr, "12\r12\r") == texts{"12", "12"});
    CHECK(receive(cr_lf, "12\r\n12\r\n") == texts{"12", "12"});
    CHECK(receive(stx_etx, "\00212\003\00212\003") == texts{"12", "12"});
    CHECK(receive(quiet, "1212") == texts{"1212"});  // no silence between them
}

TEST_CASE("general purpose: what is encoded comes back, whatever its bytes but the codes")
{
    buffer content;
    for (unsigned byte = 0; byte < 256; ++byte)
        if (byte != ascii::stx && byte != ascii::etx && byte != ascii::carriage_return)
            content.push_back(static_cast<std::uint8_t>(byte));
    for (const message_form& form : {cr, cr_lf, quiet, stx_etx, stx_cr_lf, stx_quiet}) {
        const auto sent = encode(content, form);
        REQUIRE(sent.has_value());
        CHECK(receive(form, pieces{*sent}) == texts{std::string(content.begin(), content.end())});
    }
}

TEST_CASE("general purpose: 4096 bytes with the codes are a message, 4097 are lost, and said once")
{
    const struct {
        message_form form;
        std::string before, after;
    } forms[] = {
        {cr, "", "\r"}, {cr_lf, "", "\r\n"}, {stx_etx, "\002", "\003"}, {quiet, "", ""}, {stx_quiet, "\002", ""}};
    for (const auto& each : forms) {
        const std::string longest(max_message_size - each.before.size() - each.after.size(), 'x');
        CHECK(receive(each.form, each.before + longest + each.after) == texts{longest});
        CHECK(receive(each.form, each.before + longest + 'x' + each.after) == texts{overlong});
        CHECK(receive(each.form, each.before + longest + longest + longest + each.after) == texts{overlong});
    }
    const std::string much(5000, 'x');
    CHECK(receive(cr, much + "\r12\r") == texts{overlong, "12"});
    CHECK(receive(cr_lf, much + "\r\n12\r\n") == texts{overlong, "12"});
    CHECK(receive(cr_lf, std::string(4095, 'x') + "\r\n12\r\n") == texts{overlong, "12"});  // cut between CR and LF
    CHECK(receive(stx_etx, "\002" + much + "\00212\003") == texts{overlong, "12"});         // STX is a new message
}

TEST_CASE("general purpose: silence ends a message when it was seen, not when it passed unseen")
{
    message_framer in(quiet);
    texts all;
    CHECK(in.deadline() == time_point::max());
    in.feed(t0, raw("12"));
    CHECK(in.deadline() == t0 + 2ms);
    drain(in, t0 + 1999us, all);
    CHECK(all.empty());
    in.feed(t0 + 1999us, raw("34"));
    CHECK(in.deadline() == t0 + 3999us);
    drain(in, t0 + 3999us, all);
    CHECK(all == texts{"1234"});
    CHECK(in.deadline() == time_point::max());

    in.feed(t0 + 1s, raw("56"));
    in.feed(t0 + 2s, raw("78"));  // this process stood still
    drain(in, t0 + 3s, all);
    CHECK(all == texts{"1234", "5678"});
}

TEST_CASE("general purpose: the silence that ends a message, 0.01 to 100 ms, and 0 for 32 bits (10.3.2, D+10)")
{
    character_format format;
    CHECK(end_silence(hundredths{1}, format) == 10us);
    CHECK(end_silence(hundredths{10'000}, format) == 100ms);
    format.baud_rate = 230'400;
    CHECK(end_silence(hundredths{0}, format) == 139us);
    format.baud_rate = 300;
    CHECK(end_silence(hundredths{0}, format) == 106'667us);
}

TEST_CASE("general purpose: without its end code a message waits for ever, or for as long as the line says")
{
    message_framer in(cr);
    texts all;
    in.feed(t0, raw("12"));
    CHECK(in.deadline() == time_point::max());
    drain(in, t0 + 1h, all);
    in.feed(t0 + 1h, raw("3\r"));
    drain(in, t0 + 1h, all);
    CHECK(all == texts{"123"});

    message_framer patient({start_code::none, end_code::cr, {}, 5s});
    all.clear();
    patient.feed(t0, raw("12"));
    CHECK(patient.deadline() == t0 + 5s);
    drain(patient, t0 + 4999ms, all);
    CHECK(all.empty());
    drain(patient, t0 + 5s, all);
    patient.feed(t0 + 6s, raw("3\r"));
    drain(patient, t0 + 6s, all);
    CHECK(all == texts{"! incomplete frame", "3"});
}

TEST_CASE("general purpose: a damaged character costs the message around it, and is said once")
{
    message_framer in(stx_etx);
    texts all;
    in.feed(t0, raw("\0021\003\0022"));
    in.fault(t0, errc::bad_parity);
    in.fault(t0, errc::bad_stop_bit);
    in.feed(t0, raw("3\003\0024\003"));
    drain(in, t0, all);
    CHECK(all == texts{"1", "! parity error", "4"});

    in.fault(t0, errc::overrun);  // between messages: the next one may have lost its beginning
    in.feed(t0, raw("5\003\0026\003"));
    drain(in, t0, all);
    CHECK(all == texts{"1", "! parity error", "4", "! characters lost, the port was read too late", "6"});

    message_framer silent(quiet);
    all.clear();
    silent.feed(t0, raw("1"));
    silent.fault(t0, errc::bad_stop_bit);
    drain(silent, t0 + 1ms, all);
    CHECK(all == texts{"! framing error"});
    drain(silent, t0 + 2ms, all);
    silent.feed(t0 + 2ms, raw("2"));
    drain(silent, t0 + 4ms, all);
    CHECK(all == texts{"! framing error", "2"});
}

TEST_CASE("general purpose: a reset forgets all that came before")
{
    message_framer in(cr);
    texts all;
    in.feed(t0, raw("1\r2"));
    in.reset();
    CHECK_FALSE(in.inside());
    in.feed(t0, raw("3\r"));
    drain(in, t0, all);
    CHECK(all == texts{"3"});
}

TEST_CASE("general purpose: 230400 baud back to back in random pieces, none is lost")
{
    std::mt19937 random(20'250);
    const auto up_to = [&](unsigned most) { return std::uniform_int_distribution<unsigned>(0, most)(random); };
    character_format format{230'400, 8, parity::none, 1};
    for (const message_form& form : {cr, cr_lf, stx_etx, stx_cr_lf}) {
        texts sent;
        buffer line;
        for (unsigned i = 0; i < 2000; ++i) {
            std::string content;
            for (unsigned n = up_to(i % 100 == 0 ? 4000 : 40); n > 0; --n)
                content.push_back(static_cast<char>(0x20 + up_to(0xDF)));
            const auto message = encode(raw(content), form);
            REQUIRE(message.has_value());
            line.insert(line.end(), message->begin(), message->end());
            sent.push_back(std::move(content));
        }
        texts received;
        message_framer in(form);
        for (std::size_t at = 0; at < line.size();) {
            const std::size_t size = std::min<std::size_t>(1 + up_to(up_to(9) == 0 ? 4095 : 63), line.size() - at);
            const time_point now = t0 + character_time(format, at + size);
            in.feed(now, bytes(line).subspan(at, size));
            at += size;
            if (up_to(3) != 0)  // not asked after each piece
                drain(in, now, received);
        }
        drain(in, t0 + 1h, received);
        CHECK(received.size() == sent.size());
        CHECK((received == sent));
    }
}

TEST_SUITE_END();
