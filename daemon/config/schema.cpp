#include "daemon/config/schema.hpp"

#include "daemon/config/fields.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace plcgw::config {
namespace {

using json = nlohmann::ordered_json;

template <class Struct>
json object_schema();

json value_schema(const std::string& value, const text& rule)
{
    json s{{"type", "string"}};
    if (rule.least > 0)
        s["minLength"] = rule.least;
    s["maxLength"] = rule.most;
    s["default"] = value;
    return s;
}

json value_schema(bool value) { return {{"type", "boolean"}, {"default", value}}; }

json integer_schema(const range& rule)
{
    return {{"type", "integer"}, {"minimum", rule.least}, {"maximum", rule.most}};
}

json value_schema(unsigned value, const range& rule)
{
    json s = integer_schema(rule);
    s["default"] = value;
    return s;
}

json number_schema(const real_range& rule)
{
    return {{"type", "number"}, {"minimum", rule.least}, {"maximum", rule.most}};
}

json value_schema(double value, const real_range& rule)
{
    json s = number_schema(rule);
    s["default"] = value;
    return s;
}

json value_schema(const std::optional<double>&, const real_range& rule) { return number_schema(rule); }

json value_schema(const std::vector<unsigned>&, const range& rule)
{
    return {{"type", "array"}, {"items", integer_schema(rule)}};
}

template <class Period>
json value_schema(const std::chrono::duration<std::int64_t, Period>& value, const range& rule)
{
    json s = integer_schema(rule);
    s["default"] = value.count();
    return s;
}

template <class T>
json value_schema(const std::optional<T>&, const range& rule)
{
    return integer_schema(rule);
}

template <class Enum, std::size_t N>
json value_schema(Enum value, const choice<Enum> (&choices)[N])
{
    json s{{"enum", json::array()}};
    for (const auto& each : choices) {
        s["enum"].push_back(each.name);
        if (each.value == value)
            s["default"] = each.name;
    }
    return s;
}

template <class Enum, std::size_t N, std::size_t M>
json value_schema(Enum value, const choice<Enum> (&choices)[N], const refusal (&)[M])
{
    return value_schema(value, choices);
}

json value_schema(const std::vector<std::string>&, const text& rule)
{
    json item = value_schema(std::string{}, rule);
    item.erase("default");
    return {{"type", "array"}, {"items", std::move(item)}};
}

template <class Enum, std::size_t N>
json value_schema(const std::optional<Enum>&, const choice<Enum> (&choices)[N])
{
    json s = value_schema(choices[0].value, choices);
    s.erase("default");
    return s;
}

template <class Struct>
json value_schema(const std::vector<Struct>&)
{
    return {{"type", "array"}, {"items", object_schema<Struct>()}};
}

template <class Struct>
requires std::is_class_v<Struct> json value_schema(const Struct&) { return object_schema<Struct>(); }

class writer {
public:
    template <class T, class... Rule>
    void required(const char* key, const T& value, const char* description, const Rule&... rule)
    {
        optional(key, value, description, rule...);
        properties[key].erase("default");
        required_keys.push_back(key);
    }

    template <class T, class... Rule>
    void optional(const char* key, const T& value, const char* description, const Rule&... rule)
    {
        json s{{"description", description}};
        s.update(value_schema(value, rule...));
        properties[key] = std::move(s);
    }

    json properties = json::object();
    json required_keys = json::array();
};

template <class Struct>
json object_schema()
{
    Struct defaults;
    writer w;
    describe(w, defaults);
    json s{{"type", "object"}, {"additionalProperties", false}};
    if (!w.required_keys.empty())
        s["required"] = std::move(w.required_keys);
    s["properties"] = std::move(w.properties);
    return s;
}

}  // namespace

std::string schema()
{
    json root{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "plc-gateway configuration"},
              {"description", "Made by `plc-gateway schema`; comments are allowed in the configuration itself."}};
    root.update(object_schema<gateway_config>());
    return root.dump(2) + "\n";
}

}  // namespace plcgw::config
