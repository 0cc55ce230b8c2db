"""ADPRW instructions of a PLC program to MEWTOCOL stations, and the result codes of SEND and RECV that can occur."""

import time

from mewtocol7_station import Mewtocol7Station
from mewtocol_station import MewtocolStation
from support import InteropTest, main, station, wait_for

D8402, M8403 = 8402, 0x1E00 + 403  # error code and latched error of channel 1
D8408 = 8408                       # retries
SETUP = ["LD M8411", "MOV H1081 D8400", "MOV H1 D8401", "MOV K1000 D8409", "MOV K0 D8412"]
COM = {"protocol": "mewtocol-com", "baud_rate": 115200, "parity": "odd"}


class MewtocolAdprwTest(InteropTest):
    def start(self, program, line=None, simulated=MewtocolStation, **more):
        self.fp7 = simulated(self.folder / "line", number=7)
        self.addCleanup(lambda: self.assertEqual(self.fp7.wrong, []))
        self.addCleanup(self.fp7.end)
        self.fp7.start()
        configuration = self.configuration(program=[*SETUP, *program], lines=[
            {**COM, **(line or {}), "name": "line", "device": str(self.folder / "line")}], **more)
        configuration["plcs"][0]["channels"] = [{"channel": 1, "line": "line"}]
        self.gateway = self.start_gateway(configuration)
        self.client = self.gateway.client()

    def expect(self, first, values):
        wait_for(lambda: f"{values} in D{first}: {self.client.holding(first, len(values))}",
                 lambda: self.client.holding(first, len(values)) == values)

    def test_reads_by_the_map_of_an_fp7(self):
        self.start(["LD M8000", "ADPRW H7 H3 K100 K30 D100", "ADPRW H7 H4 H7D5 K2 D140", "ADPRW H7 H1 H81F K3 M100",
                    "ADPRW H7 H2 K0 K4 M110"])
        self.fp7.memory["WR", 1], self.fp7.memory["WR", 2], self.fp7.memory["WX", 0] = 0x8000, 2, 0b1010
        self.expect(100, list(range(100, 130)))
        self.expect(140, [5, 6])
        wait_for("the contacts", lambda: (self.client.coils(100, 3), self.client.coils(110, 4))
                 == ([1, 0, 1], [0, 1, 0, 1]))
        self.assertEqual((self.client.holding(D8402), self.client.coils(M8403)), ([0], [0]))

    def test_writes(self):
        self.start(["LD M0", "ADPRW H7 H6 K10 K0 D200", "ADPRW H7 H10 K20 K3 D210", "ADPRW H7 H5 H81F K0 M1",
                    "ADPRW H7 HF H820 K20 M20"])
        self.client.write_register(200, 4711)
        self.client.write_registers(210, [1, 2, 0xABCD])
        self.client.write_coils(1, [1])
        self.client.write_coils(20, [1, 0, 1] + [1] * 17)
        self.client.write_coil(0, 1)
        wait_for("what is written arrives", lambda: [self.fp7.memory.get(at) for at in (
            ("D", 10), ("D", 20), ("D", 21), ("D", 22), ("WR", 1), ("WR", 2), ("WR", 3))]
            == [4711, 1, 2, 0xABCD, 0x8000, 0xFFFD, 0xF])
        self.assertEqual(self.client.holding(D8402), [0])

    def test_a_write_to_all_stations(self):
        self.start(["LDP M0", "ADPRW H0 H6 K10 K0 D200"])
        self.client.write_register(200, 0x1234)
        self.client.write_coil(0, 1)
        wait_for("it is heard", lambda: self.fp7.globals == ["WDD00010000103412"])
        self.assertEqual(self.client.holding(D8402), [0])

    def test_errors_of_the_station(self):
        """As exceptions of the function, error 212."""
        self.start(["LD M8000", "ADPRW H7 H3 K100 K2 D100"])
        self.expect(100, [100, 101])
        for code, exception in (("61", 0x02), ("42", 0x01), ("65", 0x04), ("53", 0x06)):
            self.fp7.refuse = code
            self.expect(D8402, [212, 0x8300 | exception])
        self.assertEqual((self.client.holding(100, 2), self.client.coils(M8403)), ([100, 101], [1]))
        self.fp7.refuse = None
        self.fp7.memory["D", 100] = 9
        self.expect(100, [9, 101])

    def test_a_device_that_the_map_or_the_protocol_does_not_have(self):
        self.start(["LD M8000", "ADPRW H7 H4 H400 K1 D100"])
        self.expect(D8402, [212, 0x8402])
        self.assertEqual(self.fp7.commands, [])

    def test_silence_and_damage(self):
        self.start(["MOV K300 D8409", "MOV K1 D8412", "LD M8000", "ADPRW H7 H3 K100 K2 D100"])
        self.expect(100, [100, 101])
        self.fp7.misbehave = lambda answer: []
        self.expect(D8402, [211])
        self.expect(D8408, [1])  # while it is asked again
        self.fp7.misbehave = lambda answer: [(0, answer.replace(b"6400", b"6500"))]  # the check code stays
        self.expect(D8402, [205])
        self.fp7.misbehave = lambda answer: [(0, b"%07$WD1" + b"5\r")]  # the check code is right, the answer is not
        self.expect(D8402, [207])
        self.assertEqual(self.client.holding(100, 2), [100, 101])
        self.fp7.misbehave = None
        self.fp7.memory["D", 101] = 8
        self.expect(100, [100, 8])

    def test_mewtocol7(self):
        self.start(["LD M8000", "ADPRW H7 H3 K100 K2 D100", "ADPRW H7 H1 H81F K2 M100", "LDP M0",
                    "ADPRW H7 H6 K10 K0 D200", "LDP M1", "ADPRW H7 H5 H81F K0 K1"],
                   {"protocol": "mewtocol7-com"}, Mewtocol7Station)
        self.fp7.memory["WR", 1] = 0x8000
        self.expect(100, [100, 101])
        wait_for("the contacts", lambda: self.client.coils(100, 2) == [1, 0])
        self.client.write_register(200, 4711)
        self.client.write_coil(0, 1)
        wait_for("it is written", lambda: self.fp7.memory.get(("DT", 10)) == 4711)
        self.client.write_coil(1, 1)
        wait_for("a single relay cannot be written", lambda: self.client.coils(M8403) == [1])
        self.assertEqual(self.fp7.memory["WR", 1], 0x8000)


