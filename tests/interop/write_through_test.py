"""A MODBUS TCP client that writes to a write-through route hears what the device said."""

import time

from support import InteropTest, Refused, main, route, serial_line, station

TIMEOUT = 0.3


class WriteThroughTest(InteropTest):
    def start(self):
        self.bus = self.start_bus(2)
        self.device = self.start_device(1, 1)
        configuration = self.configuration(
            lines=[serial_line(self.folder / "line", response_timeout_ms=int(TIMEOUT * 1000), retries=0)],
            stations=[station("one", 1), station("nobody", 9)],
            routes=[route("one.setpoint", "holding", 50, "D100", 2, direction="write-through"),
                    route("one.missing", "holding", 60000, "D110", direction="write-through"),
                    route("one.back", "holding", 50, "D200", 2, period_ms=100),
                    route("nobody.setpoint", "holding", 0, "D120", direction="write-through", station="nobody")])
        self.gateway = self.start_gateway(configuration)
        self.gateway.watch().expect("one.back", quality="good")
        self.client = self.gateway.client()

    def refused(self, code, *what):
        with self.assertRaises(Refused) as raised:
            self.client.write_register(*what)
        self.assertEqual(raised.exception.code, code)

    def test_the_answer_comes_when_the_device_has_it(self):
        self.start()
        for turn in range(20):
            self.client.write_registers(100, [turn, turn + 1])
            self.assertEqual(self.device.door.holding(50, 2), [turn, turn + 1])
        self.client.write_register(101, 7)
        self.assertEqual(self.device.door.holding(50, 2), [19, 7])

    def test_what_the_device_refuses(self):
        self.start()
        self.refused(2, 110, 5)
        self.assertEqual(self.client.holding(110), [0])
        self.client.write_register(130, 5)  # no route: the PLC's own
        self.assertEqual(self.client.holding(130), [5])

    def test_a_device_that_does_not_answer(self):
        self.start()
        for _ in range(2):
            self.refused(0x0B, 120, 5)
        began = time.monotonic()
        self.refused(0x0B, 120, 5)
        self.assertLess(time.monotonic() - began, TIMEOUT)  # it is known to be down
        self.assertEqual(self.client.holding(120), [0])
        self.client.write_registers(100, [1, 2])
        self.assertEqual(self.device.door.holding(50, 2), [1, 2])


if __name__ == "__main__":
    main()
