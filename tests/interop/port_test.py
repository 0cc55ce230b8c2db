"""A serial port that is absent, comes, is pulled out and plugged in again under another number."""

import os
import signal
import time

from support import InteropTest, Client, Program, binary, main, route, serial_line, station, wait_for


class PortTest(InteropTest):
    def setUp(self):
        self.line = self.folder / "line"
        self.doors = [self.free_port() for _ in range(2)]

    def start_line(self):
        devices = [f"--device={i + 1}::{door}" for i, door in enumerate(self.doors)]
        self.bus = Program(self, "field-line", [binary("FIELD_LINE"), "--link", self.line, *devices]).ready()
        self.one, self.two = (Client(self, door, i + 1) for i, door in enumerate(self.doors))

    def start(self):
        self.gateway = self.start_gateway(self.configuration(
            lines=[serial_line(self.line, response_timeout_ms=200)], stations=[station("one", 1), station("two", 2)],
            routes=[route("one.values", "holding", 0, "D100", 2, period_ms=100),
                    route("two.values", "holding", 0, "D110", 2, period_ms=100),
                    route("two.setpoint", "holding", 50, "D120", direction="write")]))
        self.client = self.gateway.client()
        self.watch = self.gateway.watch()

    def expect(self, quality, values=None):
        fields = {"quality": quality, **({"values": values} if values else {})}
        for name in ("one.values", "two.values"):
            self.watch.expect(name, **fields)

    def write_devices(self, values):
        self.one.write_registers(0, values)
        self.two.write_registers(0, values)

    def pull_out(self):
        self.bus.signal(signal.SIGUSR1)
        wait_for("the port is gone", lambda: not self.line.is_symlink())

    def plug_in(self):
        self.bus.signal(signal.SIGUSR2)
        wait_for("the port is there", self.line.exists)

    def test_port_that_is_absent_at_start_and_comes_later(self):
        self.start()
        self.expect("comm error")
        self.assertEqual(self.client.holding(100, 2), [0, 0])
        self.client.write_register(0, 5)
        self.assertEqual(self.client.holding(0), [5])
        self.assertIn("cannot be opened", self.gateway.log)

        used, began = self.gateway.cpu_seconds(), time.monotonic()
        time.sleep(3)
        share = (self.gateway.cpu_seconds() - used) / (time.monotonic() - began)
        print(f"CPU while the port is absent: {share * 100:.1f} %", flush=True)
        self.assertLess(share, 0.05)
        self.assertLess(self.gateway.log.count("cannot be opened"), 2, "said once, not at each try")

        self.start_line()
        self.write_devices([11, 12])
        self.expect("good", [11, 12])
        self.assertEqual(self.client.holding(100, 2), [11, 12])

    def test_cable_is_pulled_out_and_plugged_in(self):
        self.start_line()
        self.start()
        for values in ([1, 2], [3, 4], [5, 6]):
            self.write_devices(values)
            self.expect("good", values)
            self.pull_out()
            self.expect("comm error", values)
            self.assertEqual(self.client.holding(100, 2), values)
            self.write_devices([value + 1 for value in values])
            self.plug_in()
            self.expect("good", [value + 1 for value in values])
        self.assertEqual(self.gateway.log.count("was lost"), 3)

    def test_port_comes_back_as_another_device_behind_the_same_path(self):
        self.start_line()
        self.start()
        self.expect("good")
        before = os.readlink(self.line)
        self.pull_out()
        self.expect("comm error")
        taken = []
        while not os.path.exists(before):  # until somebody else has the number
            taken += os.openpty()
        self.write_devices([7, 8])
        self.plug_in()
        self.assertNotEqual(os.readlink(self.line), before)
        self.expect("good", [7, 8])
        for each in taken:
            os.close(each)

    def test_write_while_the_cable_is_out_reaches_the_device_later(self):
        self.start_line()
        self.start()
        self.expect("good")
        self.pull_out()
        self.expect("comm error")
        self.client.write_register(120, 77)
        self.plug_in()
        wait_for("the setpoint in the device", lambda: self.two.holding(50) == [77])
        self.watch.expect("two.setpoint", quality="good", values=[77])


main()
