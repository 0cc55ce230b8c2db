// Long blocks as several commands, and what SEND and RECV store.
#include "protocols/mewtocol/conversation.hpp"
#include "protocols/mewtocol/plan.hpp"
#include "tests/support/print.hpp"

#include <numeric>

TEST_SUITE_BEGIN("mewtocol");

using namespace plcgw;
using namespace plcgw::mewtocol;

namespace {

std::vector<std::uint32_t> counts_of(const std::optional<std::vector<command>>& commands)
{
    std::vector<std::uint32_t> counts;
    for (const command& each : commands.value())
        counts.push_back(std::get<read_words>(each).count);
    return counts;
}

using counts = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("mewtocol plan: reads are cut behind 509 or 27 words, and never through a pair")
{
    const auto plan = [](std::uint32_t count, header h) { return counts_of(plan_read({word_area::dt, 7, count}, h)); };
    CHECK(plan(1, header::expansion) == counts{1});
    CHECK(plan(509, header::expansion) == counts{509});
    CHECK(plan(510, header::expansion) == counts{508, 2});
    CHECK(plan(1100, header::expansion) == counts{508, 508, 84});
    CHECK(plan(27, header::normal) == counts{27});
    CHECK(plan(28, header::normal) == counts{26, 2});

    const auto commands = plan_read({word_area::wr, 10, 600}, header::expansion).value();
    CHECK(commands[1] == command{read_words{word_area::wr, 518, 92}});
}

TEST_CASE("mewtocol plan: a long read may be left to a server that splits its response, with `%` only")
{
    const read_words block{word_area::dt, 0, 600};
    CHECK(counts_of(plan_read(block, header::normal, long_reads::many_frames)) == counts{600});
    CHECK(counts_of(plan_read(block, header::expansion, long_reads::many_frames)) == counts{508, 92});
}

TEST_CASE("mewtocol plan: writes are cut behind what fits, each command fits into one frame")
{
    struct {
        word_area to;
        header h;
        std::uint32_t most;
    } const rows[] = {
        {word_area::dt, header::expansion, 507}, {word_area::wr, header::expansion, 507},
        {word_area::sv, header::expansion, 507}, {word_area::dt, header::normal, 24},
        {word_area::wr, header::normal, 24},     {word_area::sv, header::normal, 25},
        {word_area::ev, header::normal, 25},
    };
    for (const auto& row : rows) {
        CAPTURE(to_string(row.to));
        CHECK(max_words_written(row.h, row.to) == row.most);
        for (const std::uint32_t count : {row.most, row.most + 1, 3 * row.most}) {
            std::vector<std::uint16_t> values(count);
            std::iota(values.begin(), values.end(), std::uint16_t{0});
            const auto commands = plan_write({row.to, 5, values}, row.h).value();
            CHECK((commands.size() == 1) == (count == row.most));
            std::vector<std::uint16_t> together;
            for (const command& each : commands) {
                const auto& write = std::get<write_words>(each);
                CHECK(write.first == 5 + together.size());
                CHECK(conversation(row.h, station_id{1}, each).is_expressible());
                together.insert(together.end(), write.values.begin(), write.values.end());
            }
            CHECK(together == values);
        }
    }
    CHECK(max_words_written(header::expansion, word_area::system) == 508);
}

TEST_CASE("mewtocol plan: what the protocol cannot say has no plan")
{
    CHECK_FALSE(plan_read({word_area::dt, 99'999, 2}, header::expansion));
    CHECK_FALSE(plan_read({word_area::dt, 0, 0}, header::expansion));
    CHECK_FALSE(plan_write({word_area::wx, 0, {1}}, header::expansion));
    CHECK_FALSE(plan_write({word_area::dt, 0, {}}, header::expansion));
}

TEST_CASE("mewtocol: station 0 of SEND is all stations, RECV has none")
{
    CHECK(station_of_send(0) == station_id::global);
    CHECK(station_of_send(1) == station_id{1});
    CHECK(station_of_send(99) == station_id{99});
    CHECK_FALSE(station_of_send(100));
    CHECK_FALSE(station_of_recv(0));
    CHECK(station_of_recv(99) == station_id{99});
    CHECK_FALSE(station_of_recv(100));
}

TEST_CASE("mewtocol: the result codes of SEND and RECV")
{
    struct {
        result<response> outcome;
        result_code code;
    } const rows[] = {
        {response{executed{}}, result_code::good},
        {response{no_response{}}, result_code::good},
        {response{error_code::data}, result_code::bad_response},
        {make_error_code(errc::timed_out), result_code::response_timeout},
        {make_error_code(errc::line_not_quiet), result_code::send_timeout},
        {make_error_code(errc::port_absent), result_code::send_timeout},
        {make_error_code(errc::not_expressible), result_code::send_timeout},
        {make_error_code(errc::bad_checksum), result_code::bad_response},
        {make_error_code(errc::unexpected_answer), result_code::bad_response},
        {make_error_code(errc::incomplete), result_code::bad_response},
    };
    for (const auto& row : rows)
        CHECK(result_of(row.outcome) == row.code);
    CHECK(static_cast<int>(result_code::bad_response) == 6);
}

TEST_CASE("mewtocol: an error code says its digits and its meaning")
{
    CHECK(to_string(error_code::data) == "61 (data)");
    CHECK(to_string(error_code::check) == "40 (check code)");
    CHECK(to_string(error_code{0x97}) == "97");
}

TEST_SUITE_END();
