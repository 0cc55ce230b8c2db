// Frames that published clients of others send, read in their sources and not run, and the answers that they take:
//
//     node-mewtocol    github.com/oleg31337/node-mewtocol, which is jsmewtocol of npm; never a BCC, `<` from 22 words
//     on mewtocol-serial  github.com/hy1stax/mewtocol-serial tienho
//     github.com/Tpro4391/node-red-tienho-mewtocol-panasonic, its tests and its mock PLC mewtocol-go
//     github.com/hiroeorz/mewtocol-go mfalfafa         github.com/mfalfafa/MEWTOCOL-COM-using-Python, which talks to an
//     FP-Sigma MewtocolNet      github.com/OpenLogics/MewtocolNet, which talks to FP-X, FP-XH and others
//
// All of them want two upper-case digits of BCC and a CR, the header and station that they sent, two decimal digits of
// an error, and low bytes first. The check codes were computed by a script of its own.
#include "protocols/mewtocol/conversation.hpp"
#include "tests/unit/mewtocol_fake.hpp"

#include <numeric>

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol;
using namespace plcgw::test;

namespace {

struct peer_row {
    const char* peer;
    const char* request;
    const char* response;  // empty: nobody answers
};

// DTn = n up to DT100 and DT32764 = 7; X0, Y1F, R0 and T1 on; SV0 = 100, SV1 = 30, EV0 = 99.
// clang-format off
const peer_row rows[] = {
    {"node-mewtocol", "%01#RDD0000000020**", "%01$RD00000100020003000400050006000700080009000A000B000C000D000E000F001000110012001300140015"},
    {"node-mewtocol", "<01#RDD0000000021**", "<01$RD00000100020003000400050006000700080009000A000B000C000D000E000F0010001100120013001400150008"},
    {"node-mewtocol", "%01#RDL0000500005**", "%01$RD000016"},
    {"node-mewtocol", "%01#RR0000002**", "%01$RR0800C800C80008"},
    {"node-mewtocol", "%01#RS00000001**", "%01$RS64001E0077"},
    {"node-mewtocol", "%01#RK00000001**", "%01$RK630000001C"},
    {"node-mewtocol", "%01#RCSX0000**", "%01$RC120"},
    {"node-mewtocol", "%01#RCP3X0000Y001FR0001**", "%01$RC11021"},
    {"node-mewtocol", "%01#RCCX00000001**", "%01$RC0100000010"},
    {"node-mewtocol", "%01#RT**", "%01$RT2025168000E12D000E"},
    {"node-mewtocol", "%01#RDD0000500001**", "%01!6102"},
    {"mewtocol-serial", "%EE#RT**", "%EE$RT2025168000E12D000F"},
    {"mewtocol-serial", "%EE#RCSX0001**", "%EE$RC020"},
    {"mewtocol-serial", "%EE#RCST0001**", "%EE$RC121"},
    {"mewtocol-serial", "%EE#WCSY00011**", "%EE$WC15"},
    {"mewtocol-serial", "%EE#RDD0000100010**", "%EE$RD0100020003000400050006000700080009000A0067"},
    {"mewtocol-serial", "%EE#RCPX0001X0010**", "%EE!6103"},
    {"mewtocol-serial", "%EE#RDD00010010**", "%EE!4101"},
    {"tienho", "%01#RCSX00001D", "%01$RC120"},
    {"tienho", "%01#RCSX0000**", "%01$RC120"},
    {"tienho", "%01#RDD00000000095C", "%01$RD000001000200030004000500060007000800090017"},
    {"tienho", "%01#WDD00001000020100020050", "%01$WD13"},
    {"tienho", "%EE#RDD000000000054", "%EE$RD000017"},
    {"tienho", "%01#RCCX000000030E", "%01$RC010000000000000010"},
    {"tienho", "%01#RCSR100A67", "%01$RC021"},
    {"tienho", "%01#WCSY0001129", "%01$WC14"},
    {"tienho", "%01#RCP2X0000Y001A05", "%01$RC1010"},
    {"tienho", "%01#WCP2Y00001Y001F106", "%01$WC14"},
    {"tienho", "%01#WCCR00100011AAAA555503", "%01$WC14"},
    {"tienho", "%01#RS0000000503", "%01$RS64001E00000000000000000077"},
    {"tienho", "%01#RK000300031E", "%01$RK000019"},
    {"tienho", "%01#RR000001036", "%01$RR0800C800C8000000000000000000000000000000000008"},
    {"tienho", "%01#WS00020002640001", "%01$WS04"},
    {"tienho", "%01#WK0000000001001A", "%01$WK1C"},
    {"tienho", "%01#RT01", "%01$RT2025168000E12D000E"},
    {"tienho", "%01#ZZ07", "%01!4203"},
    {"mewtocol-go", "%01#RCSX00001D", "%01$RC120"},
    {"mewtocol-go", "%32#RCSX00001D", ""},
    {"mewtocol-go", "%01#RCCX000000000D", "%01$RC010010"},
    {"mewtocol-go", "%01#RCCT0000000001", "%01!6003"},
    {"mewtocol-go", "%01#WCSR0001122", "%01$WC14"},
    {"mewtocol-go", "%01#RDD000000000257", "%01$RD00000100020015"},
    {"mewtocol-go", "%01#WDD00010000113412CDAB51", "%01$WD13"},
    {"mfalfafa", "%01#RDD3274032740**", "%01$RD000016"},
    {"mfalfafa", "%01#RDD3276332764**", "%01$RD0000070011"},
    {"mfalfafa", "%01#RDD3272032739**", "%01$RD0000000000000000000000000000000000000000000000000000000000000000000000000000000016"},
    {"mfalfafa", "%01#RCSR0000**", "%01$RC120"},
    {"mfalfafa", "%01#RCSR0055**", "%01$RC021"},
    {"MewtocolNet", "%EE#RT00", "%EE$RT2025168000E12D000F"},
    {"MewtocolNet", "%EE#EX00RT001D", "%EE!4202"},
    {"MewtocolNet", "%01#RMP48", "%01$RM1F"},
    {"MewtocolNet", "%01#RDD000500005055", "%01$RD320017"},
    {"MewtocolNet", "%01#RDD000500005154", "%01$RD3200330017"},
    {"MewtocolNet", "<EE#RDD00000000074A", "<EE$RD000001000200030004000500060007000E"},
    {"MewtocolNet", "<01#RCCR0000000719", "<01$RC0100000000000000000000000000000009"},
    {"MewtocolNet", "%01#WDD0007000070341254", "%01$WD13"},
    {"MewtocolNet", "%EE#RP000000004909", "%EE!4202"},
    {"MewtocolNet", "%EE#0F70", "%EE!4202"},
};

// The mock PLC of tienho cuts a long answer behind 118 characters, inside of words from the second frame on.
const std::string cut_answer[] = {
    "%01$RD0100020003000400050006000700080009000A000B000C000D000E000F0010001100120013001400150016001700180019001A001B0012&",
    "%011C001D001E001F0020002100220023002400250026002700280029002A002B002C002D002E002F00300031003200330034003500360037016&",
    "%010380039003A003B003C003D003E003F0040004100420043004400450046004700480049004A004B004C004D004E004F005000510052005314&",
    "%01005400550056005700580059005A005B005C005D005E005F006000610062006300640020"};
// clang-format on

mewtocol_bench peer_bench()
{
    mewtocol_bench b;
    auto& dt = b.device.memory.at(word_area::dt);
    std::iota(dt.begin(), dt.begin() + 101, std::uint16_t{0});
    dt[32'764] = 7;
    b.device.set(contact{contact_area::external_input, 0}, true);
    b.device.set(contact{contact_area::external_output, 0x1F}, true);
    b.device.set(contact{contact_area::internal_relay, 0}, true);
    b.device.timers = {1};
    b.device.set(word_area::sv, 0, {100, 30});
    b.device.set(word_area::ev, 0, {99});
    b.device.set(word_area::system, 0, {8, 200, 200});
    b.device.rt = plc_status{0x20, 0x25, 16, 0x80, 0x00, 0xE1, 45};
    return b;
}

std::vector<std::uint16_t> from_one(std::size_t count)
{
    std::vector<std::uint16_t> words(count);
    std::iota(words.begin(), words.end(), std::uint16_t{1});
    return words;
}

}  // namespace

TEST_CASE("mewtocol peers: a station answers their requests as they expect")
{
    for (const peer_row& row : rows) {
        CAPTURE(std::string(row.peer));
        CAPTURE(std::string(row.request));
        CHECK(peer_bench().say(row.request) == row.response);
    }
}

TEST_CASE("mewtocol peers: what they send is what we would send, but for the BCC that some leave out")
{
    for (const peer_row& row : rows) {
        CAPTURE(std::string(row.request));
        const frame asked = parse_frame(row.request).value();
        const auto meant = parse_command(std::string_view(asked.text).substr(1), all_commands);
        if (!meant)
            continue;
        frame ours = asked;
        ours.checked = check::good;
        ours.text = "#" + encode_command(*meant);
        CHECK(ours.text == asked.text);
        conversation talk(asked.head, asked.station, *meant);
        CHECK(talk.begin() == encode_frame(ours));
        const std::string_view response = row.response;
        if (response.empty())
            continue;
        const auto said = talk.hear({std::string(response), {}, response.size() + 1});
        REQUIRE(std::holds_alternative<mewtocol::response>(said));
        CHECK(encode_response(*meant, std::get<mewtocol::response>(said)) == parse_frame(response)->text);
    }
}

TEST_CASE("mewtocol peers: who asks for the next frame without a BCC gets it (node-mewtocol, tienho)")
{
    mewtocol_bench b = peer_bench();
    CHECK(b.say("%01#RDD0000000099**").back() == '&');
    CHECK(b.say("%01**&").starts_with("%011B001C00"));
}

TEST_CASE("mewtocol peers: a client collects an answer that is cut as the mock PLC of tienho cuts it")
{
    conversation talk(header::normal, station_id{1}, read_words{word_area::dt, 1, 100});
    talk.begin();
    for (std::size_t i = 0; i < std::size(cut_answer); ++i) {
        CAPTURE(i);
        const auto said = talk.hear({cut_answer[i], {}, cut_answer[i].size() + 1});
        if (i + 1 < std::size(cut_answer)) {
            REQUIRE(std::holds_alternative<ask_on>(said));
            CHECK(std::get<ask_on>(said).request == with_cr("%0124&"));
        }
        else {
            REQUIRE(std::holds_alternative<response>(said));
            CHECK(std::get<response>(said) == response{words_read{from_one(100)}});
        }
    }
}

TEST_CASE("mewtocol peers: a station may answer without a check code, and its status may be another PLC's")
{
    conversation talk(header::normal, station_id{1}, read_status{});
    talk.begin();
    const std::string answer = "%01$RT0525328100203412**";  // tienho's tests decode these 16 characters
    const auto said = talk.hear({answer, {}, answer.size() + 1});
    REQUIRE(std::holds_alternative<response>(said));
    CHECK(std::get<response>(said) == response{status_read{{0x05, 0x25, 32, 0x81, 0x00, 0x20, 0x1234}}});
}

TEST_SUITE_END();
