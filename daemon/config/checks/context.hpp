// What the checks of a configuration share: names that lead to rows, and the place for complaints.
#pragma once

#include "bridge/plc/model.hpp"
#include "daemon/config/config.hpp"
#include "daemon/config/located_json.hpp"

#include <set>
#include <unordered_map>

namespace plcgw::config {

// The pointer of an element: "/lines/0" or "/lines/0/device".
std::string item(const char* list, std::size_t index, const char* key = nullptr);

// The rows of a list by their names. Of rows with the same name the first one counts.
template <class Row>
class name_index {
public:
    explicit name_index(const std::vector<Row>& rows) : rows_(rows)
    {
        for (std::size_t i = 0; i < rows.size(); ++i)
            first_.emplace(rows[i].name, i);
    }

    const Row* find(const std::string& name) const
    {
        const auto found = first_.find(name);
        return found == first_.end() ? nullptr : &rows_[found->second];
    }

    std::vector<std::string> names() const
    {
        std::vector<std::string> all;
        for (const Row& each : rows_)
            all.push_back(each.name);
        return all;
    }

private:
    const std::vector<Row>& rows_;
    std::unordered_map<std::string, std::size_t> first_;
};

class check_context {
public:
    // folder: of the file, for program_file. What is in `found` already are the reader's mistakes.
    check_context(const gateway_config& c, const located_json& file, const std::string& folder, mistakes& found);

    const gateway_config& config;
    const std::string& folder;
    const name_index<plc_config> plcs;
    const name_index<line_config> lines;
    const name_index<station_config> stations;

    void complain(const std::string& at, std::string what, mistake::weight how = mistake::weight::error);

    // Nothing in this row was complained about while it was read: no default stands in for what was meant.
    bool is_sound(const std::string& row) const;

    // The row with this name, or null and a complaint at `at`. An absent name was already complained about.
    const plc_config* plc(const std::string& name, const std::string& at);
    const line_config* line(const std::string& name, const std::string& at);
    const station_config* station(const std::string& name, const std::string& at);

    // Null when the PLC or its model does not exist, of which somebody else complains.
    const plc::model* model_of(const std::string& plc) const;

private:
    template <class Row>
    const Row* find(const char* list, const name_index<Row>& rows, const char* what, const std::string& name,
                    const std::string& at);

    const located_json& file_;
    mistakes& found_;
    std::set<std::string> unread_;  // where the reader found mistakes
};

}  // namespace plcgw::config
