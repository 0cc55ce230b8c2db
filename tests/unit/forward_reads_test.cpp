// Forwarded reads that become one, values that are known, and askers that take turns.
#include "bridge/routes/forward_queue.hpp"
#include "tests/support/print.hpp"
#include "tests/support/virtual_time.hpp"

TEST_SUITE_BEGIN("routes");

using namespace plcgw;
using namespace plcgw::test;

namespace {

using modbus::table;

modbus::read_table read(unsigned first, unsigned count, table from = table::holding_registers)
{
    return {from, modbus::address{static_cast<std::uint16_t>(first)}, static_cast<std::uint16_t>(count)};
}

// Register n holds n; bit n is set when n is odd.
modbus::response values_of(const modbus::read_table& asked)
{
    if (modbus::is_bit_table(asked.from)) {
        modbus::bits_read bits;
        for (unsigned i = 0; i < asked.count; ++i)
            bits.values.push_back((modbus::number(asked.first) + i) % 2 == 1);
        return bits;
    }
    modbus::registers_read registers;
    for (unsigned i = 0; i < asked.count; ++i)
        registers.values.push_back(static_cast<std::uint16_t>(modbus::number(asked.first) + i));
    return registers;
}

const station_number pump{5};
const station_number valve{6};

forward_asker asker(unsigned n) { return forward_asker{n}; }

struct queue_fixture {
    explicit queue_fixture(duration cache_age = {}) : queue(cache_age) {}

    forward_ticket ask(unsigned who, const modbus::request& what, station_number unit = pump)
    {
        return queue.add(asker(who), unit, what, {}).value();
    }
    std::optional<forward_request> take() { return queue.take(now, everything_goes); }
    std::map<forward_ticket, modbus::response> answers()
    {
        std::map<forward_ticket, modbus::response> got;
        for (forward_answer& each : queue.take_answers())
            got.emplace(each.ticket, each.response.value());
        return got;
    }

    static forward_queue::verdict everything_goes(const forward_request&) { return {}; }

    forward_queue queue;
    time_point now = t0;
};

}  // namespace

