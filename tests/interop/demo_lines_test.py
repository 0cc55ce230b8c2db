"""The demo's three lines together: MODBUS RTU devices, an FP7 and a scale, in one FX3U, on MODBUS TCP and on DDS."""

import json
import re
import signal
from pathlib import Path

from support import InteropTest, Program, binary, holds, main, mbpoll, wait_for

DEMO = Path(__file__).parents[2] / "etc" / "demo.json"
# Route or field: where the demo puts it in D, how many words, and which of them is never 0.
WORDS = {"pump.values": (100, 3, 2), "meter.values": (110, 8, 0), "tank.level": (120, 1, 0),
         "scale.state": (132, 1, 0), "press.values": (150, 6, 5)}
HOLDING = 4  # mbpoll's -t
SETPOINT, START = 11, 11  # D11, M11


class DemoLinesTest(InteropTest):
    def setUp(self):
        demo = json.loads(re.sub(r"^\s*//.*$", "", DEMO.read_text(), flags=re.MULTILINE)
                          .replace("/tmp/plc-gateway-demo", str(self.folder)))
        ours = self.configuration()
        demo["modbus_tcp"][0]["port"] = ours["modbus_tcp"][0]["port"]
        demo["dds"] |= ours["dds"]
        demo["control"] = ours["control"]
        del demo["$schema"]

        Program(self, "field-line", [binary("FIELD_LINE"), "--link", self.folder / "line1", "--device", "1:pump",
                                     "--device", "2:meter", "--device", "3:tank"]).ready()
        Program(self, "field-scale", [binary("FIELD_SCALE"), "--link", self.folder / "scale"]).ready()
        self.fp7 = self.start_fp7()
        self.gateway = self.start_gateway(demo)
        self.client = self.gateway.client()
        self.watch = self.gateway.watch()
        for name in WORDS:
            self.watch.expect(name, quality="good")

    def start_fp7(self):
        return Program(self, "field-fp7", [binary("FIELD_FP7"), "--link", self.folder / "fp7", "--trace"]).ready()

    def readings(self, name):
        """By DDS and by two MODBUS TCP clients."""
        first, count, _ = WORDS[name]
        return [self.watch.latest(name)["values"], self.client.holding(first, count),
                mbpoll(self.gateway.port, HOLDING, first, count)]

    def go_on(self, names):
        """Good samples of each of them keep coming."""
        before = {name: len(self.watch.of(name)) for name in names}
        for name in names:
            wait_for(f"more of {name}", lambda name=name: len(self.watch.of(name)) > before[name] + 1)
            since = self.watch.of(name)[before[name]:]
            self.assertEqual({sample["quality"] for sample in since}, {"good"}, name)

    def test_values_of_all_lines_are_in_memory_on_modbus_tcp_and_on_dds(self):
        for name, (_, _, never_0) in WORDS.items():
            with self.subTest(name):
                def same(name=name):
                    dds, pymodbus, by_mbpoll = self.readings(name)
                    return dds if dds == pymodbus == [each & 0xFFFF for each in by_mbpoll] else None
                values = wait_for(lambda name=name: f"one reading of {name}: {self.readings(name)}", same)
                self.assertGreater(values[never_0], 0)

    def test_the_press_does_what_modbus_tcp_clients_write(self):
        self.watch.expect("press.state", quality="good", values=[1, 0, 0])
        self.client.write_register(SETPOINT, 61)
        self.watch.expect("press.state", values=[0, 0, 1])
        self.client.write_register(SETPOINT, 60)
        self.watch.expect("press.state", values=[1, 0, 0])
        wait_for("a stroke", lambda: self.watch.latest("press.values")["values"][0] > 1_000_000 & 0xFFFF)
        self.client.write_coil(START, 1)
        self.watch.expect("press.start", quality="good", values=[1])
        self.client.write_coil(START, 0)
        self.watch.expect("press.state", values=[0, 1, 0])
        self.assertEqual(self.client.coils(20, 3), [0, 1, 0])

        low, high, cycle, force, peak, oil = self.watch.expect("press.values", quality="good")["values"]
        self.assertEqual((high, force), (1_000_000 >> 16, 0))
        self.assertGreater(low, 1_000_000 & 0xFFFF)  # strokes
        self.assertIn(cycle, range(50, 2000))
        self.assertIn(peak, range(2300, 2601))
        self.assertIn(oil, range(250, 651))
        for frame in ("%01#WDD00010000103D00", "%01#WDD00010000103C00", "%01#WCSR00101", "%01#WCSR00100"):
            self.assertIn(frame, self.fp7.log)

    def test_an_fp7_that_dies_takes_nobody_along_and_comes_back(self):
        self.fp7.kill()
        for name in ("press.values", "press.state"):
            self.watch.expect(name, quality="comm error")
        *_, last, lost = self.watch.of("press.values")
        self.assertEqual((last["quality"], lost["values"]), ("good", last["values"]))
        self.assertEqual(self.client.holding(150, 6), last["values"])
        self.go_on(["meter.values", "scale.weight"])
        self.assertEqual(self.watch.latest("press.values")["quality"], "comm error")

        self.fp7 = self.start_fp7()
        for name in ("press.values", "press.state"):
            self.watch.expect(name, quality="good")
        self.go_on(["meter.values", "scale.weight", "press.values"])

    def test_an_fp7_that_hangs_is_not_waited_for(self):
        self.fp7.signal(signal.SIGSTOP)
        self.addCleanup(self.fp7.signal, signal.SIGCONT)
        self.watch.expect("press.values", quality="comm error")
        self.go_on(["meter.values", "scale.weight"])
        holds("it stays down", lambda: self.watch.latest("press.values")["quality"] == "comm error", 0.5)
        self.fp7.signal(signal.SIGCONT)
        self.watch.expect("press.values", quality="good")


main()
