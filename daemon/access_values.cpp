#include "daemon/access_values.hpp"

#include "daemon/config/point_fields.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace plcgw {
namespace {

constexpr unsigned most_characters = 4000;  // far more than any device holds, and little to allocate

order_outcome rejected(std::string why) { return {order_result::rejected, 0, std::move(why)}; }

std::optional<std::int64_t> whole(std::string_view text)
{
    const bool negative = text.starts_with('-');
    text.remove_prefix(negative || text.starts_with('+') ? 1 : 0);
    const bool hexadecimal = text.starts_with("0x") || text.starts_with("0X");
    text.remove_prefix(hexadecimal ? 2 : 0);
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, hexadecimal ? 16 : 10);
    if (error != std::errc{} || end != text.data() + text.size() || text.starts_with('-'))
        return std::nullopt;
    return negative ? -number : number;
}

std::optional<double> real(const std::string& text)
{
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool all = error == std::errc{} && end == text.data() + text.size();
    return all && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::string lower(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

template <class Enum, std::size_t Size>
boost::system::result<Enum, order_outcome> chosen(const config::choice<Enum> (&from)[Size], const std::string& name,
                                                  const char* what)
{
    std::string all;
    for (const auto& each : from) {
        if (lower(std::string(each.name)) == lower(name))
            return each.value;
        all.append(all.empty() ? "" : ", ").append(each.name);
    }
    return rejected(fmt::format("{} is \"{}\", expected one of: {}", what, name, all));
}

}  // namespace

point_value typed_value(const std::string& text)
{
    const std::string word = lower(text);
    if (word == "true" || word == "on")
        return boolean_value(true);
    if (word == "false" || word == "off")
        return boolean_value(false);
    if (const auto number = whole(text))
        return integer_value(*number);
    if (const auto number = real(text))
        return real_value(*number);
    return text_value(text);
}

boost::system::result<point_form, order_outcome> form_of(const value_form& f)
{
    point_form form;
    form.characters = f.characters;
    const auto type = chosen(config::point_types, f.type.empty() ? "int16" : f.type, "type");
    const auto order = chosen(config::value_orders, f.order.empty() ? "ABCD" : f.order, "order");
    if (!type || !order)
        return type ? order.error() : type.error();
    form.type = *type;
    form.order = *order;
    if (form.type == value_type::boolean)
        return rejected("registers are no bool: write the bit itself, or a point");
    if (form.type == value_type::text && form.characters == 0)
        return rejected("of text it has to be known how many characters there are: --count says it");
    if (form.characters > most_characters)
        return rejected(fmt::format("text has 1 to {} characters", most_characters));
    return form;
}

boost::system::result<order_values, order_outcome> values_of(const std::vector<std::string>& texts, bool are_bits,
                                                             const value_form& f)
{
    order_values values;
    values.are_bits = are_bits;
    if (are_bits) {
        values.count = static_cast<std::uint32_t>(texts.size());
        values.words.resize((texts.size() + 15) / 16);
        for (std::size_t i = 0; i < texts.size(); ++i) {
            const point_value bit = typed_value(texts[i]);
            if (bit.kind == point_kind::text || (bit.real != 0 && bit.real != 1))
                return rejected(fmt::format("\"{}\" is no bit: give 0 or 1", texts[i]));
            if (bit.real != 0)
                values.words[i / 16] = static_cast<std::uint16_t>(values.words[i / 16] | 1U << i % 16);
        }
        return values;
    }
    for (const std::string& text : texts) {
        value_form with = f;
        if (with.characters == 0)
            with.characters = static_cast<unsigned>(text.size());
        auto form = form_of(with);
        if (!form)
            return form.error();
        const point_value value = form->type == value_type::text ? text_value(text) : typed_value(text);
        if (f.type.empty() && value.real >= 0)  // a register, with or without a sign
            form->type = value_type::uint16;
        const auto words = encode(*form, value);
        if (!words)
            return rejected(fmt::format("\"{}\": {}", text, words.error().text));
        values.words.insert(values.words.end(), words->begin(), words->end());
    }
    values.count = static_cast<std::uint32_t>(values.words.size());
    return values;
}

nlohmann::json json_of(const std::optional<point_value>& value)
{
    if (!value)
        return nullptr;
    switch (value->kind) {
    case point_kind::boolean: return value->integer != 0;
    case point_kind::integer: return value->integer;
    case point_kind::real: return value->real;
    case point_kind::text: return value->text;
    case point_kind::none: break;
    }
    return nullptr;
}

std::vector<nlohmann::json> json_of(const order_values& values, const point_form& f)
{
    std::vector<nlohmann::json> shown;
    for (std::size_t i = 0; values.are_bits && i < values.count; ++i)
        shown.emplace_back(values.bit(i) ? 1 : 0);
    const std::size_t each = registers_of(f.type, f.characters);
    for (std::size_t i = 0; !values.are_bits && i + each <= values.words.size(); i += each)
        shown.push_back(json_of(decode(f, const_register_span(values.words).subspan(i, each))));
    return shown;
}

}  // namespace plcgw