class ResultCodeTest(InteropTest):
    """004, 7.3.2 and 7.4.2. 5 and 6 have tests in mewtocol_client_test, too; 4 is a unit test of lines and routes."""

    def start(self, device, **line):
        source = {"name": "fp.words", "station": "fp", "source": "DT100", "count": 2, "plc": "main", "device": "D100",
                  "period_ms": 50}
        self.gateway = self.start_gateway(self.configuration(
            lines=[{**COM, "name": "line", "device": str(device), "response_timeout_ms": 200, "retries": 0,
                    **line}],
            stations=[station("fp", 7)], routes=[source]))
        self.watch = self.gateway.watch()

    def result(self, code):
        wait_for(f"result {code}", lambda: f", result {code}" in self.gateway.log)

    def test_4_the_port_is_absent(self):
        """Of which the line speaks, not the station."""
        fp7 = MewtocolStation(self.folder / "line")
        fp7.start()
        self.start(self.folder / "line")
        self.watch.expect("fp.words", quality="good", values=[100, 101])
        fp7.end()
        self.watch.expect("fp.words", quality="comm error", values=[100, 101])
        wait_for("the line says so", lambda: "line was lost" in self.gateway.log)

    def test_4_the_line_is_never_quiet(self):
        """A character in each 2 ms, where one lasts 9 ms: comm error. The code itself: unit tests."""
        fp7 = MewtocolStation(self.folder / "line")
        fp7.start()
        self.addCleanup(fp7.end)
        self.start(self.folder / "line", baud_rate=1200, retries=1)
        self.watch.expect("fp.words", quality="good", values=[100, 101])
        fp7.misbehave = lambda answer: [(i * 0.002, b"~") for i in range(1000)]
        self.watch.expect("fp.words", quality="comm error", values=[100, 101])
        fp7.misbehave = None
        self.watch.expect("fp.words", quality="good", values=[100, 101])

    def test_0_and_6_of_a_write(self):
        fp7 = MewtocolStation(self.folder / "line")
        fp7.start()
        self.addCleanup(fp7.end)
        self.start(self.folder / "line")
        self.watch.expect("fp.words", quality="good")
        time.sleep(0.2)
        self.assertNotIn(", result ", self.gateway.log)  # 0 is not worth a word
        fp7.refuse = "65"
        self.watch.expect("fp.words", quality="device error")
        self.result(6)


main()
