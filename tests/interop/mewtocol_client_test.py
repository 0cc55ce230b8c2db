"""A MEWTOCOL-COM station on a line: routes, DDS samples and MODBUS TCP requests, and everything that goes wrong."""

import json
import time

from mewtocol_station import MewtocolStation
from support import InteropTest, Refused, main, station, wait_for


def mewtocol_line(device, **more):
    return {"name": "line", "device": str(device), "protocol": "mewtocol-com", "baud_rate": 115200, "parity": "odd",
            "response_timeout_ms": 300, "retries": 1, **more}


def source(name, first, device, count=1, **more):
    return {"name": name, "station": name.split(".")[0], "source": first, "count": count, "plc": "main",
            "device": device, "period_ms": 100, **more}


class MewtocolClientTest(InteropTest):
    def start(self, *routes, line=None, **simulated):
        self.fp7 = MewtocolStation(self.folder / "line", **simulated)
        self.addCleanup(lambda: self.assertEqual(self.fp7.wrong, []))
        self.addCleanup(self.fp7.end)
        self.fp7.start()
        configuration = self.configuration(lines=[mewtocol_line(self.folder / "line", **(line or {}))],
                                           stations=[station("fp", 7), station("all", 0)], routes=list(routes))
        configuration["modbus_tcp"][0]["units"] += [{"unit": 11, "line": "line", "line_unit": 7},
                                                    {"unit": 12, "line": "line", "line_unit": 8},
                                                    {"unit": 13, "line": "line", "line_unit": 100}]
        self.gateway = self.start_gateway(configuration)
        self.watch = self.gateway.watch()

    def refused(self, code, call, *arguments):
        with self.assertRaises(Refused) as raised:
            call(*arguments)
        self.assertEqual(raised.exception.code, code)

    def test_words_and_contacts_reach_memory_dds_and_modbus_tcp(self):
        self.start(source("fp.words", "DT100", "D100", 30), source("fp.relays", "R1F", "M100", 3),
                   source("fp.input", "X10", "M200"), source("fp.view", "WR1", "D200", 2))
        self.fp7.memory["WR", 1] = 0x8001
        self.fp7.memory["WR", 2] = 0x0002
        self.fp7.memory["WX", 1] = 0x0001
        sample = self.watch.expect("fp.words", quality="good", values=list(range(100, 130)))
        self.assertEqual((sample["area"], sample["first"]), ("DT", 100))
        sample = self.watch.expect("fp.relays", quality="good", values=[1, 0, 1])
        self.assertEqual((sample["area"], sample["first"]), ("R", 0x1F))
        self.watch.expect("fp.input", quality="good", values=[1])
        self.watch.expect("fp.view", quality="good", values=[0x8001, 2])
        client = self.gateway.client()
        self.assertEqual(client.holding(100, 30), list(range(100, 130)))
        self.assertEqual(client.coils(100, 3), [1, 0, 1])
        self.assertIn("RCSX0010", self.fp7.commands)
        self.assertIn("RDD0010000129", self.fp7.commands)

    def test_writes_to_one_station_and_to_all(self):
        self.start(source("fp.setpoint", "DT500", "D500", 2, direction="write"),
                   source("fp.outputs", "Y1D", "M500", 20, direction="write"),
                   source("all.clock", "DT600", "D600", direction="write"))
        client = self.gateway.client()
        client.write_registers(500, [0x1234, 0xABCD])
        client.write_coils(500, [1, 0, 0] + [1] * 16 + [1])
        client.write_register(600, 77)
        self.watch.expect("fp.setpoint", quality="good", values=[0x1234, 0xABCD])
        self.watch.expect("fp.outputs", quality="good", values=[1, 0, 0] + [1] * 16 + [1])
        self.watch.expect("all.clock", quality="good", values=[77])
        self.assertEqual([self.fp7.memory["D", n] for n in (500, 501, 600)], [0x1234, 0xABCD, 77])
        self.assertEqual([self.fp7.memory["WY", n] for n in (1, 2, 3)], [0x2000, 0xFFFF, 1])
        self.assertEqual(self.fp7.globals, ["WDD00600006004D00"])

    def test_a_long_block_is_cut(self):
        self.start(source("fp.long", "DT0", "D0", 1000, period_ms=300),
                   source("fp.out", "LD0", "D2000", 600, direction="write"))
        self.watch.expect("fp.long", quality="good", values=list(range(1000)))
        self.assertEqual([c for c in self.fp7.commands if c.startswith("RD")][:2], ["RDD0000000507", "RDD0050800999"])
        client = self.gateway.client()
        client.write_register(2599, 4711)
        self.watch.expect("fp.out", quality="good", values=[0] * 599 + [4711])
        self.assertEqual(self.fp7.memory["L", 599], 4711)
        self.assertEqual([c[:13] for c in self.fp7.commands if c.startswith("WDL")][:2],
                         ["WDL0000000505", "WDL0050600599"])

    def test_a_station_without_the_long_header(self):
        self.start(source("fp.long", "DT0", "D0", 100, period_ms=300), line={"mewtocol": {"expansion": False}},
                   longest=0)
        self.watch.expect("fp.long", quality="good", values=list(range(100)))

    def test_split_responses_are_collected(self):
        self.start(source("fp.words", "DT100", "D100", 25), split=17)
        self.watch.expect("fp.words", quality="good", values=list(range(100, 125)))
        self.assertIn("", self.fp7.commands)  # "go on"
        self.assertEqual(self.gateway.client(11).holding(0, 27), list(range(27)))

    def test_errors_are_the_quality_and_stand_in_the_log(self):
        self.start(source("fp.beyond", "DT20000", "D100"), source("fp.words", "DT5", "D200"))
        self.watch.expect("fp.beyond", quality="device error")
        self.watch.expect("fp.words", quality="good", values=[5])
        self.assertIn("refuses: error 61 (data), result 6", self.gateway.log)

    def test_a_silent_station_keeps_its_values_and_comes_back(self):
        self.start(source("fp.words", "DT100", "D100", 2))
        self.watch.expect("fp.words", quality="good", values=[100, 101])
        self.fp7.misbehave = lambda answer: []
        self.watch.expect("fp.words", quality="comm error", values=[100, 101])
        wait_for("the station is said to be down", lambda: ", result 5): its values are kept" in self.gateway.log)
        self.fp7.memory["D", 100] = 9
        self.fp7.misbehave = None
        self.watch.expect("fp.words", quality="good", values=[9, 101])

    def test_the_timeout_is_learned_and_the_turnaround_measured(self):
        self.start(source("fp.words", "DT100", "D100", 2),
                   line={"response_timeout_ms": 5000, "learn_timeout": True, "least_timeout_ms": 50})
        wait_for("enough answers", lambda: len(self.fp7.commands) > 12)
        unanswered = []

        def silent(_):
            unanswered.append(time.monotonic())
            return []
        self.fp7.misbehave = silent
        wait_for("the question and its repetition", lambda: len(unanswered) >= 2)
        self.assertLess(unanswered[1] - unanswered[0], 2.5)  # not the 5 s that are allowed
        self.gateway.stop()
        learned = json.loads((self.folder / "state" / "learned.json").read_text())
        turnaround = [each["turnaround_us"] for each in learned["stations"] if each["unit"] == 7]
        self.assertEqual(len(turnaround), 1)
        self.assertLess(turnaround[0], 1_000_000)

    def test_damage_is_no_value(self):
        self.start(source("fp.words", "DT100", "D100", 2))
        self.watch.expect("fp.words", quality="good", values=[100, 101])
        self.fp7.misbehave = lambda answer: [(0, answer.replace(b"6400", b"6500"))]  # the check code stays
        self.watch.expect("fp.words", quality="comm error", values=[100, 101])
        wait_for("result 6", lambda: ", result 6): its values are kept" in self.gateway.log)
        # Cut in pieces is no damage, nor is noise in front.
        self.fp7.misbehave = lambda answer: [(0, b"\x00~"), (0.01, answer[:5]), (0.03, answer[5:])]
        self.watch.expect("fp.words", quality="good", values=[100, 101])

    def test_a_late_answer_is_not_that_of_another_question(self):
        self.start(source("fp.low", "DT100", "D100", 2), source("fp.high", "DT900", "D110", 2))
        self.watch.expect("fp.low", quality="good", values=[100, 101])
        self.watch.expect("fp.high", quality="good", values=[900, 901])
        number = 0

        def now_and_then_late(answer):
            nonlocal number
            number += 1
            return [(0.45 if number % 4 == 0 else 0, answer)]
        self.fp7.misbehave = now_and_then_late
        time.sleep(4)
        for name, values in (("fp.low", [100, 101]), ("fp.high", [900, 901])):
            wrong = [s for s in self.watch.of(name) if s["values"] not in (values, [0, 0])]
            self.assertEqual(wrong, [])
            self.fp7.misbehave = None
            self.watch.expect(name, quality="good", values=values)

    def test_modbus_tcp_reaches_it_by_the_map_of_an_fp7(self):
        self.start(source("fp.words", "DT5", "D200"))
        self.watch.expect("fp.words", quality="good", values=[5])
        client = self.gateway.client(11)
        self.assertEqual(client.holding(100, 125), list(range(100, 225)))
        self.assertEqual(client.input(0x7D0 + 30, 2), [30, 31])
        client.write_register(200, 0x1234)
        client.write_registers(201, [1, 2, 3])
        self.assertEqual(client.holding(199, 6), [199, 0x1234, 1, 2, 3, 204])
        client.write_coil(0x800 + 0x1F, 1)
        client.write_coils(0x820, [1, 0, 1])
        self.assertEqual(client.coils(0x81E, 6), [0, 1, 1, 0, 1, 0])
        self.assertEqual((self.fp7.memory["WR", 1], self.fp7.memory["WR", 2]), (0x8000, 5))
        client.write_coil(3, 1)
        self.assertEqual(self.fp7.memory["WY", 0], 8)
        self.fp7.memory["WX", 0] = 0b101
        self.assertEqual(client.discrete(0, 3), [1, 0, 1])
        answer = client.do(client.modbus.readwrite_registers(read_address=30, read_count=2, write_address=31,
                                                             write_registers=[9], unit=11))
        self.assertEqual(answer.registers, [30, 9])

    def test_modbus_tcp_hears_what_is_wrong(self):
        self.start(source("fp.words", "DT5", "D200"))
        self.watch.expect("fp.words", quality="good", values=[5])
        client = self.gateway.client(11)
        self.refused(2, client.input, 0x400)         # not in the map
        self.refused(2, client.holding, 9999, 2)     # 61: beyond this PLC
        self.refused(1, client.do, client.modbus.mask_write_register(address=1, unit=11))
        self.refused(0x0B, self.gateway.client(12).holding, 0)  # nobody
        self.refused(0x0A, self.gateway.client(13).holding, 0)  # no MEWTOCOL-COM station has that number
        for code, exception in (("65", 4), ("53", 6), ("42", 1)):
            self.fp7.refuse = code
            self.refused(exception, client.holding, 0)
        self.fp7.refuse = None
        self.assertEqual(client.holding(0, 2), [0, 1])


