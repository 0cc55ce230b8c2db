"""A MEWTOCOL7-COM station on a line, both ends another program: a station of the tests, and a second gateway."""

import os
import time

from mewtocol7_station import Mewtocol7Station, crc
from support import InteropTest, Refused, main, station, wait_for

# Each reading of what is not published is another one.
OTHER = {"item": "W01", "scope": "", "address_digits": 6, "count_digits": 4, "base": "hexadecimal",
         "words": "high-byte-first", "before_words": "01", "before_error": "00", "before_piece": "P",
         "dt": "D", "ld": "LR", "wx": "X", "wy": "Y", "wr": "R", "wl": "LI"}


def reading_of(dialect):
    """The same for the station of the tests."""
    return {"item": dialect["item"], "scope": dialect["scope"], "address_digits": dialect["address_digits"],
            "count_digits": dialect["count_digits"], "base": 16, "high_byte_first": True,
            "before_words": dialect["before_words"], "before_error": dialect["before_error"],
            "before_piece": dialect["before_piece"],
            "names": {area.upper(): dialect[area] for area in ("dt", "ld", "wx", "wy", "wr", "wl")}}


def line(device, **more):
    return {"name": "line", "device": str(device), "protocol": "mewtocol7-com", "baud_rate": 115200, "parity": "odd",
            "response_timeout_ms": 300, "retries": 1, **more}


def source(name, first, device, count=1, **more):
    return {"name": name, "station": "fp", "source": first, "count": count, "plc": "main", "device": device,
            "period_ms": 100, **more}


