#!/usr/bin/python3
"""Reads that share requests, and devices that refuse a gap, a length or a register: what they are asked before and after."""

import struct

from faulty_device import FaultyDevice, framed
from support import InteropTest, holds, main, route, serial_line, station, wait_for


class PickyDevice(FaultyDevice):
    def __init__(self, link):
        super().__init__(link)
        self.missing = set()
        self.longest = 125
        self.requests = []  # (first, count) so far

    def answer(self, request):
        first, count = struct.unpack(">HH", request[2:6])
        self.requests.append((first, count))
        if count > self.longest:
            return framed(request[:1] + b"\x83\x03")
        if self.missing.intersection(range(first, first + count)):
            return framed(request[:1] + b"\x83\x02")
        return super().answer(request)


class PickyDevices(InteropTest):
    def start(self, routes, missing=(), longest=125, **keys):
        """Routes of (first, count), each into the devices of its own number."""
        self.device = PickyDevice(self.folder / "line")
        self.addCleanup(self.device.end)
        self.device.missing.update(missing)
        self.device.longest = longest
        self.device.start()
        self.routes = routes
        self.config = self.configuration(
            lines=[serial_line(self.folder / "line", baud_rate=115200)], stations=[station("pump", 1, **keys)],
            routes=[route(f"pump.{first}", "holding", first, f"D{first}", count, period_ms=50) for first, count in routes])
        self.run_gateway()

    def run_gateway(self):
        self.gateway = self.start_gateway(self.config)
        self.client = self.gateway.client()
        self.watch = self.gateway.watch().connected()

    def expect_good(self, *but):
        for first, count in self.routes:
            if first not in but:
                self.watch.expect(f"pump.{first}", quality="good", values=list(range(first, first + count)))
                self.assertEqual(self.client.holding(first, count), list(range(first, first + count)))

    def settled(self, *expected):
        """Waits until these requests, and no others, have been made for a while."""
        def seen():
            return set(self.device.requests[-20:]) == set(expected) and len(self.device.requests) > 40
        wait_for(lambda: f"{expected}, the latest are {self.device.requests[-20:]}", seen)

    def test_routes_share_a_request(self):
        self.start([(0, 4), (6, 4), (200, 2)])
        self.expect_good()
        self.assertEqual(set(self.device.requests), {(0, 10), (200, 2)})

    def test_merge_off(self):
        self.start([(0, 4), (4, 4)], merge="off")
        self.expect_good()
        self.assertEqual(set(self.device.requests), {(0, 4), (4, 4)})

    def test_a_refused_gap_is_asked_once_and_remembered_across_a_restart(self):
        self.start([(0, 4), (6, 4)], missing=[4])
        self.expect_good()
        self.settled((0, 4), (6, 4))
        self.assertEqual(self.device.requests.count((0, 10)), 1)
        for name in ("pump.0", "pump.6"):
            self.assertNotIn("device error", [each["quality"] for each in self.watch.of(name)])
        self.assertEqual(self.gateway.log.count("in one request"), 1)
        self.assertIn("station pump (unit 1) refuses holding 0-9 in one request: exception 02", self.gateway.log)

        self.assertEqual(self.gateway.stop(), 0)
        self.device.requests.clear()
        self.run_gateway()
        self.expect_good()
        self.settled((0, 4), (6, 4))
        self.assertEqual(set(self.device.requests), {(0, 4), (6, 4)})
        self.assertNotIn("in one request", self.gateway.log)

    def test_a_length_is_found_by_halving(self):
        self.start([(10 * i, 10) for i in range(10)], longest=32)
        self.expect_good()
        wait_for("requests of at most 30", lambda: all(count <= 30 for _, count in self.device.requests[-40:]))
        refused = [each for each in self.device.requests if each[1] > 32]
        self.assertLessEqual(len(refused), 5)
        self.assertEqual(len(refused), len(set(refused)), "a refused request was repeated")
        self.assertEqual(len(set(self.device.requests[-40:])), 4)  # ten routes in four requests

    def test_one_bad_register_leaves_its_neighbours_alone(self):
        self.start([(0, 4), (4, 4), (8, 4), (12, 4)], missing=[9])
        self.expect_good(8)
        self.watch.expect("pump.8", quality="device error")
        self.settled((0, 8), (8, 4), (12, 4))
        for name in ("pump.0", "pump.4", "pump.12"):
            self.assertNotIn("device error", [each["quality"] for each in self.watch.of(name)])
        holds("the neighbours are read", lambda: self.watch.latest("pump.4")["quality"] == "good", 1)

    def test_a_damaged_state_file_is_reported_and_replaced(self):
        state = self.folder / "state"
        state.mkdir()
        (state / "learned.json").write_text("{")
        self.start([(0, 4), (6, 4)], missing=[4])
        self.settled((0, 4), (6, 4))
        self.assertIn("learned.json is damaged and ignored", self.gateway.log)
        wait_for("it is written", lambda: '"gap"' in (state / "learned.json").read_text())


main()
