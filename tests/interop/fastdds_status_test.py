"""Ports, devices and events of the built daemon, as a foreign subscriber, on Fast DDS, gets them."""

import time

from fastdds import ERROR, INFO, STATE, WARNING, Subscriber
from support import InteropTest, main, route, serial_line, station, wait_for
from text_device import TextDevice

DEVICE = {"gateway": "interop", "device": "one"}
LINE = {"gateway": "interop", "port": "line"}
TEXT = {"gateway": "interop", "port": "text"}


class FastDdsStatusTest(InteropTest):
    def setUp(self):
        self.start_bus(2)
        self.device = self.start_device(1, 1, "--set", "hr:0=1")
        self.scale = TextDevice(self, "scale")
        self.gateway = self.start_gateway(self.configuration(
            lines=[serial_line(self.folder / "line", response_timeout_ms=300, retries=0),
                   {"name": "text", "device": str(self.scale.link), "protocol": "general-purpose", "parity": "none",
                    "general_purpose": {"end_code": "cr-lf", "received": [{"name": "heard", "plc": "main", "device": "D600",
                                                                            "count": 20}]}}],
            stations=[station("one", 1)],
            routes=[route("one.registers", "holding", 0, "D0", 2, period_ms=100),
                    route("one.beyond", "holding", 40000, "D10", 1, period_ms=500)]))
        self.fast = Subscriber(self, self.gateway.dds).connected()

    def now_ns(self, sample, field):
        self.assertLess(abs(time.time() - sample[field] / 1e9), 20, sample)

    def event(self, code, subject, **wanted):
        return wait_for(lambda: f"event {code} of {subject}: {self.fast.of('Event')}",
                        lambda: self.fast.of("Event", code=code, subject=subject, gateway="interop", **wanted))[-1]

    def test_a_device_that_lives_dies_and_comes_back(self):
        up = self.fast.expect("DeviceStatus", DEVICE, state=STATE["up"], port="line", timeouts=0)
        self.now_ns(up, "since_ns")
        wait_for("requests, exceptions, times", lambda: all(self.fast.latest("DeviceStatus", **DEVICE)[key] > 0 for key in
                                                            ("requests", "exceptions", "rtt_us", "cycle_us", "last_ok_ns")))
        self.device.kill()
        down = self.fast.expect("DeviceStatus", DEVICE, state=STATE["down"])
        self.assertGreater(down["since_ns"], up["since_ns"])
        self.assertGreaterEqual(down["timeouts"], 2)
        self.assertTrue(down["detail"])
        gone = self.event("device.down", "one")
        self.assertIn(gone["severity"], (WARNING, ERROR))
        self.assertTrue(gone["text"])
        self.now_ns(gone, "source_ns")

        self.device = self.start_device(1, 1)
        self.fast.expect("DeviceStatus", DEVICE, state=STATE["up"])
        self.event("device.up", "one", severity=INFO)
        events = [each["event_id"] for each in self.fast.of("Event")]
        self.assertEqual(events, sorted(set(events)))

    def test_ports(self):
        line = self.fast.expect("PortStatus", LINE, state=STATE["up"], errors=0)
        self.now_ns(line, "since_ns")
        wait_for("frames and bytes", lambda: all(self.fast.latest("PortStatus", **LINE)[key] > 0 for key in
                                                 ("rx_frames", "tx_frames", "rx_bytes", "tx_bytes")))
        self.fast.expect("PortStatus", {"gateway": "interop", "port": f"modbus-tcp/127.0.0.1:{self.gateway.port}"},
                         state=STATE["up"])
        self.fast.expect("PortStatus", {"gateway": "interop", "port": "dds"}, state=STATE["up"])

        self.fast.expect("PortStatus", TEXT, state=STATE["up"])
        self.scale.unplug()
        down = self.fast.expect("PortStatus", TEXT, state=STATE["down"])
        self.assertTrue(down["detail"])
        self.event("port.lost", "text")
        self.scale = TextDevice(self, "scale")
        self.fast.expect("PortStatus", TEXT, state=STATE["up"], reopens=1)
        self.event("port.open", "text")

    def test_a_late_joiner_gets_the_states_and_no_old_event(self):
        self.fast.expect("DeviceStatus", DEVICE, state=STATE["up"])
        self.device.kill()
        self.fast.expect("DeviceStatus", DEVICE, state=STATE["down"])
        self.event("device.down", "one")
        late = Subscriber(self, self.gateway.dds)
        late.expect("DeviceStatus", DEVICE, state=STATE["down"])
        late.expect("PortStatus", LINE, state=STATE["up"])
        late.connected()
        self.assertEqual(late.of("Event", code="device.down"), [])

    def test_every_state_topic_has_one_instance_for_each_thing(self):
        for port in ("line", "text", "dds"):
            self.fast.expect("PortStatus", {"port": port}, gateway="interop")
        self.fast.expect("DeviceStatus", DEVICE)
        self.assertEqual({each["device"] for each in self.fast.of("DeviceStatus")}, {"one"})
        self.assertEqual(len({each["port"] for each in self.fast.of("PortStatus")}), 4)


if __name__ == "__main__":
    main()