class StationTest(InteropTest):
    """Station 500 is a script of the tests."""

    def start(self, *routes, dialect=None, **simulated):
        self.fp7 = Mewtocol7Station(self.folder / "line", reading=reading_of(dialect) if dialect else None, **simulated)
        self.addCleanup(lambda: self.assertEqual(self.fp7.wrong, []))
        self.addCleanup(self.fp7.end)
        self.fp7.start()
        more = {"mewtocol": {"dialect": dialect}} if dialect else {}
        configuration = self.configuration(lines=[line(self.folder / "line", **more)], stations=[station("fp", 500)],
                                           routes=list(routes))
        configuration["modbus_tcp"][0]["units"] += [{"unit": 11, "line": "line", "line_unit": 500},
                                                    {"unit": 12, "line": "line", "line_unit": 501}]
        self.gateway = self.start_gateway(configuration)
        self.watch = self.gateway.watch()

    def expect_good(self):
        """It is answered before something goes wrong, and the values are those of DT100 and DT101."""
        self.watch.expect("words", quality="good", values=[100, 101])

    def test_reads_and_writes(self):
        self.read_and_write()
        self.assertEqual(self.fp7.commands[0][:6], "00MMRD")
        self.assertIn("00MMRDD001G0DT0000010000030", self.fp7.commands)
        self.assertIn("00MMWTD001G0DT00000500000023412CDAB", self.fp7.commands)

    def test_reads_and_writes_in_another_dialect(self):
        self.read_and_write(dialect=OTHER)
        self.assertIn("00MMRDW01D000064001E", self.fp7.commands)
        self.assertIn("00MMWTW01D0001F400021234ABCD", self.fp7.commands)

    def read_and_write(self, **more):
        self.start(source("words", "DT100", "D100", 30), source("relays", "R1F", "M100", 3),
                   source("input", "X10", "M200"), source("view", "WL1", "D200", 2), source("link", "LD9", "D210"),
                   source("setpoint", "DT500", "D500", 2, direction="write"),
                   source("outputs", "Y10", "M500", 32, direction="write"), **more)
        self.fp7.memory["WR", 1], self.fp7.memory["WR", 2], self.fp7.memory["WX", 1] = 0x8001, 2, 1
        self.fp7.memory["WL", 1], self.fp7.memory["WL", 2] = 0x8001, 2
        for name, values in (("words", list(range(100, 130))), ("relays", [1, 0, 1]), ("input", [1]),
                             ("view", [0x8001, 2]), ("link", [9])):
            self.watch.expect(name, quality="good", values=values)
        client = self.gateway.client()
        self.assertEqual((client.holding(100, 30), client.coils(100, 3)), (list(range(100, 130)), [1, 0, 1]))
        client.write_registers(500, [0x1234, 0xABCD])
        client.write_coils(500, [1, 0, 0] + [1] * 29)
        self.watch.expect("setpoint", quality="good", values=[0x1234, 0xABCD])
        self.watch.expect("outputs", quality="good", values=[1, 0, 0] + [1] * 29)
        self.assertEqual([self.fp7.memory["DT", n] for n in (500, 501)], [0x1234, 0xABCD])
        self.assertEqual([self.fp7.memory["WY", n] for n in (1, 2)], [0xFFF9, 0xFFFF])
        # As MODBUS TCP clients reach it.
        client = self.gateway.client(11)
        self.assertEqual(client.holding(100, 125), list(range(100, 225)))
        client.write_registers(200, [7, 8])
        self.assertEqual((client.holding(199, 4), client.input(0x7D0 + 5)), ([199, 7, 8, 202], [5]))
        self.fp7.refuse = "65"
        self.refused(4, client.holding, 0)

    def test_frame_numbers_follow_each_other_and_wrap(self):
        self.start(source("words", "DT100", "D100", 2, period_ms=10))
        wait_for("frame 255", lambda: self.fp7.numbers[-1:] == [255] or len(self.fp7.numbers) > 256)
        wait_for("frame 3 behind it", lambda: len(self.fp7.numbers) > 259)
        numbers = self.fp7.numbers[:260]
        self.assertEqual(numbers, [(numbers[0] + i) % 256 for i in range(260)])

    def test_answers_in_several_frames(self):
        # 1020 words: the longest frame has room for 1019. The others are cut inside of words.
        for dialect, split, count in ((None, None, 1020), (None, 50, 200), (OTHER, 37, 100)):
            with self.subTest(split=split, dialect=dialect):
                self.start(source("words", "DT0", "D0", count, period_ms=500), split=split, dialect=dialect)
                self.watch.expect("words", quality="good", values=list(range(count)))
                self.assertIn("", self.fp7.commands)  # "go on"
                self.assertNotIn("refuses", self.gateway.log)
                self.doCleanups()
                self.programs.clear()

    def test_a_long_write_is_cut(self):
        self.start(source("words", "DT0", "D0", 1020, direction="write"))
        self.gateway.client().write_register(1019, 4711)
        self.watch.expect("words", quality="good", values=[0] * 1019 + [4711])
        self.assertEqual([c[:27] for c in self.fp7.commands[:2]], ["00MMWTD001G0DT0000000001014",
                                                                  "00MMWTD001G0DT0000101400006"])
        self.assertEqual((self.fp7.memory["DT", 1019], self.fp7.memory["DT", 0]), (4711, 0))

    def test_error_codes(self):
        self.start(source("beyond", "DT20000", "D100"), source("words", "DT100", "D200", 2))
        self.watch.expect("beyond", quality="device error")
        self.expect_good()
        self.assertIn("refuses: error 61 (data), result 6", self.gateway.log)
        client = self.gateway.client(11)
        for code, exception in (("41", 4), ("42", 1), ("53", 6), ("60", 2), ("61", 2), ("65", 4), ("97", 4)):
            self.fp7.refuse = code
            self.refused(exception, client.holding, 0)
        self.fp7.refuse = None
        self.refused(0x0B, self.gateway.client(12).holding, 0)  # station 501: nobody
        self.assertEqual(client.holding(0, 2), [0, 1])

    def refused(self, code, call, *arguments):
        with self.assertRaises(Refused) as raised:
            call(*arguments)
        self.assertEqual(raised.exception.code, code)

    def test_silence_keeps_the_values(self):
        self.start(source("words", "DT100", "D100", 2))
        self.expect_good()
        self.fp7.misbehave = lambda answer: []
        self.watch.expect("words", quality="comm error", values=[100, 101])
        wait_for("result 5", lambda: ", result 5): its values are kept" in self.gateway.log)
        self.fp7.memory["DT", 100] = 9
        self.fp7.misbehave = None
        self.watch.expect("words", quality="good", values=[9, 101])

    def test_damage_is_no_value(self):
        self.start(source("words", "DT100", "D100", 2))
        self.expect_good()
        self.fp7.misbehave = lambda answer: [(0, answer.replace(b"6400", b"6500"))]  # the CRC stays
        self.watch.expect("words", quality="comm error", values=[100, 101])
        wait_for("result 6", lambda: ", result 6): its values are kept" in self.gateway.log)
        # Pieces are no damage, nor is noise in front.
        self.fp7.misbehave = lambda answer: [(0, b"\x00~"), (0.01, answer[:5]), (0.03, answer[5:])]
        self.expect_good()

    def test_what_is_not_the_answer_is_not_believed(self):
        """Frames with a right CRC that belong to another question, another station, or nothing at all."""
        def other(change):
            def instead(answer):
                text = change(answer[:-5].decode())
                return [(0, (text + crc(text) + "\r").encode())]
            return instead
        self.start(source("words", "DT100", "D100", 2))
        wrong = {"frame number": lambda t: f"{t[:5]}{(int(t[5:7], 16) + 1) % 256:02X}$00MMRDAAAABBBB",
                 "late frame number": lambda t: f"{t[:5]}{(int(t[5:7], 16) - 1) % 256:02X}$00MMRDAAAABBBB",
                 "station": lambda t: f">@501{t[5:7]}$00MMRDAAAABBBB",
                 "command": lambda t: t[:7] + "$00MMWT",
                 "length": lambda t: t + "0000",
                 "digits": lambda t: t[:-4] + "00GG",
                 "mark": lambda t: t[:7] + "#00MMRDAAAABBBB",
                 "header": lambda t: "<" + t[1:]}
        for what, change in wrong.items():
            with self.subTest(what):
                self.fp7.misbehave = None
                self.expect_good()
                self.fp7.misbehave = other(change)
                self.watch.expect("words", quality="comm error", values=[100, 101])

    def test_a_late_answer_is_not_that_of_another_question(self):
        self.start(source("low", "DT100", "D100", 2), source("high", "DT900", "D110", 2))
        self.watch.expect("low", quality="good", values=[100, 101])
        self.watch.expect("high", quality="good", values=[900, 901])
        asked = 0

        def now_and_then_late(answer):
            nonlocal asked
            asked += 1
            return [(0.45 if asked % 4 == 0 else 0, answer)]
        self.fp7.misbehave = now_and_then_late
        time.sleep(4)
        self.fp7.misbehave = None
        for name, values in (("low", [100, 101]), ("high", [900, 901])):
            self.assertEqual([s for s in self.watch.of(name) if s["values"] not in (values, [0, 0])], [])
            self.watch.expect(name, quality="good", values=values)


