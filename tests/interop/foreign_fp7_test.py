"""Our MEWTOCOL-COM client and the simulated FP7 of tests/field, a second reading of the protocol: every frame."""

from foreign_fp7 import bcc, ForeignFp7Test, source
from support import main

# The station's memory: what stands in a word tells its area and number, and both of its bytes differ.
SEEDS = {"DT": 1, "LD": 2, "WX": 3, "WY": 4, "WR": 5, "WL": 6}
LAST_WORDS = {"DT": 1100, "LD": 40, "WX": 40, "WY": 40, "WR": 40, "WL": 40}


def word(area, number):
    return (number * 2657 + SEEDS[area] * 4099) & 0xFFFF


def contact(area, number):
    """T and C: every third is on."""
    return int(number % 3 == 0) if area in "TC" else word("W" + area, number // 16) >> number % 16 & 1


MEMORY = [f"{area}0=" + ",".join(str(word(area, n)) for n in range(last)) for area, last in LAST_WORDS.items()]
MEMORY += ["WR2047=0x8001", *(f"{area}{n}=1" for area in "TC" for n in range(0, 120, 3))]

# Source, count, values, and the commands that ask for them.
CONTACTS_READ = [
    ("R1F", 1, ["%RCSR001F"]),
    ("X10A", 1, ["%RCSX010A"]),
    ("Y0", 1, ["%RCSY0000"]),
    ("L39F", 1, ["%RCSL039F"]),
    ("T99", 1, ["%RCST0099"]),
    ("C3", 1, ["%RCSC0003"]),
    ("R1F", 3, ["%RCCR00010002"]),
    ("X20", 16, ["%RCCX00020002"]),
    ("Y31", 20, ["%RCCY00030004"]),
    ("L0", 27 * 16, ["%RCCL00000026"]),
    ("R0", 28 * 16, ["<RCCR00000027"]),
    ("T95", 10, ["%RCP8" + "".join(f"T{n:04}" for n in range(95, 103)), "%RCP2T0103T0104"]),
    ("C8", 8, ["%RCP8" + "".join(f"C{n:04}" for n in range(8, 16))]),
]
WORDS_READ = [
    ("DT100", 1, ["%RDD0010000100"]),
    ("DT1", 27, ["%RDD0000100027"]),
    ("DT2", 28, ["<RDD0000200029"]),
    ("DT0", 509, ["<RDD0000000508"]),
    ("DT1", 510, ["<RDD0000100508", "<RDD0050900510"]),
    ("DT10", 1024, ["<RDD0001000517", "<RDD0051801025", "<RDD0102601033"]),
    ("LD5", 30, ["<RDL0000500034"]),
    ("WX3", 2, ["%RCCX00030004"]),
    ("WY3", 3, ["%RCCY00030005"]),
    ("WR2", 28, ["<RCCR00020029"]),
    ("WL0", 27, ["%RCCL00000026"]),
]
NORMAL_READ = [
    ("DT0", 100, ["%RDD0000000025", "%RDD0002600051", "%RDD0005200077", "%RDD0007800099"]),
    ("DT200", 27, ["%RDD0020000226"]),
    ("WR0", 30, ["%RCCR00000025", "%RCCR00260029"]),
    ("L0", 28 * 16, ["%RCCL00000025", "%RCCL00260027"]),
]

# Source, values written, and how the station hears them.
CONTACTS_WRITTEN = [
    ("R50", [1], ["%WCSR00501"]),
    ("YF", [1], ["%WCSY000F1"]),
    ("L999F", [1], ["%WCSL999F1"]),
    ("R70", [1, 0, 1], ["%WCP3R00701R00710R00721"]),
    ("R8E", [1, 1, 0, 1], ["%WCP2R008E1R008F1", "%WCP2R00900R00911"]),
    ("L10", [1, 0] * 4, ["%WCP8" + "".join(f"L001{n}{1 - n % 2}" for n in range(8))]),
    ("Y20", [1] + [0] * 15, ["%WCCY000200020100"]),
    ("R110", [1, 0] * 4 + [0, 1] * 4 + [1] * 16, ["%WCCR0011001255AAFFFF"]),
    ("R13E", [1, 0] + [0, 1] * 8 + [1, 1], ["%WCP2R013E1R013F0", "%WCCR00140014AAAA", "%WCP2R01501R01511"]),
]
# Source, count, the command, its digits for a number, and the words of each frame.
WORDS_WRITTEN = [
    ("DT3000", 1, "%WDD", 5, [1]),
    ("DT3100", 24, "%WDD", 5, [24]),
    ("DT3200", 25, "<WDD", 5, [25]),
    ("DT4000", 507, "<WDD", 5, [507]),
    ("DT5000", 508, "<WDD", 5, [506, 2]),
    ("LD100", 2, "%WDL", 5, [2]),
    ("WY100", 24, "%WCCY", 4, [24]),
    ("WR100", 25, "<WCCR", 4, [25]),
    ("WL1000", 2, "%WCCL", 4, [2]),
    ("WR2046", 2, "%WCCR", 4, [2]),
]


def pattern(number, count):
    """Words to write, none of them 0; their bytes differ."""
    return [(0x1200 + number * 0x0100 + n * 7) % 0xFFFE + 1 for n in range(count)]


def low_byte_first(words):
    return "".join(f"{each & 0xFF:02X}{each >> 8:02X}" for each in words)


def write_commands(name, begin, digits, pieces, words):
    first = int(name.lstrip("DTLWYR"))
    for size in pieces:
        yield f"{begin}{first:0{digits}}{first + size - 1:0{digits}}{low_byte_first(words[:size])}"
        first, words = first + size, words[size:]


class FramesTest(ForeignFp7Test):
    def check_reads(self, rows, values):
        """rows of words or contacts; all of them in the FX3U from D0 or M0 on."""
        routes, expected, at = [], [], 0
        for number, (name, count, _) in enumerate(rows):
            bits = name[0] in "XYRLTC" and name[1] != "D"
            routes.append(source(f"fp.{number}", name, f"{'M' if bits else 'D'}{at}", count, period_ms=400))
            expected.append((number, bits, at, values(name, count)))
            at += count
        self.configure(*routes)
        client = self.gateway.client()
        for number, bits, first, wanted in expected:
            with self.subTest(rows[number][:2]):
                self.watch.expect(f"fp.{number}", quality="good", values=wanted)
                read = client.coils if bits else client.holding
                held = [each for i in range(0, len(wanted), 100) for each in read(first + i, min(100, len(wanted) - i))]
                self.assertEqual(held, wanted)
        self.assertEqual(set(self.heard()), {each for row in rows for each in row[2]})

    def words(self, name, count):
        first = int(name[2:])
        return [word(name[:2], first + n) for n in range(count)]

    def contacts(self, name, count):
        first = int(name[1:]) if name[0] in "TC" else int("0" + name[1:-1]) * 16 + int(name[-1], 16)
        return [contact(name[0], first + n) for n in range(count)]

    def words_or_contacts(self, name, count):
        return (self.words if name[:2] in SEEDS else self.contacts)(name, count)

    def test_contacts_are_read_with_rcs_rcc_and_rcp(self):
        self.start_fp7("--set", *MEMORY)
        self.check_reads(CONTACTS_READ, self.contacts)

    def test_words_are_read_in_frames_that_carry_them(self):
        self.start_fp7("--set", *MEMORY)
        self.check_reads(WORDS_READ, self.words)

    def test_a_station_without_the_long_header_is_read_in_short_frames(self):
        self.start_fp7("--no-expansion", "--set", *MEMORY)
        self.line = {"mewtocol": {"expansion": False}}
        self.check_reads(NORMAL_READ, self.words_or_contacts)

    def test_relays_beyond_the_single_commands(self):
        """RCS has three digits for the word, RCC has four."""
        self.start_fp7("--set", *MEMORY)
        self.check_reads([("R2047F", 1, ["%RCCR20472047"]), ("R20470", 2, ["%RCCR20472047"])],
                         lambda name, count: [1, 0][:count])

    def check_written_words(self, rows):
        """Each is written by a MODBUS TCP client and read back by another route."""
        routes, at = [], 0
        for number, (name, count, *_) in enumerate(rows):
            routes.append(source(f"fp.{number}", name, f"D{at}", count, direction="write"))
            routes.append(source(f"fp.back{number}", name, f"D{4000 + at}", count, period_ms=400))
            at += count
        self.configure(*routes)
        client = self.gateway.client()
        commands, at = [], 0
        for number, (name, count, begin, digits, pieces) in enumerate(rows):
            words = pattern(number, count)
            for i in range(0, count, 100):
                client.write_registers(at + i, words[i:i + 100])
            at += count
            with self.subTest(name, count=count):
                self.watch.expect(f"fp.{number}", quality="good", values=words)
                self.watch.expect(f"fp.back{number}", quality="good", values=words)
            commands += write_commands(name, begin, digits, pieces, words)
        heard = self.heard()
        for command in commands:
            self.assertIn(command, heard)

    def test_words_are_written_in_frames_that_carry_them(self):
        self.start_fp7()
        self.check_written_words(WORDS_WRITTEN)

    def test_a_station_without_the_long_header_is_written_in_short_frames(self):
        self.start_fp7("--no-expansion")
        self.line = {"mewtocol": {"expansion": False}}
        self.check_written_words([("DT3000", 60, "%WDD", 5, [24, 24, 12]), ("WR100", 25, "%WCCR", 4, [24, 1])])

    def test_contacts_are_written_with_wcs_wcp_and_wcc(self):
        self.start_fp7()
        routes = []
        for number, (name, values, _) in enumerate(CONTACTS_WRITTEN):
            at, count = 100 * number, len(values)
            routes.append(source(f"fp.{number}", name, f"M{at}", count, direction="write"))
            routes.append(source(f"fp.back{number}", name, f"M{4000 + at}", count))
        self.configure(*routes)
        client = self.gateway.client()
        for number, (name, values, _) in enumerate(CONTACTS_WRITTEN):
            with self.subTest(name):
                client.write_coils(100 * number, values)
                self.watch.expect(f"fp.{number}", quality="good", values=values)
                self.watch.expect(f"fp.back{number}", quality="good", values=values)
        heard = self.heard()
        for _, _, commands in CONTACTS_WRITTEN:
            for command in commands:
                self.assertIn(command, heard)

    def test_neighbours_of_written_contacts_stay(self):
        self.start_fp7("--set", "WR4=0xFFFF", "WR5=0xFFFF", "WR6=0xFFFF")
        self.configure(source("fp.out", "R4E", "M0", 20, direction="write"), source("fp.back", "WR4", "D0", 3))
        client = self.gateway.client()
        client.write_coils(0, [1] * 20)
        client.write_coils(0, [0] * 20)
        self.watch.expect("fp.back", quality="good", values=[0x3FFF, 0, 0xFFFC])

    def test_all_stations_are_told_and_none_answers(self):
        self.start_fp7()
        self.configure(source("all.clock", "DT600", "D600", direction="write"), source("fp.back", "DT600", "D610"))
        self.gateway.client().write_register(600, 0x4D2)
        self.watch.expect("all.clock", quality="good", values=[0x4D2])
        self.watch.expect("fp.back", quality="good", values=[0x4D2])
        told = "%FF#WDD0060000600D204"
        self.assertIn(f"{told}{bcc(told)} -> \n", self.fp7.log)

    def test_what_it_refuses_is_a_device_error_of_that_route_only(self):
        self.start_fp7("--set", *MEMORY)
        self.configure(source("fp.set_value", "SV0", "D0"),       # RS: an FP7 does not offer it
                       source("fp.file", "FL0", "D1"),            # no such area
                       source("fp.beyond", "LD16384", "D2"),
                       source("fp.good", "DT5", "D10"))
        for name in ("fp.set_value", "fp.file", "fp.beyond"):
            self.watch.expect(name, quality="device error")
        self.watch.expect("fp.good", quality="good", values=[word("DT", 5)])
        for code in ("!42", "!60", "!61"):
            self.assertIn(f" -> %07{code}", self.fp7.log)


main()
