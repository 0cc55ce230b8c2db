"""A PLC's own program asks devices of a line with ADPRW."""

import time

from faulty_device import FaultyDevice, framed
from support import InteropTest, main, route, serial_line, station, wait_for

D8402, M8403 = 8402, 0x1E00 + 403  # error code and latched error of channel 1
D8408, M8408, M8401 = 8408, 0x1E00 + 408, 0x1E00 + 401  # retries, retrying (and timeout), in process
SETUP = ["LD M8411", "MOV H1081 D8400", "MOV H1 D8401", "MOV K200 D8409", "MOV K0 D8412"]


class AdprwTest(InteropTest):
    def start(self, program, **more):
        self.start_bus(3)
        self.device = self.start_device(1, 1, "--set", "hr:0=1234", "--set", "hr:1=5")
        configuration = self.configuration(program=[*SETUP, *program], lines=[serial_line(self.folder / "line")],
                                           **more)
        configuration["plcs"][0]["channels"] = [{"channel": 1, "line": "line"}]
        self.gateway = self.start_gateway(configuration)
        self.client = self.gateway.client()

    def expect(self, first, values):
        wait_for(lambda: f"{values} in D{first}: {self.client.holding(first, len(values))}",
                 lambda: self.client.holding(first, len(values)) == values)

    def test_reading_again_and_again(self):
        self.start(["LD M8000", "ADPRW H1 H3 K0 K2 D100"])
        self.expect(100, [1234, 5])
        self.device.door.write_registers(0, [7, 8])
        self.expect(100, [7, 8])
        self.assertEqual((self.client.holding(D8402), self.client.coils(M8403)), ([0], [0]))

    def test_writing(self):
        self.start(["LD M8000", "ADPRW H1 H6 K10 K0 D200", "ADPRW H1 H10 K20 K3 D210", "LDP M0",
                    "ADPRW H1 H5 K2 K0 K1"])
        self.client.write_register(200, 4711)
        self.client.write_registers(210, [1, 2, 3])
        wait_for("what is written arrives", lambda: (self.device.door.holding(10), self.device.door.holding(20, 3))
                 == ([4711], [1, 2, 3]))
        self.assertEqual(self.device.door.coils(2), [0])
        self.client.write_coil(0, 1)
        wait_for("the coil", lambda: self.device.door.coils(2) == [1])
        self.device.door.write_coil(2, 0)
        time.sleep(0.5)
        self.assertEqual(self.device.door.coils(2), [0])  # once for each edge

    def test_beside_routes(self):
        self.start(["LD M8000", "ADPRW H1 H3 K0 K2 D100"], stations=[station("pump", 1)],
                   routes=[route("pump.low", "holding", 0, "D120", 2, period_ms=50)])
        self.expect(100, [1234, 5])
        self.expect(120, [1234, 5])
        self.device.door.write_register(1, 6)
        self.expect(100, [1234, 6])
        self.expect(120, [1234, 6])

    def test_device_that_dies_and_comes_back(self):
        self.start(["LD M8000", "ADPRW H1 H3 K0 K2 D100"])
        self.expect(100, [1234, 5])
        self.device.kill()
        self.expect(D8402, [211])
        self.assertEqual(self.client.holding(100, 2), [1234, 5])
        self.start_device(1, 1, "--set", "hr:0=77")
        self.expect(100, [77, 0])

    def test_exception_of_the_device(self):
        self.start(["LD M8000", "ADPRW H1 H3 K30000 K2 D100"])
        self.expect(D8402, [212, 0x8302])
        self.assertEqual(self.client.coils(M8403), [1])

    def test_answers_of_strangers(self):
        self.configured = self.configuration(program=[*SETUP, "MOV H1 D8415", "MOV K300 D8416", "LDP M0",
                                                      "ADPRW H1 H3 K0 K1 D100"],
                                             lines=[serial_line(self.folder / "line")])
        self.configured["plcs"][0]["channels"] = [{"channel": 1, "line": "line"}]
        device = FaultyDevice(self.folder / "line")
        device.start()
        self.addCleanup(device.end)
        self.client = self.start_gateway(self.configured).client()
        for answer, error in ((framed(b"\x11\x03\x02\x00\x07"), [213, 0x0111]),
                              (framed(b"\x01\x04\x02\x00\x07"), [214, 0x0304]),
                              (framed(b"\x01\x03\x04\x00\x07\x00\x08"), [207, 0]),
                              (framed(b"\x01\x03\x02\x00\x07")[:-1] + b"\x00", [205, 0])):
            device.misbehave = lambda _, answer=answer: [(0, answer)]
            self.client.write_coil(0, 0)
            self.client.write_coil(0, 1)
            self.expect(D8402, error)
        self.expect(300, [3, 1, 0])  # whole messages, damaged ones

    def test_counters_of_the_client(self):
        self.start(["MOV H1 D8415", "MOV K300 D8416", "LDP M0", "ADPRW H1 H3 K30000 K2 D100", "LDP M1",
                    "ADPRW H1 H3 K0 K2 D100"])
        self.client.write_coil(0, 1)
        self.expect(300, [1, 0, 1, 0])  # messages, errors, exceptions
        self.client.write_coil(1, 1)
        self.expect(300, [2, 0, 1, 0])

    def test_retries_show_as_they_happen(self):
        self.start(["MOV K2 D8412", "LDP M0", "ADPRW H9 H3 K0 K1 D100"])
        self.client.write_coil(0, 1)
        self.expect(D8408, [1])
        self.assertEqual((self.client.coils(M8408), self.client.coils(M8401), self.client.holding(D8402)),
                         ([1], [1], [0]))
        self.expect(D8408, [2])
        self.expect(D8402, [211])
        self.assertEqual((self.client.holding(D8408), self.client.coils(M8408, 2), self.client.coils(M8401)),
                         ([2], [1, 1], [0]))

    def test_line_of_the_configuration_shows(self):
        self.start_bus(3)
        configuration = self.configuration(lines=[serial_line(self.folder / "line")])
        configuration["plcs"][0]["channels"] = [{"channel": 2, "line": "line"}]
        client = self.start_gateway(configuration).client()
        self.assertEqual((client.holding(8421), client.holding(8439)), ([1], [9]))

    def test_stop_of_the_plc(self):
        self.start(["LD M8000", "ADPRW H1 H3 K0 K2 D100"])
        self.expect(100, [1234, 5])
        self.assertEqual(self.plc_command("stop", "main")[0], 0)
        time.sleep(0.3)
        self.device.door.write_register(0, 1)
        time.sleep(0.3)
        self.assertEqual(self.client.holding(100, 2), [1234, 5])
        self.assertEqual(self.plc_command("run", "main")[0], 0)
        self.expect(100, [1, 5])


main()
