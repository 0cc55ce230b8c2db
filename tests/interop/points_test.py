"""Points, losses, status words, safe values and directions of the built daemon."""

import struct
import time

from support import InteropTest, holds, main, mbpoll, route, serial_line, station, wait_for

HOLDING_REGISTERS = 4  # mbpoll's -t


def registers(value, order):
    """The two registers of a float, as devices with this order have them."""
    a, b, c, d = struct.pack(">f", value)
    first, second = {"ABCD": ((a, b), (c, d)), "CDAB": ((c, d), (a, b)),
                     "BADC": ((b, a), (d, c)), "DCBA": ((d, c), (b, a))}[order]
    return [first[0] << 8 | first[1], second[0] << 8 | second[1]]


class PointsTest(InteropTest):
    def start(self, routes, points=(), stations=None, plcs=("main",), timeout=1000, **more):
        self.gateway = self.start_gateway(self.configuration(
            (), plcs, lines=[serial_line(self.folder / "line", response_timeout_ms=timeout, retries=0)],
            stations=stations or [station("one", 1)], routes=list(routes), points=list(points), **more))
        self.watch = self.gateway.watch()

    def device(self, *options):
        self.start_bus(2)
        return self.start_device(1, 1, *options)

    def point(self, name, **wanted):
        """Waits until the latest sample of a point has these fields, and returns it."""
        def fitting():
            self.watch.read()
            latest = self.watch.points.get(name, {})
            return latest if latest and all(latest.get(key) == value for key, value in wanted.items()) else None
        return wait_for(lambda: f"point {name} with {wanted}, the latest is {self.watch.points.get(name)}", fitting)

    def holding(self, first, count=1, unit=1):
        return mbpoll(self.gateway.port, HOLDING_REGISTERS, first, count, unit=unit)

    def test_floats_of_a_device_in_all_orders(self):
        values = {"ABCD": 21.5, "CDAB": -40.25, "BADC": 1e-3, "DCBA": 12345.678}
        sets = []
        for i, (order, value) in enumerate(values.items()):
            high, low = registers(value, order)
            sets += [f"ir:{2 * i}={high}", f"ir:{2 * i + 1}={low}"]
        self.device("--set", *sets)
        points = [{"name": f"p.{order}", "plc": "main", "device": f"D{100 + 2 * i}", "type": "float", "order": order,
                   "unit": "Cel"} for i, order in enumerate(values)]
        self.start([route("one.values", "input", 0, "D100", 8, period_ms=100)], points)
        for order, value in values.items():
            sample = self.point(f"p.{order}", quality="good")
            self.assertAlmostEqual(sample["value"], value, delta=abs(value) * 1e-6)
            self.assertEqual([sample["kind"], sample["unit"]], ["real", "Cel"])
            self.assertGreater(sample["source_ns"], 0)

    def test_loss_keep_zero_and_value(self):
        device = self.device("--set", *[f"hr:{i}=7" for i in range(6)])
        self.start([route("one.keep", "holding", 0, "D100", 2, period_ms=200),
                    route("one.zero", "holding", 2, "D102", 2, period_ms=200, on_loss="zero"),
                    route("one.value", "holding", 4, "D104", 2, period_ms=200, on_loss="value", loss_value=[1, 2],
                          status={"device": "D500"})],
                   [{"name": "zero", "plc": "main", "device": "D102"}],
                   [station("one", 1, status={"plc": "main", "device": "D520"})], timeout=200)
        self.point("zero", quality="good", value=7)
        wait_for("all are read", lambda: self.holding(100, 6) == [7] * 6)
        good = wait_for("good status words", lambda: [words for words in [self.holding(500, 8)]
                                                      if [words[0], words[1], words[7]] == [192, 0, 0]])[0]
        self.assertLess(abs((good[3] % 65536 << 16 | good[4] % 65536) - time.time()), 10)
        self.assertGreater(good[6], 0)
        wait_for("the station's words", lambda: self.holding(520, 3) == [0, 3, 3])

        device.kill()
        wait_for("the substitutes", lambda: self.holding(100, 6) == [7, 7, 0, 0, 1, 2])
        self.watch.expect("one.keep", quality="comm error", values=[7, 7])
        self.watch.expect("one.zero", quality="substituted", values=[0, 0], quality_code=72)
        self.point("zero", quality="substituted", value=0, quality_code=72)
        wait_for("the status", lambda: self.holding(500, 2) == [72, 0x101] and self.holding(520) == [2])
        age = self.holding(502)[0]
        wait_for("the value grows older", lambda: self.holding(502)[0] > age)

        self.device_again = self.start_device(1, 1, "--set", *[f"hr:{i}=8" for i in range(6)])
        wait_for("the station is back", lambda: self.holding(100, 6) == [8] * 6)
        self.point("zero", quality="good", value=8)
        wait_for("the status", lambda: self.holding(500, 2) == [192, 0] and self.holding(520) == [0])

    def test_safe_values_when_nobody_writes(self):
        device = self.device()
        self.start([route("one.set", "holding", 0, "D100", 2, direction="write",
                          upstream={"longest_silence_ms": 4000, "safe": [0, 50]})])
        client = self.gateway.client()
        client.write_registers(100, [11, 12])
        wait_for("the values", lambda: device.door.holding(0, 2) == [11, 12])

        def alive():
            client.write_register(100, 11)  # unchanged
            time.sleep(0.1)
            return device.door.holding(0, 2) == [11, 12]
        holds("written values stay", alive, 6)  # a machine that stands still for 4 s would be a lost writer
        wait_for("the safe values", lambda: device.door.holding(0, 2) == [0, 50])
        self.assertEqual(self.gateway.log.count("nobody wrote its devices"), 1)
        client.write_registers(100, [21, 22])
        wait_for("the values again", lambda: device.door.holding(0, 2) == [21, 22])
        self.assertIn("its devices are written again", self.gateway.log)

    def test_read_write(self):
        device = self.device("--set", "hr:0=1", "hr:1=2")
        self.start([route("one.both", "holding", 0, "D100", 2, direction="read-write", period_ms=100)],
                   [{"name": "both", "plc": "main", "device": "D100", "type": "int32", "writable": True}])
        wait_for("what the device has", lambda: self.holding(100, 2) == [1, 2])
        device.door.write_register(0, 5)
        wait_for("what the device has now", lambda: self.holding(100, 2) == [5, 2])
        client = self.gateway.client()
        for value in range(20, 40):
            client.write_registers(100, [value, value])
            self.assertEqual(client.holding(100, 2), [value, value])
            wait_for("it is in the device", lambda: device.door.holding(0, 2) == [value, value])
            holds("no read undoes it", lambda: client.holding(100, 2) == [value, value], 0.05)
        self.point("both", value=39 << 16 | 39, quality="good")

    def test_periodic_write(self):
        device = self.device("--set", "hr:0=1")
        self.start([route("one.beat", "holding", 0, "D100", direction="periodic-write", period_ms=500)])
        time.sleep(1)
        self.assertEqual(device.answers(), 0)  # nobody wrote anything yet
        self.gateway.client().write_register(100, 9)
        wait_for("the first", lambda: device.door.holding(0) == [9])

        def pace():
            before, started = device.answers(), time.monotonic()
            time.sleep(4)
            return (device.answers() - before) / ((time.monotonic() - started) / 0.5)
        measured = []
        for _ in range(5):  # a machine that stands still now and then writes less often, never more
            measured.append(pace())
            self.assertLess(measured[-1], 1.3)
            if measured[-1] > 0.7:
                return
        self.fail(f"writes per period: {measured}")

    def test_a_long_value_goes_to_the_station_in_one_request(self):
        device = self.device()
        self.start([route("one.set", "holding", 0, "D100", 4, direction="write")])
        client = self.gateway.client()
        for n in range(1, 11):
            before = device.answers()
            client.write_registers(101, [n, n])
            wait_for("it is there", lambda: device.door.holding(0, 4) == [0, n, n, 0])
            self.assertEqual(device.answers() - before, 1)

    def test_copies_between_plcs(self):
        self.device("--set", "ir:0=17")
        self.start([route("one.in", "input", 0, "D100", period_ms=100),
                    {"name": "over", "from": {"plc": "main", "device": "D100"}, "count": 1, "plc": "other", "device": "D7"},
                    {"name": "back", "from": {"plc": "other", "device": "D7"}, "count": 1, "plc": "main", "device": "D200"}],
                   [{"name": "copied", "plc": "other", "device": "D7"}], plcs=("main", "other"))
        wait_for("the copy of the copy", lambda: self.holding(200) == [17])
        self.assertEqual(self.holding(7, unit=2), [17])
        self.point("copied", value=17, quality="good")


main()
