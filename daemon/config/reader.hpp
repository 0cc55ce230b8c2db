// The visitor of fields.hpp that fills structs from JSON.
#pragma once

#include "daemon/config/fields.hpp"
#include "daemon/config/located_json.hpp"

namespace plcgw::config {

class reader {
public:
    reader(const located_json& file, const nlohmann::json& object, std::string pointer, mistakes& found)
        : file_(file), object_(object), pointer_(std::move(pointer)), found_(found)
    {
    }

    template <class T, class... Rule>
    void required(const char* key, T& out, const char* description, const Rule&... rule)
    {
        if (object_.contains(key))
            optional(key, out, description, rule...);
        else {
            known_.emplace_back(key);
            complain(pointer_, std::string("has no \"") + key + "\": " + description);
        }
    }

    template <class T, class... Rule>
    void optional(const char* key, T& out, const char* /*description*/, const Rule&... rule)
    {
        known_.emplace_back(key);
        const auto found = object_.find(key);
        if (found != object_.end())
            read(*found, pointer_ + "/" + key, out, rule...);
    }

    void report_unknown_keys();  // when all fields were visited

private:
    void read(const nlohmann::json& from, const std::string& at, std::string& out, const text& rule);
    void read(const nlohmann::json& from, const std::string& at, bool& out);
    void read(const nlohmann::json& from, const std::string& at, unsigned& out, const range& rule);

    void read(const nlohmann::json& from, const std::string& at, double& out, const real_range& rule);
    void read(const nlohmann::json& from, const std::string& at, std::vector<unsigned>& out, const range& rule);

    template <class Period>
    void read(const nlohmann::json& from, const std::string& at, std::chrono::duration<std::int64_t, Period>& out,
              const range& rule)
    {
        if (const auto value = integer(from, at, rule))
            out = std::chrono::duration<std::int64_t, Period>(*value);
    }

    template <class T, class Rule>
    void read(const nlohmann::json& from, const std::string& at, std::optional<T>& out, const Rule& rule)
    {
        read(from, at, out.emplace(), rule);
    }

    template <class Enum, std::size_t N>
    void read(const nlohmann::json& from, const std::string& at, Enum& out, const choice<Enum> (&choices)[N])
    {
        std::vector<std::string_view> names;
        for (const auto& each : choices) {
            if (from.is_string() && from.get_ref<const std::string&>() == each.name) {
                out = each.value;
                return;
            }
            names.push_back(each.name);
        }
        complain_choice(from, at, names);
    }

    template <class Enum, std::size_t N, std::size_t M>
    void read(const nlohmann::json& from, const std::string& at, Enum& out, const choice<Enum> (&choices)[N],
              const refusal (&refused)[M])
    {
        for (const refusal& each : refused)
            if (from.is_string() && from.get_ref<const std::string&>() == each.name) {
                complain(at, "is \"" + std::string(each.name) + "\", which is not safe: " + std::string(each.why));
                return;
            }
        read(from, at, out, choices);
    }

    // Lines of text: an array of strings.
    void read(const nlohmann::json& from, const std::string& at, std::vector<std::string>& out, const text& rule);

    template <class Struct>
    void read(const nlohmann::json& from, const std::string& at, std::vector<Struct>& out)
    {
        if (!from.is_array()) {
            complain(at, "is no array: [ ... ]");
            return;
        }
        for (std::size_t i = 0; i < from.size(); ++i)
            read(from[i], at + "/" + std::to_string(i), out.emplace_back());
    }

    template <class Struct>
    requires std::is_class_v<Struct>
    void read(const nlohmann::json& from, const std::string& at, Struct& out)
    {
        if (!from.is_object()) {
            complain(at, "is no object: { ... }");
            return;
        }
        reader inner(file_, from, at, found_);
        describe(inner, out);
        inner.report_unknown_keys();
    }

    std::optional<std::int64_t> integer(const nlohmann::json& from, const std::string& at, const range& rule);
    void complain_choice(const nlohmann::json& from, const std::string& at, const std::vector<std::string_view>& names);
    void complain(const std::string& at, std::string what);

    const located_json& file_;
    const nlohmann::json& object_;
    std::string pointer_;
    mistakes& found_;
    std::vector<std::string> known_;
};

// The known word with the fewest edits, if it is close enough to be meant; empty otherwise.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

}  // namespace plcgw::config
