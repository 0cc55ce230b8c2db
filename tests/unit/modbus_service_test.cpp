#include "bridge/plc/models/fx3u.hpp"
#include "bridge/services/modbus_service.hpp"
#include "tests/support/print.hpp"

TEST_SUITE_BEGIN("services");

using namespace plcgw;
using plc::parse_device;

namespace {

struct fx3u_server {
    plc::simulated_plc plc{"main", plc::fx3u, {}};

    fx3u_server() { plc.memory().take_changes(); }

    plc::place at(const char* device) const { return plc.memory().find(*parse_device(device)).value(); }
    std::uint16_t word(const char* device) const { return plc.memory().word(at(device)); }
    bool bit(const char* device) const { return plc.memory().bit(at(device)); }
    void set(const char* device, std::uint16_t value) { plc.memory().set_word(at(device), value); }
    buffer answer(const buffer& pdu) { return serve_pdu(plc, pdu); }
};

}  // namespace

TEST_CASE("modbus service: reads of the four tables")
{
    fx3u_server s;
    s.set("M16", 0b1000'0000'0000'0101);
    s.set("X20", 0xFFFF);
    s.set("D1000", 0x1234);
    s.set("D1001", 0xABCD);
    s.set("X0", 0x0102);
    //                     fc    first       count
    CHECK(s.answer({0x01, 0x00, 0x10, 0x00, 0x10}) == buffer{0x01, 0x02, 0x05, 0x80});
    CHECK(s.answer({0x01, 0x00, 0x12, 0x00, 0x03}) == buffer{0x01, 0x01, 0x01});  // M18-M20
    CHECK(s.answer({0x02, 0x34, 0x0F, 0x00, 0x03}) == buffer{0x02, 0x01, 0x06});  // X17-X21
    CHECK(s.answer({0x03, 0x03, 0xE8, 0x00, 0x02}) == buffer{0x03, 0x04, 0x12, 0x34, 0xAB, 0xCD});
    CHECK(s.answer({0x04, 0xA7, 0xB8, 0x00, 0x02}) == buffer{0x04, 0x04, 0x01, 0x02, 0xFF, 0xFF});
    CHECK_FALSE(s.plc.memory().take_changes().empty());  // our own sets; reading changes nothing:
    s.answer({0x03, 0x00, 0x00, 0x00, 0x7D});
    CHECK_FALSE(s.plc.memory().has_changes());
}

TEST_CASE("modbus service: writes of coils and registers")
{
    fx3u_server s;
    CHECK(s.answer({0x05, 0x33, 0x08, 0xFF, 0x00}) == buffer{0x05, 0x33, 0x08, 0xFF, 0x00});
    CHECK(s.bit("Y10"));
    CHECK(s.answer({0x05, 0x33, 0x08, 0x00, 0x00}) == buffer{0x05, 0x33, 0x08, 0x00, 0x00});
    CHECK_FALSE(s.bit("Y10"));

    CHECK(s.answer({0x06, 0x21, 0x40, 0x12, 0x34}) == buffer{0x06, 0x21, 0x40, 0x12, 0x34});
    CHECK(s.word("R0") == 0x1234);

    CHECK(s.answer({0x0F, 0x00, 0x13, 0x00, 0x0A, 0x02, 0xCD, 0x01}) == buffer{0x0F, 0x00, 0x13, 0x00, 0x0A});
    CHECK(s.word("M19") == 0x01CD);

    CHECK(s.answer({0x10, 0x00, 0x01, 0x00, 0x02, 0x04, 0x00, 0x0A, 0x01, 0x02}) ==
          buffer{0x10, 0x00, 0x01, 0x00, 0x02});
    CHECK(s.word("D1") == 0x000A);
    CHECK(s.word("D2") == 0x0102);

    s.answer({0x06, 0xA4, 0x78, 0x80, 0x01});  // a register of bit devices
    CHECK(s.bit("M0"));
    CHECK(s.bit("M15"));
    CHECK_FALSE(s.bit("M14"));
}

TEST_CASE("modbus service: runs over several rows of the map")
{
    fx3u_server s;
    CHECK(s.answer({0x10, 0x1F, 0x3F, 0x00, 0x02, 0x04, 0x00, 0x07, 0x00, 0x08})[0] == 0x10);
    CHECK(s.word("D7999") == 7);
    CHECK(s.word("D8000") == 8);
    CHECK(s.answer({0x03, 0x1F, 0x3F, 0x00, 0x02}) == buffer{0x03, 0x04, 0x00, 0x07, 0x00, 0x08});

    CHECK(s.answer({0x0F, 0x1D, 0xFF, 0x00, 0x02, 0x01, 0x03})[0] == 0x0F);
    CHECK(s.bit("M7679"));
    CHECK(s.bit("M8000"));
    CHECK(s.answer({0x01, 0x1D, 0xFF, 0x00, 0x03}) == buffer{0x01, 0x01, 0x03});
}

TEST_CASE("modbus service: a 32-bit counter is two registers, low word first, and may be cut in the middle")
{
    fx3u_server s;
    s.answer({0x10, 0xA4, 0x07, 0x00, 0x03, 0x06, 0x11, 0x11, 0x56, 0x78, 0x12, 0x34});
    CHECK(s.word("CN199") == 0x1111);
    CHECK(s.word("CN200") == 0x5678);
    CHECK(s.answer({0x03, 0xA4, 0x09, 0x00, 0x01}) == buffer{0x03, 0x02, 0x12, 0x34});
    CHECK(s.answer({0x03, 0xA4, 0x77, 0x00, 0x02})[0] == 0x03);  // CN255's high word and M0-M15
}

TEST_CASE("modbus service: mask write, (current AND and_mask) OR (or_mask AND NOT and_mask)")
{
    fx3u_server s;
    s.set("D4", 0x0012);
    CHECK(s.answer({0x16, 0x00, 0x04, 0x00, 0xF2, 0x00, 0x25}) == buffer{0x16, 0x00, 0x04, 0x00, 0xF2, 0x00, 0x25});
    CHECK(s.word("D4") == 0x0017);
    s.answer({0x16, 0x00, 0x04, 0x00, 0x00, 0xA5, 0x5A});  // and_mask 0: the or_mask itself
    CHECK(s.word("D4") == 0xA55A);
    s.answer({0x16, 0x00, 0x04, 0xFF, 0xFF, 0xFF, 0xFF});  // and_mask FFFF: as it was
    CHECK(s.word("D4") == 0xA55A);
}

TEST_CASE("modbus service: function 17H writes before it reads")
{
    fx3u_server s;
    s.set("D3", 0x0303);
    s.set("D4", 0x0404);
    CHECK(s.answer({0x17, 0x00, 0x03, 0x00, 0x03, 0x00, 0x04, 0x00, 0x01, 0x02, 0xBE, 0xEF}) ==
          buffer{0x17, 0x06, 0x03, 0x03, 0xBE, 0xEF, 0x00, 0x00});
    CHECK(s.word("D4") == 0xBEEF);
}

TEST_CASE("modbus service: an address that leads nowhere answers exception 02 and nothing is written")
{
    struct {
        const char* name;
        buffer pdu;
    } const rows[] = {
        {"coils: X is no coil", {0x01, 0x34, 0x00, 0x00, 0x01}},
        {"coils behind Y", {0x01, 0x33, 0xFF, 0x00, 0x02}},
        {"discrete inputs behind X", {0x02, 0x34, 0xFF, 0x00, 0x02}},
        {"holding registers behind Y", {0x03, 0xA7, 0xB7, 0x00, 0x02}},
        {"input registers behind X", {0x04, 0xA7, 0xC7, 0x00, 0x02}},
        {"beyond the last number", {0x03, 0xFF, 0xFF, 0x00, 0x02}},
        {"one coil", {0x05, 0x34, 0x00, 0xFF, 0x00}},
        {"one register", {0x06, 0xA7, 0xB8, 0x00, 0x01}},
        {"coils, all but the last possible", {0x0F, 0x33, 0xFE, 0x00, 0x03, 0x01, 0x07}},
        {"registers, all but the last possible", {0x10, 0xA7, 0xB7, 0x00, 0x02, 0x04, 0x00, 0x01, 0x00, 0x01}},
        {"mask", {0x16, 0xA7, 0xB8, 0x00, 0x00, 0xFF, 0xFF}},
        {"17H, read impossible", {0x17, 0xA7, 0xB7, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x02, 0x00, 0x01}},
        {"17H, write impossible", {0x17, 0x00, 0x00, 0x00, 0x01, 0xA7, 0xB7, 0x00, 0x02, 0x04, 0, 1, 0, 1}},
    };
    for (const auto& row : rows) {
        CAPTURE(row.name);
        fx3u_server s;
        CHECK(s.answer(row.pdu) == buffer{static_cast<std::uint8_t>(row.pdu[0] | 0x80), 0x02});
        CHECK_FALSE(s.plc.memory().has_changes());
    }
}

TEST_CASE("modbus service: function (01) before quantity and value (03) before address (02)")
{
    fx3u_server s;
    CHECK(s.answer({0x2B, 0x0E, 0x01, 0x00}) == buffer{0xAB, 0x01});
    CHECK(s.answer({0x08, 0x00, 0x00, 0x12, 0x34}) == buffer{0x88, 0x01});  // not over TCP
    CHECK(s.answer({0x07}) == buffer{0x87, 0x01});
    CHECK(s.answer({}) == buffer{0x80, 0x01});
    CHECK(s.answer({0x03, 0xFF, 0xFF, 0x00, 0x00}) == buffer{0x83, 0x03});
    CHECK(s.answer({0x03, 0xFF, 0xFF, 0x00, 0x7E}) == buffer{0x83, 0x03});
    CHECK(s.answer({0x05, 0xFF, 0xFF, 0x12, 0x34}) == buffer{0x85, 0x03});
    CHECK(s.answer({0x10, 0xFF, 0xFF, 0x00, 0x02, 0x02, 0x00, 0x01}) == buffer{0x90, 0x03});
    CHECK(s.answer({0x03, 0x00}) == buffer{0x83, 0x03});
    CHECK(s.answer({0x03, 0xFF, 0xFF, 0x00, 0x01}) == buffer{0x83, 0x02});
}

TEST_CASE("modbus service: the largest reads")
{
    fx3u_server s;
    CHECK(s.answer({0x01, 0x00, 0x00, 0x07, 0xD0}).size() == 252);
    CHECK(s.answer({0x04, 0x21, 0x40, 0x00, 0x7D}).size() == 252);
}

TEST_CASE("modbus service: the user-defined map is what coils and holding registers lead to")
{
    auto program =
        plc::parse_setup_program("LD M8411\nMOV H5002 D8470\nMOV K0 D8471\nMOV HC001 D8472\nMOV K1000 D8473\n");
    plc::simulated_plc plc("main", plc::fx3u, std::move(program));
    CHECK(serve_pdu(plc, buffer{0x06, 0x00, 0x00, 0x00, 0x2A})[0] == 0x06);
    CHECK(plc.memory().word(plc.memory().find(*parse_device("D1000")).value()) == 42);
    CHECK(serve_pdu(plc, buffer{0x05, 0x00, 0x1F, 0xFF, 0x00})[0] == 0x05);
    CHECK(plc.memory().bit(plc.memory().find(*parse_device("X37")).value()));
    CHECK(serve_pdu(plc, buffer{0x03, 0x00, 0x10, 0x00, 0x01}) == buffer{0x83, 0x02});
    CHECK(serve_pdu(plc, buffer{0x04, 0x03, 0xE8, 0x00, 0x01}) == buffer{0x04, 0x02, 0x00, 0x2A});
}

TEST_CASE("modbus service: the allocation is read at power-on, what is written to D8470 later changes no map (9.4)")
{
    auto program = plc::parse_setup_program("LD M8411\nMOV HC001 D8470\nMOV K1000 D8471\n");
    plc::simulated_plc plc("main", plc::fx3u, std::move(program));
    const auto at = [&](const char* device) { return plc.memory().find(*parse_device(device)).value(); };
    plc.memory().set_word(at("D8470"), 0xD001);  // R, by a program or a monitor
    plc.memory().set_word(at("D8471"), 0);
    plc.memory().set_word(at("R0"), 0x1111);
    plc.memory().set_word(at("D1000"), 0x2222);
    CHECK(serve_pdu(plc, buffer{0x03, 0x00, 0x00, 0x00, 0x01}) == buffer{0x03, 0x02, 0x22, 0x22});
    plc.stop();
    plc.run();
    CHECK(serve_pdu(plc, buffer{0x03, 0x00, 0x00, 0x00, 0x01}) == buffer{0x03, 0x02, 0x22, 0x22});
    plc.power_cycle();
    CHECK(plc.memory().word(at("D8470")) == 0xC001);  // what the program says
    plc.memory().set_word(at("D1000"), 0x3333);
    CHECK(serve_pdu(plc, buffer{0x03, 0x00, 0x00, 0x00, 0x01}) == buffer{0x03, 0x02, 0x33, 0x33});
}

TEST_CASE("modbus service: only FX3U and FX3UC have an allocation, in the others the default map stays (9.4)")
{
    for (const plc::model* m : plc::all_models()) {
        CAPTURE(std::string(m->name));
        auto program = plc::parse_setup_program("LD M8411\nMOV HC001 D8470\nMOV K1000 D8471\n");
        plc::simulated_plc plc("main", *m, std::move(program));
        plc.memory().set_word(plc.memory().find(*parse_device("D1000")).value(), 0x1234);
        const bool allocated = m->name.starts_with("FX3U");
        CHECK(serve_pdu(plc, buffer{0x03, 0x00, 0x00, 0x00, 0x01})[2] == (allocated ? 0x12 : 0));
        CHECK(serve_pdu(plc, buffer{0x03, 0x03, 0xE8, 0x00, 0x01}) ==
              (allocated ? buffer{0x83, 0x02} : buffer{0x03, 0x02, 0x12, 0x34}));
        CHECK_FALSE(plc.fault().has_value());
    }
}

TEST_SUITE_END();
