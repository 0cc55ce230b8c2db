// The orders of points against those of libmodbus: its getters read what we write.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include "bridge/points/point.hpp"

#include <doctest/doctest.h>
#include <modbus.h>

using namespace plcgw;

TEST_CASE("points: libmodbus reads a float in each order as it is meant")
{
    const struct {
        byte_order order;
        float (*get)(const std::uint16_t*);
    } rows[] = {
        {byte_order::abcd, modbus_get_float_abcd},
        {byte_order::cdab, modbus_get_float_cdab},
        {byte_order::badc, modbus_get_float_badc},
        {byte_order::dcba, modbus_get_float_dcba},
    };
    for (const auto& row : rows)
        for (const float value : {123.456F, -0.001F, 1e30F, 0.0F}) {
            CAPTURE(static_cast<int>(row.order));
            point_form f;
            f.type = value_type::float32;
            f.order = row.order;
            const auto words = encode(f, real_value(value));
            REQUIRE(words.has_value());
            CHECK(row.get(words->data()) == value);
            CHECK(decode(f, *words)->real == value);
        }
}
