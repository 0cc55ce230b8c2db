"""Ports, devices and events of the built daemon: a device dies and comes back, a cable is pulled out, the address of an
interface changes."""

import json
import signal
import socket
import subprocess

from support import Client, InteropTest, Program, binary, main, route, serial_line, station, wait_for


class StatusTest(InteropTest):
    def setUp(self):
        self.line = self.folder / "line"
        self.doors = [self.free_port() for _ in range(2)]

    def start_line(self):
        devices = [f"--device={i + 1}::{door}" for i, door in enumerate(self.doors)]
        self.bus = Program(self, "field-line", [binary("FIELD_LINE"), "--link", self.line, *devices]).ready()

    def start(self, **more):
        self.gateway = self.start_gateway(self.configuration(
            lines=[serial_line(self.line, response_timeout_ms=200, retries=0)],
            stations=[station("one", 1), station("two", 2)],
            routes=[route("one.values", "holding", 0, "D100", 2, period_ms=100),
                    route("two.values", "holding", 0, "D110", 2, period_ms=100)], **more))
        self.watch = self.gateway.watch()

    def state(self, kind, name, **wanted):
        """Waits until the latest status of a port or device has these fields, and returns it."""
        def fitting():
            self.watch.read()
            latest = self.watch.states.get((kind, name), {})
            return latest if latest and all(latest[key] == value for key, value in wanted.items()) else None
        return wait_for(lambda: f"{kind} {name} with {wanted}: {self.watch.states.get((kind, name))}", fitting)

    def event(self, code, subject):
        def found():
            self.watch.read()
            return [each for each in self.watch.events if (each["code"], each["subject"]) == (code, subject)]
        return wait_for(lambda: f"{code} of {subject} among {self.watch.events}", found)

    def test_a_device_dies_and_comes_back(self):
        self.start_bus(2)
        device = self.start_device(1, 1)
        self.gateway = self.start_gateway(self.configuration(
            lines=[serial_line(self.line, response_timeout_ms=200, retries=0)], stations=[station("one", 1)],
            routes=[route("one.values", "holding", 0, "D100", 2, period_ms=100)]))
        self.watch = self.gateway.watch().connected()
        up = self.state("device", "one", state="up")
        self.assertEqual(up["port"], "line")
        self.assertGreater(up["last_ok_ns"], 0)
        counted = wait_for("counters move", lambda: [each for each in [self.state("device", "one")]
                                                     if each["requests"] > 5 and each["rtt_us"] and each["cycle_us"]])
        self.assertEqual([counted[0]["timeouts"], counted[0]["exceptions"]], [0, 0])
        self.assertGreater(counted[0]["cycle_us"], 50_000)

        device.kill()
        down = self.state("device", "one", state="down")
        self.assertIn("does not answer", down["detail"])
        self.assertGreater(down["timeouts"], 1)
        self.assertGreater(down["since_ns"], up["since_ns"])
        said = self.event("device.down", "one")[0]
        self.assertEqual([said["severity"], said["gateway"]], ["warning", up["gateway"]])
        self.assertIn("does not answer", said["text"])
        self.state("port", "line", state="up")

        self.start_device(1, 1)
        back = self.state("device", "one", state="up")
        self.assertGreater(back["since_ns"], down["since_ns"])
        self.assertEqual(len(self.event("device.up", "one")), 1)

    def test_a_cable_is_pulled_out_and_plugged_in(self):
        self.start_line()
        self.start()
        self.watch.connected()
        up = self.state("port", "line", state="up", reopens=0)
        moved = wait_for("frames are counted", lambda: [each for each in [self.state("port", "line")]
                                                        if each["rx_frames"] > 3])[0]
        self.assertGreater(moved["tx_frames"], 3)
        self.assertEqual(moved["tx_bytes"] % 8, 0)  # of every request
        self.assertGreaterEqual(moved["rx_bytes"], 9 * moved["rx_frames"])

        self.bus.signal(signal.SIGUSR1)
        down = self.state("port", "line", state="down")
        self.assertRegex(down["detail"], "was lost|cannot be opened")
        self.assertGreater(down["since_ns"], up["since_ns"])
        self.event("port.lost", "line")
        for name in ("one", "two"):
            self.assertIn("port absent", self.state("device", name, state="down")["detail"])

        self.bus.signal(signal.SIGUSR2)
        back = self.state("port", "line", state="up", reopens=1)
        self.assertGreater(back["since_ns"], down["since_ns"])
        for name in ("one", "two"):
            self.state("device", name, state="up")
        self.event("port.open", "line")

    def test_a_port_that_never_was_there_and_listeners(self):
        self.start()
        self.watch.connected()
        self.assertIn("cannot be opened", self.state("port", "line", state="down")["detail"])
        self.state("device", "one", state="down", requests=0)
        self.assertEqual(self.state("port", "dds", state="up")["errors"], 0)
        listener = f"modbus-tcp/127.0.0.1:{self.gateway.port}"
        before = self.state("port", listener, state="up")
        client = Client(self, self.gateway.port)
        for _ in range(10):
            client.holding(0, 1)
        after = wait_for("requests are counted", lambda: [each for each in [self.state("port", listener)]
                                                          if each["rx_frames"] >= before["rx_frames"] + 10])[0]
        self.assertEqual(after["tx_frames"] - before["tx_frames"], after["rx_frames"] - before["rx_frames"])
        self.assertEqual(after["rx_bytes"] - before["rx_bytes"], 12 * (after["rx_frames"] - before["rx_frames"]))
        with socket.create_connection(("127.0.0.1", self.gateway.port)) as nonsense:
            nonsense.sendall(b"GET / HTTP/1.1\r\n\r\n")
            wait_for("the error is counted", lambda: self.state("port", listener)["errors"] > 0)

    def test_watch_filters_and_exit_codes(self):
        self.start_line()
        self.start(dds={"blocks": [{"plc": "main", "device": "D90", "count": 30}]})
        site = self.gateway.dds
        where = ["--domain", site["domain"], "--interface", site["interface"], "--partition", site["partition"]]

        def watch(*options):
            command = [binary("PLC_GATEWAY"), "watch", "--json", *where, *options]
            return subprocess.run([str(each) for each in command], capture_output=True, text=True, timeout=60,
                                  check=False)
        ended = watch("--topic", "DeviceStatus", "-n", 2, "-t", 30, "one")
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertEqual({(e["event"], e.get("device")) for e in map(json.loads, ended.stdout.splitlines())},
                         {("device", "one")})
        ended = watch("--gateway", "nobody", "-t", 1)
        self.assertEqual([ended.returncode, ended.stdout], [1, ""])
        self.assertIn("a gateway is there", ended.stderr)
        ended = watch("--topic", "nonsense")
        self.assertEqual(ended.returncode, 2)
        ended = watch("--device", "nonsense")
        self.assertEqual(ended.returncode, 2)
        command = [binary("PLC_GATEWAY"), "watch", "--json", "-c", self.folder / "gateway.json", "--device",
                   "main.D101", "-n", 2, "-t", 30]
        ended = subprocess.run([str(each) for each in command], capture_output=True, text=True, timeout=60, check=False)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertEqual({e["route"] for e in map(json.loads, ended.stdout.splitlines()) if "route" in e},
                         {"one.values", "main.D90"})


main()
