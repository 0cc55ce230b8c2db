"""Writes with answers: by DDS and by the control socket, to devices that obey, refuse and are silent."""

import json
import os
import socket
import subprocess
from concurrent.futures import ThreadPoolExecutor

from faulty_device import FaultyDevice
from mewtocol_station import MewtocolStation
from support import PATIENCE, InteropTest, binary, main, route, serial_line, station, wait_for
from text_device import TextDevice

TIMEOUT = 300  # ms that the gateway waits for a device


class SlowDevice(FaultyDevice):
    """Takes its time to obey writes of one register."""

    def answer(self, request):
        return request  # function 06 is echoed


class WritesTest(InteropTest):
    def start(self, *, dds=None, device=True, **more):
        if device:
            self.start_bus(2)
            self.device = self.start_device(1, 1)
        default = {
            "lines": [serial_line(self.folder / "line", response_timeout_ms=TIMEOUT, retries=0)],
            "stations": [station("one", 1), station("nobody", 9)],
            "routes": [route("one.set", "holding", 50, "D100", 4, direction="write"),
                       route("one.missing", "holding", 60000, "D110", direction="write"),
                       route("one.coils", "coil", 0, "M100", 20, direction="write"),
                       route("one.back", "holding", 50, "D200", 4, period_ms=500),
                       route("nobody.set", "holding", 0, "D120", direction="write", station="nobody")],
            "points": [{"name": "speed", "plc": "main", "device": "D102", "type": "float", "writable": True, "min": 0,
                        "max": 100},
                       {"name": "shown", "plc": "main", "device": "D200", "type": "int16"}]}
        self.gateway = self.start_gateway(self.configuration(
            dds={"writes": True, "domain": 10 + os.getpid() % 20, "blocks": [
                {"plc": "main", "device": "D300", "count": 4, "writable": True},
                {"plc": "main", "device": "D310", "count": 4}], **(dds or {})}, **{**default, **more}))

    def run_command(self, *words):
        """Its exit status and the object that it printed."""
        done = subprocess.run([binary("PLC_GATEWAY"), words[0], "--json", *[str(w) for w in words[1:]]], text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              timeout=PATIENCE * 3, check=False)
        self.assertNotIn("Sanitizer", done.stderr)
        self.assertTrue(done.stdout, done.stderr)
        return done.returncode, json.loads(done.stdout)

    def dds(self, command, *words, gateway="interop", wait=PATIENCE * 1000):
        d = self.gateway.dds
        return self.run_command(command, "--dds", "-d", d["domain"], "-i", "lo", "--partition", d["partition"],
                                "-g", gateway, "-t", wait, *words)

    def local(self, command, *words):
        return self.run_command(command, "--socket", self.control_socket, *words)

    def expect(self, answer, status, result, *parts, code=0):
        self.assertEqual([answer[0], answer[1].get("result"), answer[1].get("device_code")], [status, result, code],
                         answer[1])
        for part in parts:
            self.assertIn(part, answer[1]["detail"])

    def test_readings_that_cannot_be(self):
        """Nothing is made up, and no number in a command makes the gateway allocate gigabytes."""
        self.start()
        self.expect(self.local("read", "line#0/holding:1"), 1, "REJECTED", "unit 0 is all stations")
        for command in ({"command": "write", "target": "main:D300", "values": ["a", "b"]},
                        {"command": "read", "target": "main:D300", "count": 1 << 30},
                        {"command": "read", "target": "one/holding:50", "count": 2}):
            with socket.socket(socket.AF_UNIX) as asking:
                asking.settimeout(PATIENCE)
                asking.connect(str(self.control_socket))
                asking.sendall(json.dumps({**command, "type": "text", "characters": 0xFFFFFFFF}).encode() + b"\n")
                self.assertEqual(json.loads(asking.makefile().readline())["result"], "REJECTED")

    def test_what_a_device_takes_and_refuses_by_dds(self):
        self.start()
        before = self.device.answers()
        self.expect(self.dds("write", "one.set/holding:51", 7, 8), 0, "OK", "the station has it")
        self.assertEqual(self.device.door.holding(50, 4), [0, 7, 8, 0])
        self.assertGreater(self.device.answers(), before)
        self.expect(self.dds("write", "one.coils/coil:17", 1, 0, 1), 0, "OK")
        self.assertEqual(self.device.door.coils(16, 4), [0, 1, 0, 1])
        self.expect(self.dds("write", "speed", 12.5), 0, "OK", "the station has it")
        self.assertEqual(self.device.door.holding(52, 2), [0x4148, 0])
        self.expect(self.dds("write", "speed", 101), 1, "REJECTED", "outside the limits")
        self.expect(self.dds("write", "one.missing/holding:60000", 5), 1, "DEVICE_ERROR", "exception 02", code=2)
        self.expect(self.dds("write", "main.D300/D:301", 5, 6), 0, "OK", "no route takes it to a station")
        self.assertEqual(self.gateway.client().holding(300, 4), [0, 5, 6, 0])

        self.expect(self.dds("write", "main.D310/D:310", 5), 1, "REJECTED", "writable")
        self.expect(self.dds("write", "one.back/holding:50", 5), 1, "REJECTED", "read-only: direction write")
        self.expect(self.dds("write", "shown", 5), 1, "REJECTED", "writable")
        self.expect(self.dds("write", "one.set/holding:53", 5, 6), 1, "REJECTED", "holding 50-53")
        self.expect(self.dds("write", "one.set/coil:50", 1), 1, "REJECTED", "has area")
        self.expect(self.dds("write", "other/holding:50", 1), 1, "NOT_FOUND", "other")
        self.expect(self.dds("write", "no.such.point", 1), 1, "NOT_FOUND", "no.such.point")
        self.assertEqual(self.dds("write", "speed", 1, gateway="elsewhere", wait=300)[0], 3)

    def test_a_device_that_does_not_answer(self):
        self.start()
        for _ in range(3):
            self.expect(self.dds("write", "nobody.set/holding:0", 5), 3, "TIMEOUT", "is not known", "goes on trying")
        wait_for("it is known to be down",
                 lambda: "known to be down" in self.local("write", "main:D120", 6)[1]["detail"])
        self.expect(self.dds("write", "one.set/holding:50", 9), 0, "OK")

    def test_an_order_that_cannot_begin_in_time_has_no_effect(self):
        line = TextDevice(self)  # nobody answers: each question keeps the line for long
        self.start(device=False, lines=[serial_line(self.folder / "line", response_timeout_ms=10_000, retries=0)],
                   stations=[station("one", 1), station("two", 2)], points=[],
                   routes=[route("one.set", "holding", 50, "D100", direction="write"),
                           route("two.set", "holding", 0, "D110", direction="write")])
        slow = subprocess.Popen([binary("PLC_GATEWAY"), "write", "main:D110", "5", "--socket", self.control_socket],
                                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(slow.kill)
        self.assertEqual(line.hear(b"\x00\x05", PATIENCE)[:2], b"\x02\x06")  # the line is busy from now on
        self.expect(self.local("write", "main:D100", 7, "-t", 100), 1, "EXPIRED", "nothing was written")
        self.expect(self.local("write", "one/holding:50", 7, "-t", 100), 1, "EXPIRED")
        self.assertEqual(self.gateway.client().holding(100), [0])
        self.assertIsNone(slow.poll(), "the machine was too slow for this test")
        self.assertEqual(slow.wait(), 3)
        then = line.hear(b"\x02\x06", PATIENCE)  # its route goes on trying
        self.assertNotIn(b"\x01\x06", then)
        self.assertEqual(self.gateway.client().holding(100), [0])

    def test_many_clients_each_executed_once(self):
        self.start(routes=[route("one.set", "holding", 50, "D100", 4, direction="write-through")])
        self.assertEqual(self.device.answers(), 0)  # nothing is polled: each answer is a write
        with ThreadPoolExecutor(4) as pool:
            answers = list(pool.map(lambda n: self.dds("write", "one.set/holding:50", n), range(1, 9)))
        for each in answers:
            self.expect(each, 0, "OK")
        # The commands repeat their requests every 100 ms; requests that wait together are one question.
        self.assertLessEqual(self.device.answers(), 8)
        self.assertGreaterEqual(self.device.answers(), 1)
        self.assertIn(self.device.door.holding(50)[0], range(1, 9))

    def test_a_repeated_request_is_executed_once(self):
        device = SlowDevice(self.folder / "line")
        device.misbehave = lambda good: [(0.7, good)]  # meanwhile the command repeats its request, every 100 ms
        self.addCleanup(device.end)
        device.start()
        self.start(device=False, lines=[serial_line(self.folder / "line", response_timeout_ms=10_000, retries=0)],
                   stations=[station("one", 1)], points=[],
                   routes=[route("one.set", "holding", 50, "D100", direction="write")])

        def ask(number, value):
            return self.dds("write", "one.set/holding:50", value, "--client", "panel", "--request", number)
        self.expect(ask(1, 5), 0, "OK", "the station has it")
        self.assertEqual(device.asked, 1)
        self.expect(ask(1, 6), 0, "OK", "the station has it")  # the reply of the first
        self.assertEqual([device.asked, self.gateway.client().holding(100)], [1, [5]])
        with ThreadPoolExecutor(3) as pool:
            for each in pool.map(lambda _: ask(2, 7), range(3)):
                self.expect(each, 0, "OK")
        self.assertEqual([device.asked, self.gateway.client().holding(100)], [2, [7]])

    def test_denied_unless_the_configuration_allows_it(self):
        self.start(dds={"writes": False})
        self.expect(self.dds("write", "one.set/holding:50", 1), 1, "DENIED", "dds/writes")
        self.expect(self.dds("write", "speed", 1), 1, "DENIED")
        self.assertEqual(self.device.door.holding(50), [0])
        self.expect(self.local("write", "speed", 1), 0, "OK")  # the socket has rights of its own

    def test_the_control_socket(self):
        self.start()
        self.expect(self.local("write", "main:D101", "--", "-2", "0x10"), 0, "OK", "the station has it")
        self.assertEqual(self.device.door.holding(51, 2), [65534, 16])
        self.expect(self.local("write", "main:M101", 1, "off", "true"), 0, "OK")
        self.assertEqual(self.device.door.coils(100 - 100, 5), [0, 1, 0, 1, 0])
        self.expect(self.local("write", "one/holding:70", 1.5, 2.5, "--type", "float", "--order", "CDAB"), 0, "OK")
        self.assertEqual(self.device.door.holding(70, 4), [0, 0x3FC0, 0, 0x4020])
        status, reply = self.local("read", "one/holding:70", "-n", 2, "--type", "float", "--order", "CDAB")
        self.assertEqual([status, reply["values"]], [0, [{"name": "holding:70", "value": 1.5},
                                                         {"name": "holding:72", "value": 2.5}]])
        status, reply = self.local("read", "line#1/holding:71")
        self.assertEqual([status, reply["values"]], [0, [{"name": "holding:71", "value": 0x3FC0}]])
        status, reply = self.local("read", "main:M101", "-n", 3)
        self.assertEqual([v["value"] for v in reply["values"]], [1, 0, 1])
        status, reply = self.local("read", "speed")
        self.assertEqual([status, reply["values"][0]["name"]], [0, "speed"])
        self.expect(self.local("write", "one/coil:3", 1), 0, "OK")
        self.assertEqual(self.device.door.coils(3), [1])
        self.expect(self.local("write", "one/input:3", 1), 1, "REJECTED", "read-only")
        self.expect(self.local("write", "one/holding:60000", 1), 1, "DEVICE_ERROR", "exception 02", code=2)
        self.expect(self.local("read", "one/holding:60000"), 1, "DEVICE_ERROR", code=2)
        self.expect(self.local("read", "line#99/holding:0"), 3, "TIMEOUT")
        self.expect(self.local("write", "main:D999999", 1), 1, "NOT_FOUND")
        self.expect(self.local("write", "main:D100", 70000), 1, "REJECTED", "does not fit")
        self.expect(self.local("write", "nowhere/holding:0", 1), 1, "NOT_FOUND", "line#unit")
        self.expect(self.local("write", "speed", "fast"), 1, "REJECTED", "is a number")
        self.expect(self.local("write", "main:D200", 1), 0, "OK", "replaces it")
        missing = self.run_command("write", "--socket", self.folder / "none", "speed", 1)
        self.assertEqual([missing[0], missing[1]["ok"]], [3, False])
        self.assertEqual(self.plc_command("list")[0], 0)  # the other commands go on

    def text_line(self, **general_purpose):
        return {"name": "text", "device": str(self.folder / "line"), "protocol": "general-purpose", "parity": "none",
                "general_purpose": {"received": [{"name": "all", "plc": "main", "device": "D400", "count": 20}],
                                    **general_purpose}}

    def test_messages_to_a_general_purpose_line(self):
        device = TextDevice(self)
        self.start(device=False, lines=[self.text_line(dds_sends=True)], stations=[], routes=[], points=[])
        watch = self.gateway.watch().connected()
        self.expect(self.dds("send", "text", "W\\x02<ETX>!"), 0, "OK", "on the line")
        self.assertEqual(device.hear(b"\r"), b"W\x02\x03!\r")
        wait_for("the message by DDS", lambda: [m for m in watch.messages("text") if m["way"] == "sent"])
        self.expect(self.local("send", "text", "T"), 0, "OK")
        self.assertEqual(device.hear(b"\r"), b"T\r")
        self.expect(self.dds("send", "other", "T"), 1, "NOT_FOUND")
        self.expect(self.local("send", "text", "x" * 4096), 1, "REJECTED", "4096")  # the end code needs room
        device.unplug()
        wait_for("the line is lost", lambda: self.local("send", "text", "T")[1]["result"] == "TIMEOUT")

    def test_messages_are_opt_in(self):
        TextDevice(self)
        self.start(device=False, lines=[self.text_line()], stations=[], routes=[], points=[])
        self.expect(self.dds("send", "text", "T"), 1, "DENIED", "dds_sends")

    def test_a_mewtocol_station(self):
        fp7 = MewtocolStation(self.folder / "line")
        self.addCleanup(fp7.end)
        fp7.start()
        line = {"name": "line", "device": str(self.folder / "line"), "protocol": "mewtocol-com", "baud_rate": 115200,
                "parity": "odd", "response_timeout_ms": 1000, "retries": 1}
        source = {"station": "fp", "plc": "main", "direction": "write"}
        self.start(device=False, lines=[line], stations=[station("fp", 7)], points=[], routes=[
            {"name": "fp.set", "source": "DT500", "count": 4, "device": "D500", **source},
            {"name": "fp.relays", "source": "R1F", "count": 2, "device": "M500", **source}])
        self.expect(self.dds("write", "fp.set/DT:501", 7, 8), 0, "OK", "the station has it")
        self.assertEqual(len([c for c in fp7.commands if c.startswith("WDD")]), 1)
        self.expect(self.dds("write", "fp.relays/R:31", 1, 1), 0, "OK")
        self.expect(self.local("write", "fp/DT700", 99), 0, "OK")
        status, reply = self.local("read", "fp/DT700", "-n", 2)
        self.assertEqual([status, reply["values"][0]], [0, {"name": "DT700", "value": 99}])
        fp7.refuse = "61"
        self.expect(self.dds("write", "fp.set/DT:500", 1), 1, "DEVICE_ERROR", "refuses", code=0x61)


if __name__ == "__main__":
    main()