class OtherGatewayTest(InteropTest):
    """Station 999 is an FP7 of a second gateway on the other end of a line."""

    def start(self, **mewtocol):
        self.start_bus(2)
        more = {"mewtocol": mewtocol} if mewtocol else {}
        far = self.configuration(units=("fp7",), lines=[{
            "name": "panel", "device": str(self.folder / "line.1"), "protocol": "mewtocol7-com", "role": "server",
            "baud_rate": 115200, "parity": "odd", "units": [{"unit": 999, "plc": "fp7", "channel": 1}], **more}])
        far["gateway"] = "far"
        far["plcs"][0]["model"] = "FP7"
        far["control"] = {"socket": str(self.folder / "far.sock")}
        self.far = self.start_gateway(far)
        near = self.configuration(
            lines=[line(self.folder / "line", response_timeout_ms=1000, **more)], stations=[station("fp", 999)],
            routes=[source("words", "DT100", "D100", 600, period_ms=300), source("relays", "R1E", "M100", 4),
                    source("setpoint", "LD5", "D900", 2, direction="write"),
                    source("contacts", "R50", "M200", 16, direction="write")])
        near["modbus_tcp"][0]["units"].append({"unit": 3, "line": "line", "line_unit": 999})
        self.near = self.start_gateway(near)
        self.watch = self.near.watch()

    def check(self):
        fp7, fx3u, forwarded = self.far.client(), self.near.client(), self.near.client(3)
        fp7.write_registers(100, [7, 8])
        fp7.write_register(699, 9)
        fp7.write_coils(0x800 + 0x1E, [1, 0, 1, 1])
        self.watch.expect("words", quality="good", values=[7, 8] + [0] * 597 + [9])
        self.watch.expect("relays", quality="good", values=[1, 0, 1, 1])
        fx3u.write_registers(900, [0x1234, 0xABCD])
        fx3u.write_coils(200, [1, 0] * 8)
        self.watch.expect("setpoint", quality="good", values=[0x1234, 0xABCD])
        self.watch.expect("contacts", quality="good", values=[1, 0] * 8)
        self.assertEqual((fp7.input(0x7D0 + 5, 2), fp7.coils(0x850, 16)), ([0x1234, 0xABCD], [1, 0] * 8))
        forwarded.write_registers(800, list(range(120)))
        self.assertEqual(forwarded.holding(800, 120), list(range(120)))
        self.assertEqual(fp7.holding(800, 120), list(range(120)))

    def test_the_published_reading(self):
        self.start()
        self.check()
        self.assertEqual(self.far.stop(), os.EX_OK)
        self.watch.expect("words", quality="comm error", values=[7, 8] + [0] * 597 + [9])

    def test_another_dialect_on_both_sides(self):
        self.start(dialect=OTHER)
        self.check()


main()
