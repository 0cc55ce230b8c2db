#include "tests/field/profile.hpp"

#include "tests/field/registers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace plcgw::field {

namespace {

// How far a first-order lag has come towards its target.
double lag(double seconds, double time_constant) { return 1 - std::exp(-seconds / time_constant); }

struct plain {
    explicit plain(modbus_mapping_t&) {}
    void operator()(modbus_mapping_t&, double) const {}
};

struct pump {
    explicit pump(modbus_mapping_t& r)
    {
        r.tab_bits[0] = 1;
        r.tab_registers[0] = 1450;
    }
    void operator()(modbus_mapping_t& r, double seconds)
    {
        const double target = r.tab_bits[0] != 0 ? r.tab_registers[0] : 0;
        speed += (target - speed) * lag(seconds, 2);
        const double load = speed / 1450;
        celsius += (25 + 40 * load * load - celsius) * lag(seconds, 60);

        r.tab_input_registers[0] = word(speed);
        r.tab_input_registers[1] = word(speed < 10 ? 0 : 20 + 60 * load * load);  // a motor needs current to idle
        r.tab_input_registers[2] = word(celsius * 10);
        r.tab_input_bits[0] = speed >= 10;
        r.tab_input_bits[1] = speed > 3000;
    }
    double speed = 0;
    double celsius = 25;
};

struct meter {
    explicit meter(modbus_mapping_t&) {}
    void operator()(modbus_mapping_t& r, double seconds)
    {
        time += seconds;
        const double volts = 230 + 2 * std::sin(time * 2 * std::numbers::pi / 17);
        const double amperes = 12 + 5 * std::sin(time * 2 * std::numbers::pi / 60);
        watt_hours += volts * amperes * seconds / 3600;

        set_float(&r.tab_input_registers[0], volts);
        set_float(&r.tab_input_registers[2], amperes);
        set_float(&r.tab_input_registers[4], volts * amperes);
        set_long(&r.tab_input_registers[6], static_cast<std::uint32_t>(watt_hours));
    }
    double time = 0;
    double watt_hours = 1'000'000;  // more than one word, so that a wrong word order shows
};

struct tank {
    explicit tank(modbus_mapping_t& r) { r.tab_registers[0] = 1500; }
    void operator()(modbus_mapping_t& r, double seconds)
    {
        // Short steps, or the level would run past the switching points when nobody reads it for a while.
        const int steps = 1 + static_cast<int>(std::min(seconds, 600.0) / 0.5);
        for (int i = 0; i < steps; ++i)
            step(r, seconds / steps);

        r.tab_input_registers[0] = word(level);
        static constexpr double switch_heights[] = {200, 1000, 2000, 2800};
        for (int i = 0; i < 4; ++i)
            r.tab_input_bits[i] = level >= switch_heights[i];
    }
    void step(modbus_mapping_t& r, double seconds)
    {
        // Between the switching points the valve stays as it is: a client may turn it too.
        const double setpoint = r.tab_registers[0];
        if (level < setpoint - 200)
            r.tab_bits[0] = 1;
        else if (level > setpoint + 200)
            r.tab_bits[0] = 0;
        level = std::clamp(level + (r.tab_bits[0] != 0 ? 20 : -20) * seconds, 0.0, 3000.0);
    }
    double level = 1500;
};

template <typename Profile>
profile start(modbus_mapping_t& registers)
{
    return Profile(registers);
}

struct profile_row {
    const char* name;
    profile (*start)(modbus_mapping_t&);
};
constexpr profile_row profile_table[] = {
    {"plain", start<plain>}, {"pump", start<pump>}, {"meter", start<meter>}, {"tank", start<tank>}};

}  // namespace

std::vector<std::string> profile_names()
{
    std::vector<std::string> names;
    for (const profile_row& row : profile_table)
        names.emplace_back(row.name);
    return names;
}

profile start_profile(const std::string& name, modbus_mapping_t& registers)
{
    for (const profile_row& row : profile_table) {
        if (name == row.name)
            return row.start(registers);
    }
    throw std::invalid_argument("no profile is called " + name);
}

}  // namespace plcgw::field