class OwnServerTest(InteropTest):
    """Client line and server line of one gateway, joined by a bus: an FX3U and an FP7."""

    def start(self, protocol, number):
        self.start_bus(2)
        port = {"protocol": protocol, "baud_rate": 115200, "parity": "none"}
        configuration = self.configuration(
            lines=[{**port, "name": "line", "device": str(self.folder / "line"), "response_timeout_ms": 1000},
                   {**port, "name": "panel", "device": str(self.folder / "line.1"), "role": "server",
                    "units": [{"unit": number, "plc": "fp7", "channel": 1}]}],
            stations=[station("fp", number)],
            routes=[source("fp.words", "DT100", "D100", 600, period_ms=300), source("fp.relays", "R1E", "M100", 4),
                    source("fp.setpoint", "LD5", "D900", 2, direction="write"),
                    source("fp.contacts", "R50", "M200", 16, direction="write")])
        configuration["plcs"].append({"name": "fp7", "model": "FP7"})
        configuration["modbus_tcp"][0]["units"] += [{"unit": 2, "plc": "fp7"},
                                                    {"unit": 3, "line": "line", "line_unit": number}]
        self.gateway = self.start_gateway(configuration)
        self.watch = self.gateway.watch()

    def check(self):
        fp7, forwarded, fx3u = self.gateway.client(2), self.gateway.client(3), self.gateway.client(1)
        fp7.write_registers(100, [7, 8])
        fp7.write_register(699, 9)
        fp7.write_coils(0x800 + 0x1E, [1, 0, 1, 1])
        self.watch.expect("fp.words", quality="good", values=[7, 8] + [0] * 597 + [9])
        self.watch.expect("fp.relays", quality="good", values=[1, 0, 1, 1])
        fx3u.write_registers(900, [0x1234, 0xABCD])
        fx3u.write_coils(200, [1, 0] * 8)
        self.watch.expect("fp.setpoint", quality="good", values=[0x1234, 0xABCD])
        self.watch.expect("fp.contacts", quality="good", values=[1, 0] * 8)
        self.assertEqual(fp7.input(0x7D0 + 5, 2), [0x1234, 0xABCD])
        self.assertEqual(fp7.coils(0x850, 16), [1, 0] * 8)
        forwarded.write_registers(800, list(range(120)))
        self.assertEqual(fp7.holding(800, 120), list(range(120)))
        self.assertEqual(forwarded.holding(800, 120), list(range(120)))
        self.assertEqual(forwarded.coils(0x81E, 4), [1, 0, 1, 1])
        return forwarded, fp7

    def test_mewtocol_com(self):
        self.start("mewtocol-com", 99)
        forwarded, fp7 = self.check()
        forwarded.write_coil(0x860, 1)
        self.assertEqual(fp7.coils(0x860), [1])

    def test_mewtocol7_com(self):
        self.start("mewtocol7-com", 500)
        forwarded, _ = self.check()
        with self.assertRaises(Refused) as raised:
            forwarded.write_coil(0x860, 1)  # only whole words
        self.assertEqual(raised.exception.code, 2)


main()
