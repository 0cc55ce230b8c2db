// Spoilt configurations: whatever stands in the file, `check` says what and where, and what it accepts can be run.
#include "daemon/config/read.hpp"
#include "daemon/gateway.hpp"
#include "daemon/plan_command.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <unistd.h>

TEST_SUITE_BEGIN("fuzz");

using namespace plcgw;
using nlohmann::json;
using namespace std::chrono_literals;

namespace {

std::string text_of(const char* file)
{
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// The same every time, unless somebody looks for more: PLCGW_FUZZ_SEED.
unsigned seed()
{
    const char* const given = std::getenv("PLCGW_FUZZ_SEED");
    return given == nullptr ? 4711 : static_cast<unsigned>(std::atoi(given));
}

class spoiler {
public:
    explicit spoiler(json base, unsigned seed) : base_(std::move(base)), random_(seed)
    {
        collect(base_, values_);
        const json more[] = {nullptr,
                             true,
                             -1,
                             0,
                             1,
                             2,
                             16,
                             99,
                             125,
                             126,
                             247,
                             248,
                             999,
                             65'535,
                             65'536,
                             1e300,
                             -0.5,
                             1U << 31U,
                             UINT64_MAX,
                             INT64_MIN,
                             "",
                             "D0",
                             "D7999",
                             "D8000",
                             "D32767",
                             "M0",
                             "M7679",
                             "X17",
                             "Y377",
                             "R0",
                             "R32767",
                             "TN0",
                             "CN199",
                             "CN200",
                             "CN255",
                             "S0",
                             "DT100",
                             "R2047F",
                             "R999F",
                             "WX0",
                             "LD5",
                             "T12",
                             "read-write",
                             "write",
                             "write-through",
                             "periodic-write",
                             "FP7",
                             "FX3S",
                             "coil",
                             "holding",
                             "server",
                             "modbus-tcp",
                             "mewtocol-com",
                             "mewtocol7-com",
                             "general-purpose",
                             "\xC3\xBC",
                             json::array(),
                             json::object(),
                             std::string(300, 'x'),
                             "LD M8411",
                             "MOV K1 D8470"};
        values_.insert(values_.end(), std::begin(more), std::end(more));
    }

    json next()
    {
        json made = base_;
        for (std::size_t n = 1 + below(4); n > 0; --n)
            spoil(made);
        return made;
    }

    // As somebody may leave it who edits the text.
    std::string scratch(std::string text)
    {
        constexpr std::string_view characters = "{}[],:\"\\/*0-e\n\t\x01\x7F\xC3";
        for (std::size_t n = below(8) == 0 ? 1 + below(3) : 0; n > 0 && !text.empty(); --n) {
            const std::size_t at = below(text.size());
            if (below(2) == 0)
                text.erase(at, 1 + below(20));
            else
                text.insert(at, 1, characters[below(characters.size())]);
        }
        return text;
    }

private:
    std::size_t below(std::size_t n) { return random_() % n; }
    const json& any_value() { return values_[below(values_.size())]; }

    static void collect(const json& from, std::vector<json>& to)
    {
        to.push_back(from);
        if (from.is_structured())
            for (const json& each : from)
                collect(each, to);
    }

    // Somewhere in the tree, an object or an array that holds something.
    json* container(json& root)
    {
        json* at = &root;
        for (;;) {
            std::vector<json*> inside;
            for (json& each : *at)
                if (each.is_structured() && !each.empty())
                    inside.push_back(&each);
            if (inside.empty() || below(4) == 0)
                return at;
            at = inside[below(inside.size())];
        }
    }

    void spoil(json& root)
    {
        if (!root.is_structured() || root.empty())
            return;
        json& in = *container(root);
        auto at = in.begin();
        std::advance(at, static_cast<std::ptrdiff_t>(below(in.size())));
        switch (below(6)) {
        case 0: in.erase(at); break;
        case 1:
            if (in.is_array())
                in.push_back(*at);
            else
                in["unit" + std::to_string(below(3))] = *at;
            break;
        case 2:
            if (at->is_number_integer())
                *at = at->get<std::int64_t>() + static_cast<std::int64_t>(below(5)) - 2;
            else
                *at = any_value();
            break;
        default: *at = any_value();
        }
    }

    json base_;
    std::mt19937 random_;
    std::vector<json> values_;
};

// The value that it names, or the one that holds or lacks it.
bool leads_somewhere(const json& in, const std::string& pointer)
{
    if (pointer.empty() || in.contains(json::json_pointer(pointer)))
        return true;
    return in.contains(json::json_pointer(pointer.substr(0, pointer.rfind('/'))));
}

// True when it is accepted.
bool look_at(const std::string& text)
{
    CAPTURE(text);
    const config::loaded loaded = config::load_text(text, "");
    const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
    const json read = json::parse(text, nullptr, false, true);
    for (const config::mistake& each : loaded.found) {
        CAPTURE(each.pointer);
        CAPTURE(each.text);
        CHECK(!each.text.empty());
        CHECK(each.line >= 1);
        CHECK(each.line <= lines);
        if (!read.is_discarded())
            CHECK(leads_somewhere(read, each.pointer));
    }
    if (config::has_errors(loaded.found))
        return false;
    CHECK_FALSE(read.is_discarded());
    loads_of(loaded.config, {});
    asio::io_context loop(1);
    CHECK_NOTHROW(gateway(loop, loaded));
    return true;
}

}  // namespace

TEST_CASE("spoilt configurations are explained, and those that are accepted can be run")
{
    for (const char* file : {PLCGW_ETC "/demo.json", PLCGW_CONFIG_TESTS "/everything.json"}) {
        CAPTURE(file);
        const std::string text = text_of(file);
        const json base = json::parse(text, nullptr, true, true);
        REQUIRE(look_at(base.dump(1)));
        spoiler spoil(base, seed());
        unsigned accepted = 0;
        for (int n = 0; n < 300; ++n)
            accepted += look_at(spoil.scratch(spoil.next().dump(1))) ? 1 : 0;
        CHECK(accepted > 5);
    }
}

TEST_CASE("spoilt files of what was learned are ignored or planned with")
{
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("plcgw-learned-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    const learned_store store(folder);
    learned_by_station stations;
    for (const unsigned unit : {1U, 2U, 3U}) {
        station_limits& of = stations[{"line1", unit}];
        of.turnaround = 4ms;
        for (const auto what : {learned_limit::kind::gap, learned_limit::kind::boundary, learned_limit::kind::block,
                                learned_limit::kind::length})
            of.tables["input"].restore({what, {2, 4}, {0, 8}, read_block{3, 3}, "exception 02", wall_time{1}, false});
    }
    REQUIRE(store.save(stations).empty());
    CHECK(store.load().problem.empty());
    CHECK(store.load().stations.size() == 3);

    const config::loaded plant = config::load_file(PLCGW_ETC "/demo.json");
    REQUIRE_FALSE(config::has_errors(plant.found));
    spoiler spoil(json::parse(text_of(store.file().c_str())), seed());
    unsigned taken = 0;
    for (int n = 0; n < 500; ++n) {
        const std::string text = spoil.scratch(spoil.next().dump(1));
        CAPTURE(text);
        std::ofstream(store.file()) << text;
        learned_store::loaded kept;
        CHECK_NOTHROW(kept = store.load());
        CHECK((kept.problem.empty() || kept.stations.empty()));
        taken += kept.problem.empty() ? 1 : 0;
        loads_of(plant.config, kept.stations);
    }
    CHECK(taken > 25);
    std::filesystem::remove_all(folder);
}

TEST_SUITE_END();
