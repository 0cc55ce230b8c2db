// Members of a pair write the same registers: subscribers hear the stronger one.
#include "tests/dds/dds_fixture.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <thread>

using namespace plcgw;
using namespace plcgw::test;

namespace {

constexpr duration lease = 500ms;

struct writer {
    explicit writer(const char* member, std::int32_t strength, std::optional<duration> shared_lease = lease)
        : out(made(member, shared_lease))
    {
        out.set_strength(strength);
        gateway_status status;  // by which subscribers know that there is a pair
        status.role = shared_lease ? gateway_role::active : gateway_role::solo;
        out.publish(status);
    }

    static dds_publisher made(const char* member, std::optional<duration> shared_lease)
    {
        dds_identity who = identity("plant");
        who.member = member;
        auto created = dds_publisher::create(own_domain(), who, shared_lease);
        REQUIRE_MESSAGE(created.has_value(), created.error().text);
        return std::move(*created);
    }

    dds_publisher out;
};

struct reader {
    dds_subscriber in = made();
    std::vector<std::string> members{};  // of whom a block came, in this order

    static dds_subscriber made()
    {
        auto created = dds_subscriber::create(own_domain());
        REQUIRE_MESSAGE(created.has_value(), created.error().text);
        return std::move(*created);
    }

    void take()
    {
        for (const dds_event& each : in.take())
            if (const auto* block = std::get_if<received_block>(&each))
                members.push_back(block->member);
    }

    // Writes with all of them until a block of this member comes.
    bool hears(const std::string& member, std::vector<writer*> all)
    {
        const auto end = steady::now() + deadline;
        for (std::uint16_t value = 0; steady::now() < end; ++value) {
            members.clear();
            for (writer* each : all)
                each->out.publish(block(1, value));
            std::this_thread::sleep_for(10ms);
            take();
            if (std::find(members.begin(), members.end(), member) != members.end())
                return true;
        }
        return false;
    }
};

}  // namespace

TEST_CASE("ownership: a subscriber hears gateways alone and members of pairs")
{
    writer alone("alone", 0, std::nullopt);
    writer member("a", 1);
    reader in;
    CHECK(in.hears("alone", {&alone, &member}));
    CHECK(in.hears("a", {&alone, &member}));
}

TEST_CASE("ownership: the stronger member is heard, until it is the weaker one")
{
    writer a("a", 5);
    writer b("b", 4);
    reader in;
    REQUIRE(in.hears("a", {&a, &b}));
    REQUIRE(in.hears("a", {&a, &b}));
    for (int i = 0; i < 20; ++i) {
        in.members.clear();
        a.out.publish(block(1, 1));
        b.out.publish(block(1, 2));
        std::this_thread::sleep_for(5ms);
        in.take();
        CHECK(std::count(in.members.begin(), in.members.end(), "b") == 0);
    }
    b.out.set_strength(6);
    CHECK(in.hears("b", {&a, &b}));
    b.out.set_strength(3);
    CHECK(in.hears("a", {&a, &b}));
}

TEST_CASE("ownership: one that does not assert its liveliness any more is replaced")
{
    writer a("a", 5);
    writer b("b", 4);
    reader in;
    REQUIRE(in.hears("a", {&a, &b}));
    CHECK(in.hears("b", {&b}));
    a.out.assert_liveliness();
    CHECK(in.hears("a", {&a, &b}));
}