TEST_CASE("forwarded reads: which become one")
{
    struct row {
        const char* name;
        modbus::read_table a, b;
        std::optional<modbus::read_table> both;
    };
    const row rows[] = {
        {"the same", read(10, 5), read(10, 5), read(10, 5)},
        {"one within the other", read(10, 5), read(11, 2), read(10, 5)},
        {"they overlap", read(10, 5), read(13, 5), read(10, 8)},
        {"they touch", read(10, 5), read(15, 5), read(10, 10)},
        {"a gap", read(10, 5), read(16, 5), std::nullopt},
        {"another table", read(10, 5), read(10, 5, table::input_registers), std::nullopt},
        {"as much as one request carries", read(0, 100), read(100, 25), read(0, 125)},
        {"one more", read(0, 100), read(100, 26), std::nullopt},
        {"bits", read(0, 1000, table::coils), read(1000, 1000, table::coils), read(0, 2000, table::coils)},
        {"one bit more", read(0, 1000, table::coils), read(1000, 1001, table::coils), std::nullopt},
        {"the last register", read(65'530, 3), read(65'533, 3), read(65'530, 6)},
    };
    for (const row& each : rows) {
        CAPTURE(each.name);
        CHECK(joined(each.a, each.b) == each.both);
        CHECK(joined(each.b, each.a) == each.both);
        if (!each.both)
            continue;
        CHECK(part_of(values_of(*each.both), *each.both, each.a) == values_of(each.a));
        CHECK(part_of(values_of(*each.both), *each.both, each.b) == values_of(each.b));
    }
}

TEST_CASE("forwarded reads: those that overlap are asked once, and each asker gets its own part")
{
    queue_fixture f;
    const auto first = f.ask(1, read(10, 5));
    const auto other_unit = f.ask(2, read(10, 5), valve);
    const auto second = f.ask(3, read(18, 4));  // touches the third only
    const auto third = f.ask(4, read(13, 5));
    const auto apart = f.ask(5, read(100, 1));
    const auto taken = f.take();
    REQUIRE(taken);
    CHECK(taken->request == modbus::request{read(10, 12)});
    f.queue.answer(taken->ticket, values_of(read(10, 12)), f.now);
    const auto got = f.answers();
    REQUIRE(got.size() == 3);
    CHECK(got.at(first) == values_of(read(10, 5)));
    CHECK(got.at(second) == values_of(read(18, 4)));
    CHECK(got.at(third) == values_of(read(13, 5)));
    CHECK(f.take()->ticket == other_unit);
    CHECK(f.take()->ticket == apart);
    CHECK_FALSE(f.take());
}

TEST_CASE("forwarded reads: joined reads that are refused are asked one by one, and are not joined again")
{
    queue_fixture f;
    const auto good = f.ask(1, read(10, 5));
    const auto bad = f.ask(2, read(15, 5));
    const auto both = f.take();
    f.queue.answer(both->ticket, modbus::response{modbus::exception_code::illegal_data_address}, f.now);
    CHECK(f.answers().empty());
    std::map<forward_ticket, modbus::response> got;
    for (int i = 0; i < 2; ++i) {
        const auto one = f.take();
        REQUIRE(one);
        const bool is_good = one->request == modbus::request{read(10, 5)};
        f.queue.answer(
            one->ticket,
            is_good ? values_of(read(10, 5)) : modbus::response{modbus::exception_code::illegal_data_address}, f.now);
    }
    got = f.answers();
    CHECK(got.at(good) == values_of(read(10, 5)));
    CHECK(got.at(bad) == modbus::response{modbus::exception_code::illegal_data_address});
    CHECK(f.queue.empty());
}

TEST_CASE("forwarded reads: equal reads that are refused are refused together; a busy station is believed")
{
    for (const auto code : {modbus::exception_code::illegal_data_address, modbus::exception_code::server_device_busy}) {
        queue_fixture f;
        const bool is_busy = code == modbus::exception_code::server_device_busy;
        f.ask(1, read(10, 5));
        f.ask(2, is_busy ? read(11, 5) : read(10, 5));
        f.queue.answer(f.take()->ticket, modbus::response{code}, f.now);
        CHECK(f.answers().size() == 2);
        CHECK(f.queue.empty());
    }
}

TEST_CASE("forwarded reads: who leaves a joined read does not stop the others")
{
    queue_fixture f;
    const auto leader = f.ask(1, read(10, 5));
    const auto other = f.ask(2, read(12, 5));
    const auto taken = f.take();
    f.queue.cancel(leader);
    CHECK(f.queue.is_wanted(taken->ticket));
    f.queue.note_fault(taken->ticket, {errc::timed_out, {}});
    REQUIRE(f.queue.take_faults().size() == 1);
    f.queue.answer(taken->ticket, values_of(read(10, 7)), f.now);
    const auto got = f.answers();
    CHECK(got.size() == 1);
    CHECK(got.at(other) == values_of(read(12, 5)));
}

TEST_CASE("forwarding: askers take turns, one that asks a lot does not keep the others waiting")
{
    queue_fixture f;
    std::vector<forward_ticket> greedy;
    for (unsigned i = 0; i < 10; ++i)
        greedy.push_back(f.ask(1, read(100 * i, 1)));
    const auto second = f.ask(2, read(5000, 1));
    const auto third = f.ask(3, read(6000, 1));
    std::vector<forward_ticket> order;
    while (const auto next = f.take())
        order.push_back(next->ticket);
    REQUIRE(order.size() == 12);
    CHECK(order[0] == greedy[0]);
    CHECK(order[1] == second);
    CHECK(order[2] == third);
    CHECK(std::vector(order.begin() + 3, order.end()) == std::vector(greedy.begin() + 1, greedy.end()));
}

TEST_CASE("forwarding: a request that must wait lets others pass")
{
    queue_fixture f;
    const auto waits = f.ask(1, read(1, 1));
    const auto goes = f.ask(1, read(1, 1), valve);
    const auto judge = [&](const forward_request& each) {
        return forward_queue::verdict{.not_before = each.unit == pump ? t0 + 1s : time_point{}, .failed = {}};
    };
    CHECK(f.queue.take(t0, judge)->ticket == goes);
    CHECK_FALSE(f.queue.take(t0, judge));
    CHECK(f.queue.look(t0, judge) == t0 + 1s);
    CHECK(f.queue.take(t0 + 1s, judge)->ticket == waits);
}

TEST_CASE("forwarding: a queue that is full says so, to the one who fills it")
{
    queue_fixture f;
    for (unsigned i = 0; i < 64; ++i)
        f.ask(1, read(3 * i, 1));
    CHECK_FALSE(f.queue.add(asker(1), pump, read(1, 1), {}));
    CHECK(f.queue.add(asker(2), pump, read(1, 1), {}));
    unsigned added = 65;
    for (unsigned who = 3; f.queue.add(asker(who), pump, read(1, 1), {}); ++who)
        ++added;
    CHECK(added == 4096);
}

TEST_CASE("cache: a value that is young enough needs no line")
{
    queue_fixture f(500ms);
    f.ask(1, read(10, 5));
    f.queue.answer(f.take()->ticket, values_of(read(10, 5)), f.now);
    f.answers();

    const auto part = f.ask(2, read(11, 2));
    const auto more = f.ask(2, read(11, 5));
    f.queue.look(t0 + 500ms, queue_fixture::everything_goes);
    auto got = f.answers();
    CHECK(got.size() == 1);
    CHECK(got.at(part) == values_of(read(11, 2)));
    CHECK(f.take()->ticket == more);

    f.ask(3, read(10, 5));
    f.queue.look(t0 + 501ms, queue_fixture::everything_goes);
    CHECK(f.answers().empty());  // too old
}

TEST_CASE("cache: a write forgets what its station said, whoever wrote, and whether or not it was answered")
{
    const modbus::request write = modbus::write_single_register{modbus::address{10}, 7};
    for (const auto how : {"answered", "silent", "route", "broadcast", "asker left"}) {
        CAPTURE(how);
        queue_fixture f(1h);
        f.queue.heard(pump, read(10, 5), values_of(read(10, 5)), t0, t0);
        f.ask(1, read(10, 5));
        f.queue.look(t0, queue_fixture::everything_goes);
        CHECK(f.answers().size() == 1);

        const std::string way = how;
        if (way == "route") {
            f.queue.forget(pump, t0);
        }
        else {
            f.ask(1, write, way == "broadcast" ? station_number{0} : pump);
            const auto taken = f.take();
            if (way == "asker left")
                f.queue.cancel(taken->ticket);
            if (way == "silent")
                f.queue.answer(taken->ticket, make_error_code(errc::timed_out), t0);
            else
                f.queue.answer(taken->ticket, modbus::response{modbus::written{}}, t0);
            f.queue.take_answers();
        }
        f.ask(1, read(10, 5));
        f.queue.look(t0, queue_fixture::everything_goes);
        CHECK(f.answers().empty());
        CHECK(f.take());
    }
}

TEST_CASE("cache: a read that was asked before a write and answered behind it is not remembered")
{
    for (const station_number written : {pump, station_number{0}, valve}) {
        CAPTURE(number(written));
        queue_fixture f(1h);
        f.ask(1, read(10, 5));
        const auto asked_before = f.take();
        f.now = t0 + 10ms;
        f.queue.heard(written, modbus::write_single_register{modbus::address{10}, 7},
                      modbus::response{modbus::written{}}, f.now, f.now);
        f.queue.answer(asked_before->ticket, values_of(read(10, 5)), f.now);
        f.answers();
        f.ask(2, read(10, 5));
        f.queue.look(f.now, queue_fixture::everything_goes);
        CHECK(f.answers().size() == (written == valve ? 1 : 0));
    }
}

TEST_CASE("cache: without an age nothing is remembered, and exceptions never are")
{
    queue_fixture f;
    f.queue.heard(pump, read(10, 5), values_of(read(10, 5)), t0, t0);
    queue_fixture with(1s);
    with.queue.heard(pump, read(10, 5), modbus::response{modbus::exception_code::illegal_data_address}, t0, t0);
    for (queue_fixture* each : {&f, &with}) {
        each->ask(1, read(10, 5));
        each->queue.look(t0, queue_fixture::everything_goes);
        CHECK(each->answers().empty());
    }
}

TEST_SUITE_END();
