"""A serial client reaches stations of another line through a server line of the gateway."""

import struct
import time

from faulty_device import framed
from raw_client import RawClient
from support import PATIENCE, InteropTest, main, route, serial_line, station

TIMEOUT = 0.3


class SerialForwardingTest(InteropTest):
    def start(self):
        """A panel's line, where unit 5 is the PLC, 21 and 22 lead to devices of another line, and 23 to nobody there."""
        self.bus = self.start_bus(3)
        self.devices = [self.start_device(i, i, "--set", f"hr:50={i}") for i in (1, 2)]
        panel = self.folder / "panel"
        panel.mkdir()
        units = [{"unit": 5, "plc": "main", "channel": 1}, {"unit": 21, "line": "line", "line_unit": 1},
                 {"unit": 22, "line": "line", "line_unit": 2}, {"unit": 23, "line": "line", "line_unit": 9}]
        self.client = RawClient(FolderOf(self, panel))
        configuration = self.configuration(
            lines=[{"name": "panel", "device": str(panel / "line"), "parity": "none", "role": "server", "units": units},
                   serial_line(self.folder / "line", response_timeout_ms=int(TIMEOUT * 1000), retries=0)],
            stations=[station("one", 1)], routes=[route("one.low", "holding", 0, "D100", 2, period_ms=200)])
        self.gateway = self.start_gateway(configuration)
        self.watch = self.gateway.watch()
        self.watch.expect("one.low", quality="good")

    def test_stations_and_the_plc_answer_on_one_line(self):
        self.start()
        for turn in range(5):
            self.assertEqual(self.client.ask(21, bytes.fromhex("03 00 32 00 01")), b"\x03\x02\x00\x01")
            self.assertEqual(self.client.ask(22, bytes.fromhex("03 00 32 00 01")), b"\x03\x02\x00\x02")
            self.assertEqual(self.client.ask(5, bytes.fromhex("03 03 E8 00 01")), b"\x03\x02\x00\x00")
            write = struct.pack(">BHH", 6, 60, turn)
            self.assertEqual(self.client.ask(22, write), write)
            self.assertEqual(self.devices[1].door.holding(60), [turn])
        self.assertEqual(self.watch.latest("one.low")["quality"], "good")

    def test_what_the_station_or_nobody_says(self):
        self.start()
        self.assertEqual(self.client.ask(21, bytes.fromhex("03 EA 60 00 01")), b"\x83\x02")
        self.assertEqual(self.client.ask(23, bytes.fromhex("03 00 00 00 01")), b"\x83\x0b")
        self.assertEqual(self.client.ask(21, bytes.fromhex("03 00 00 00 00")), b"\x83\x03")  # no registers
        self.assertEqual(self.client.ask(24, bytes.fromhex("03 00 00 00 01"), 0.5), b"")  # not one of ours

    def test_a_client_that_asks_again_gets_no_answer_that_comes_late(self):
        self.start()
        self.client.send(framed(bytes([23]) + bytes.fromhex("03 00 00 00 01")))
        time.sleep(TIMEOUT / 3)
        self.assertEqual(self.client.ask(5, bytes.fromhex("03 03 E8 00 01")), b"\x03\x02\x00\x00")
        self.assertEqual(self.client.hear(2 * TIMEOUT), b"")
        self.assertEqual(self.client.ask(22, bytes.fromhex("03 00 32 00 01")), b"\x03\x02\x00\x02")

    def test_a_broadcast_reaches_the_plc_and_the_stations(self):
        self.start()
        self.client.send(framed(b"\x00" + struct.pack(">BHH", 6, 61, 0xBEEF)))
        self.assertEqual(self.client.hear(0.3), b"")
        deadline = time.monotonic() + PATIENCE
        while [d.door.holding(61) for d in self.devices] != [[0xBEEF]] * 2 and time.monotonic() < deadline:
            time.sleep(0.05)
        self.assertEqual([d.door.holding(61) for d in self.devices], [[0xBEEF]] * 2)
        self.assertEqual(self.gateway.client().holding(61), [0xBEEF])


class FolderOf:
    """A test, but with another folder."""

    def __init__(self, test, folder):
        self.folder = folder
        self.addCleanup = test.addCleanup


main()
