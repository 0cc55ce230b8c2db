// Commands on a device: what is written, monitored and refused. The frames are the vectors' business.
#include "tests/unit/mewtocol_fake.hpp"

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol;
using namespace plcgw::test;

namespace {

struct service_bench {
    fake_device device;
    mewtocol_registrations registered{};

    response ask(const command& c) { return serve(c, device, registered); }
};

contact relay(std::uint16_t number) { return {contact_area::internal_relay, number}; }

const response bad_area = error_code::parameter;
const response bad_data = error_code::data;
const response bad_registration = error_code::registration;

}  // namespace

TEST_CASE("mewtocol service: the last word of an area is served, the one behind it is not")
{
    service_bench b;
    CHECK(b.ask(read_words{word_area::dt, 32'764, 1}) == response{words_read{{0}}});
    CHECK(b.ask(read_words{word_area::dt, 32'765, 1}) == bad_data);
    CHECK(b.ask(read_words{word_area::dt, 32'764, 2}) == bad_data);
    CHECK(b.ask(read_words{word_area::dt, 0, 100'000}) == bad_data);
    CHECK(b.ask(write_words{word_area::ld, 8447, {1, 2}}) == bad_data);
    CHECK(b.ask(fill_words{word_area::wr, 899, 2, 0xFFFF}) == bad_data);
    CHECK(b.device.writes == 0);  // not even the part that exists
    CHECK(b.ask(fill_words{word_area::wr, 898, 2, 0xFFFF}) == response{executed{}});
    CHECK(b.device.memory.at(word_area::wr)[899] == 0xFFFF);
}

TEST_CASE("mewtocol service: an area that the device does not have")
{
    service_bench b;
    b.device.memory.erase(word_area::fl);
    CHECK(b.ask(read_words{word_area::fl, 0, 1}) == bad_area);
    CHECK(b.ask(write_words{word_area::fl, 0, {1}}) == bad_area);
    CHECK(b.ask(register_data{{{word_area::fl, 0}}}) == bad_area);
}

TEST_CASE("mewtocol service: contacts are written all or not at all")
{
    service_bench b;
    const contact beyond = relay(16 * 900);
    CHECK(b.ask(write_contacts{{{relay(1), true}, {beyond, true}}}) == bad_data);
    CHECK(b.ask(write_contact{{beyond, true}}) == bad_data);
    CHECK(b.ask(read_contacts{{relay(1), beyond}}) == bad_data);
    CHECK(b.ask(read_contact{relay(1)}) == response{contacts_read{{false}}});
}

TEST_CASE("mewtocol service: 80 contacts and 16 words can be registered, no more, and only once")
{
    service_bench b;
    CHECK(b.ask(register_contacts{std::vector(81, relay(0))}) == bad_registration);
    CHECK(b.ask(register_contacts{std::vector(80, relay(0))}) == response{executed{}});
    CHECK(b.ask(register_contacts{{relay(0)}}) == bad_registration);
    CHECK(b.ask(register_data{std::vector(17, data_item{word_area::dt, 0})}) == bad_registration);
    CHECK(b.ask(register_data{std::vector(16, data_item{word_area::dt, 0})}) == response{executed{}});
    CHECK(b.ask(register_data{{{word_area::dt, 0}}}) == bad_registration);

    CHECK(b.ask(forget_contacts{}) == response{executed{}});
    CHECK(b.ask(register_data{{{word_area::dt, 0}}}) == bad_registration);  // its own
    CHECK(b.ask(register_contacts{{relay(0)}}) == response{executed{}});
    CHECK(b.ask(forget_data{}) == response{executed{}});
    CHECK(b.ask(register_data{{{word_area::dt, 0}}}) == response{executed{}});
}

TEST_CASE("mewtocol service: what the device does not have is not registered")
{
    service_bench b;
    CHECK(b.ask(register_contacts{{relay(0), relay(16 * 900)}}) == bad_data);
    CHECK(b.ask(register_data{{{word_area::dt, 0}, {word_area::dt, 40'000}}}) == bad_data);
    CHECK(b.ask(monitor{}) == bad_registration);
}

TEST_CASE("mewtocol service: eight contacts are a byte, the ninth begins the next")
{
    service_bench b;
    std::vector<contact> nine;
    for (std::uint16_t i = 0; i < 9; ++i)
        nine.push_back(relay(i));
    b.device.set(word_area::wr, 0, {0x0181});
    b.ask(register_contacts{nine});
    CHECK(b.ask(monitor{}) == response{monitored{0, {0x81, 0x01}, {}}});
}

TEST_CASE("mewtocol service: every kind of data can be monitored")
{
    service_bench b;
    b.device.set(word_area::sv, 7, {100});
    b.device.set(word_area::ev, 7, {99});
    b.device.set(word_area::wx, 2, {0xABCD});
    b.ask(register_data{{{word_area::sv, 7}, {word_area::ev, 7}, {word_area::wx, 2}}});
    CHECK(b.ask(monitor{}) == response{monitored{0, {}, {100, 99, 0xABCD}}});
}

TEST_CASE("mewtocol service: MG counts the scans since the last one, at most ten")
{
    service_bench b;
    b.device.scan = 1000;
    b.ask(register_data{{{word_area::dt, 0}}});
    const auto scans = [&] { return std::get<monitored>(b.ask(monitor{})).scans; };
    CHECK(scans() == 0);
    b.device.scan += 9;
    b.ask(register_contacts{{relay(0)}});  // does not begin again
    CHECK(scans() == 9);
    b.device.scan += 10;
    CHECK(scans() == 10);
    b.device.scan += 10'000;
    CHECK(scans() == 10);
    CHECK(scans() == 0);
}

TEST_CASE("mewtocol service: what a device does not say is not supported")
{
    service_bench b;
    CHECK(b.ask(read_extended_status{}) == response{error_code::not_supported});
    CHECK(serve(mewtocol7::command{read_status{}}, b.device) == mewtocol7::response{error_code::not_supported});
    CHECK(b.ask(change_mode{operating_mode::prog}) == response{executed{}});
    CHECK(b.device.prog);
}

TEST_SUITE_END();
