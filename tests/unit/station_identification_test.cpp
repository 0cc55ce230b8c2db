// Function 2B/0E over TCP, V1.1b3 section 6.21.
#include "bridge/services/device_identification.hpp"
#include "bridge/services/modbus_service.hpp"
#include "tests/unit/station_bench.hpp"

TEST_SUITE_BEGIN("services");

using namespace plcgw;

namespace {

buffer text(buffer head, std::initializer_list<std::pair<std::uint8_t, std::string>> objects)
{
    for (const auto& [id, value] : objects) {
        head.push_back(id);
        head.push_back(static_cast<std::uint8_t>(value.size()));
        head.insert(head.end(), value.begin(), value.end());
    }
    return head;
}

buffer ask(const buffer& pdu, const std::string& name = "press", const plc::model& m = plc::fx3u)
{
    plc::simulated_plc plc(name, m, {});
    return serve_pdu(plc, pdu, "1.2.3");
}

}  // namespace

TEST_CASE("device identification: basic, regular, extended and single objects")
{
    const std::pair<std::uint8_t, std::string> vendor{0, "plc-gateway"}, product{1, "FX3U"}, revision{2, "1.2.3"},
        model{5, "FX3U"}, user{6, "press"};
    CHECK(ask({0x2B, 0x0E, 0x01, 0x00}) ==
          text({0x2B, 0x0E, 0x01, 0x82, 0x00, 0x00, 0x03}, {vendor, product, revision}));
    CHECK(ask({0x2B, 0x0E, 0x01, 0x02}) == text({0x2B, 0x0E, 0x01, 0x82, 0x00, 0x00, 0x01}, {revision}));
    CHECK(ask({0x2B, 0x0E, 0x02, 0x00}) ==
          text({0x2B, 0x0E, 0x02, 0x82, 0x00, 0x00, 0x05}, {vendor, product, revision, model, user}));
    CHECK(ask({0x2B, 0x0E, 0x02, 0x05}) == text({0x2B, 0x0E, 0x02, 0x82, 0x00, 0x00, 0x02}, {model, user}));
    // More than there is: what there is. An object that the stream does not have: from the start.
    CHECK(ask({0x2B, 0x0E, 0x03, 0x00}) ==
          text({0x2B, 0x0E, 0x03, 0x82, 0x00, 0x00, 0x05}, {vendor, product, revision, model, user}));
    CHECK(ask({0x2B, 0x0E, 0x01, 0x05}) ==
          text({0x2B, 0x0E, 0x01, 0x82, 0x00, 0x00, 0x03}, {vendor, product, revision}));
    CHECK(ask({0x2B, 0x0E, 0x02, 0x80}) ==
          text({0x2B, 0x0E, 0x02, 0x82, 0x00, 0x00, 0x05}, {vendor, product, revision, model, user}));

    CHECK(ask({0x2B, 0x0E, 0x04, 0x00}) == text({0x2B, 0x0E, 0x04, 0x82, 0x00, 0x00, 0x01}, {vendor}));
    CHECK(ask({0x2B, 0x0E, 0x04, 0x06}) == text({0x2B, 0x0E, 0x04, 0x82, 0x00, 0x00, 0x01}, {user}));
    CHECK(ask({0x2B, 0x0E, 0x04, 0x03}) == buffer{0xAB, 0x02});
    CHECK(ask({0x2B, 0x0E, 0x04, 0x80}) == buffer{0xAB, 0x02});
}

TEST_CASE("device identification: refusals, and every model but FP7 has it")
{
    CHECK(ask({0x2B, 0x0E, 0x00, 0x00}) == buffer{0xAB, 0x03});
    CHECK(ask({0x2B, 0x0E, 0x05, 0x00}) == buffer{0xAB, 0x03});
    CHECK(ask({0x2B, 0x0E, 0x01}) == buffer{0xAB, 0x03});
    CHECK(ask({0x2B, 0x0D, 0x01, 0x00}) == buffer{0xAB, 0x01});
    CHECK(ask({0x2B}) == buffer{0xAB, 0x01});
    for (const plc::model* m : plc::all_models())
        if (m->name == "FP7")  // its manual's table of functions is complete
            CHECK(ask({0x2B, 0x0E, 0x04, 0x01}, "x", *m) == buffer{0xAB, 0x01});
        else
            CHECK(ask({0x2B, 0x0E, 0x04, 0x01}, "x", *m) ==
                  text({0x2B, 0x0E, 0x04, 0x82, 0x00, 0x00, 0x01}, {{1, std::string(m->name)}}));
    plc::simulated_plc plc("press", plc::fx3u, {});
    CHECK(serve_pdu(plc, buffer{0x2B, 0x0E, 0x01, 0x00}) == buffer{0xAB, 0x01});  // nobody said the revision
    CHECK(serve_pdu(plc, buffer{0x08, 0x00, 0x00, 0x12, 0x34}, "1.2.3") == buffer{0x88, 0x01});  // not over TCP
    CHECK(serve_pdu(plc, buffer{0x06, 0x00, 0x00, 0x12, 0x34}, "1.2.3") == buffer{0x06, 0x00, 0x00, 0x12, 0x34});
}

TEST_CASE("device identification: a long name follows in a second response, a longer one is cut")
{
    const std::string name(220, 'n');
    CHECK(ask({0x2B, 0x0E, 0x02, 0x00}, name) == text({0x2B, 0x0E, 0x02, 0x82, 0xFF, 0x06, 0x04},
                                                      {{0, "plc-gateway"}, {1, "FX3U"}, {2, "1.2.3"}, {5, "FX3U"}}));
    CHECK(ask({0x2B, 0x0E, 0x02, 0x06}, name) == text({0x2B, 0x0E, 0x02, 0x82, 0x00, 0x00, 0x01}, {{6, name}}));
    CHECK(ask({0x2B, 0x0E, 0x04, 0x06}, std::string(300, 'n')).size() == modbus::max_pdu_size);
}

TEST_SUITE_END();
