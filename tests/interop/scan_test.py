"""plc-gateway scan: beside a running line, and on ports of its own; RTU, ASCII, MODBUS TCP and MEWTOCOL stations."""

import json
import os
import select
import signal
import subprocess
import threading
import time
import tty
from pathlib import Path

from mewtocol_station import MewtocolStation
from support import PATIENCE, InteropTest, Program, binary, main, route, serial_line, station, wait_for

NOBODY, INTERRUPTED = 4, 130
SLOW = 90  # seconds that a scan may take which has a twentieth of its line
SERVER = Path(__file__).with_name("pymodbus_server.py")


class GarbledStation(threading.Thread):
    """Answers every RTU request with a frame whose checksum is wrong."""

    def __init__(self, link):
        super().__init__(daemon=True)
        self.ours, self.theirs = os.openpty()
        tty.setraw(self.theirs)
        os.symlink(os.ttyname(self.theirs), link)
        self.ended = False

    def run(self):
        while not self.ended:
            if select.select([self.ours], [], [], 0.02)[0]:
                request = os.read(self.ours, 256)
                os.write(self.ours, bytes([request[0], 3, 2, 0, 1, 0, 0]))

    def end(self):
        self.ended = True
        self.join()
        os.close(self.ours)
        os.close(self.theirs)


class ScanTest(InteropTest):
    def start_scan(self, *words):
        return subprocess.Popen([binary("PLC_GATEWAY"), "scan", *map(str, words)], stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def scan(self, *words, seconds=PATIENCE):
        running = self.start_scan(*words)
        out, err = running.communicate(timeout=seconds)
        self.assertNotIn("Sanitizer", err)
        return running.returncode, out, err

    def stations(self, *words, seconds=PATIENCE):
        """What a scan that found somebody says, by unit."""
        status, out, err = self.scan("--json", *words, seconds=seconds)
        self.assertEqual(status, 0, f"{out}{err}")
        return {each["unit"]: each for scan in json.loads(out)["scans"] for each in scan["stations"]}

    def check(self, path):
        done = subprocess.run([binary("PLC_GATEWAY"), "check", path], stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=PATIENCE, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        return done.stdout

    def start_plant(self, period_ms, routes=1):
        """Unit 1 is a station of the gateway, 3 and 5 are not yet."""
        self.start_bus(ports=3)
        devices = [self.start_device(k + 1, unit) for k, unit in enumerate((1, 3, 5))]
        gateway = self.start_gateway(self.configuration(
            dds={"domain": 90 + os.getpid() % 10},
            lines=[serial_line(self.folder / "line", baud_rate=115200)], stations=[station("pump", 1, merge="off")],
            routes=[route(f"pump.{k}", "holding", 10 * k, f"D{100 + 10 * k}", 10, period_ms=period_ms)
                    for k in range(routes)]))
        wait_for("the station is polled", lambda: devices[0].answers() > 0)
        return gateway, devices

    def test_beside_a_line_that_is_full(self):
        _, devices = self.start_plant(period_ms=10, routes=20)
        stub = self.folder / "stub.json"

        def pace(seconds):
            before, began = devices[0].answers(), time.monotonic()
            time.sleep(seconds)
            return (devices[0].answers() - before) / (time.monotonic() - began)

        def found():
            alone = pace(2)
            running = self.start_scan("line", "--socket", self.control_socket, "--units", "1-5", "--timeout-ms", 250,
                                      "--json", "--output", stub)
            beside = pace(2)
            out, err = running.communicate(timeout=SLOW)
            self.assertEqual(running.returncode, 0, f"{out}{err}")
            scan = json.loads(out)["scans"][0]
            self.assertEqual(scan["state"], "done")
            here = {each["unit"]: each for each in scan["stations"]}
            return here if set(here) == {1, 3, 5} and beside > 0.75 * alone else None

        here = wait_for("a scan that finds all while the polls go on", found, 3 * SLOW)
        self.assertEqual(here[1]["what"], "configured")
        self.assertEqual((here[1]["name"], here[1]["health"]), ("pump", "healthy"))
        for unit in (3, 5):
            self.assertEqual(here[unit]["what"], "found")
            self.assertEqual({area["area"]: area["says"] for area in here[unit]["areas"]},
                             dict.fromkeys(("holding", "input", "coil", "discrete"), "values"))
        self.assertIn("3 stations, 8 routes", self.check(stub))

    def test_beside_a_line_with_time(self):
        gateway, _ = self.start_plant(period_ms=2000)
        status, out, err = self.scan("line", "--socket", self.control_socket, "--units", "1-6", "--timeout-ms", 500,
                                     seconds=SLOW)
        self.assertEqual(status, 0, err)
        self.assertRegex(out, r"(?m)^    1  is station pump, healthy; it was not asked$")
        self.assertRegex(out, r"(?m)^    3  answers: holding, input, coil, discrete")
        self.assertRegex(out, r"(?m)^    5  answers: ")
        self.assertNotRegex(out, r"(?m)^    [246]  ")
        self.assertTrue(gateway.running())

    def test_what_a_running_line_does_not_do(self):
        self.start_plant(period_ms=500)
        for words, status, text in ((("line", "--bauds", "9600"), 2, "Stop the gateway"),
                                    (("other",), 1, 'asks on no line "other", but on: line'),
                                    (("line", "--units", "1-300"), 1, "unit 248 cannot be on line line"),
                                    (("line", "--units", "x"), 2, "give numbers and ranges")):
            with self.subTest(words=words):
                got, out, err = self.scan(*words, "--socket", self.control_socket)
                self.assertEqual((got, out), (status, ""))
                self.assertIn(text, err)
        with self.subTest("its port is in use"):
            got, out, err = self.scan("--device", self.folder / "line")
            self.assertEqual((got, out), (1, ""))
            self.assertIn("is in use", err)

    def test_interrupted_beside_a_line(self):
        self.start_plant(period_ms=2000)
        running = self.start_scan("line", "--socket", self.control_socket, "--units", "3,100-247", "--timeout-ms", 500)
        time.sleep(3)
        running.send_signal(signal.SIGINT)
        out, _ = running.communicate(timeout=PATIENCE)
        self.assertEqual(running.returncode, INTERRUPTED)
        self.assertRegex(out, r"(?m)^    1  is station pump")
        # And the next one may begin.
        self.assertEqual(self.scan("line", "--socket", self.control_socket, "--units", "3")[0], 0)

    def test_on_a_port_of_its_own(self):
        self.start_bus(ports=2)
        self.start_device(1, 2)
        self.start_device(2, 4)
        stub = self.folder / "stub.json"
        port = ("--device", self.folder / "line")
        here = self.stations(*port, "--bauds", "19200", "--formats", "8N1", "--protocols", "modbus-rtu", "--units",
                             "1-5", "--timeout-ms", 500, "--output", stub)
        self.assertEqual(set(here), {2, 4})
        self.assertIn("2 stations, 8 routes", self.check(stub))
        text = stub.read_text()
        self.assertIn('"baud_rate":19200', text)
        self.assertIn('"parity":"none"', text)

        # The stub is a configuration like any other: its line is scanned as it is.
        status, out, err = self.scan("-c", stub, "line1", "--units", "4", "--timeout-ms", 500)
        self.assertEqual(status, 0, err)
        self.assertIn("; station station4", out)
        status, _, err = self.scan("-c", stub, "line2")
        self.assertEqual(status, 1)
        self.assertIn('has no line "line2" on which the gateway asks, but: line1', err)

        status, out, _ = self.scan(*port, "--bauds", "19200,9600", "--formats", "8N1", "--protocols",
                                   "modbus-rtu,modbus-ascii", "--units", "9", "--timeout-ms", 50)
        self.assertEqual((status, out), (NOBODY, "no station answered\n"))
        status, _, err = self.scan("--device", self.folder / "absent")
        self.assertEqual(status, 1)
        self.assertIn("absent cannot be opened: No such file or directory", err)

    def test_interrupted_on_a_port_of_its_own(self):
        self.start_bus(ports=1)
        self.start_device(1, 1)
        running = self.start_scan("--device", self.folder / "line", "--bauds", "19200", "--formats", "8N1",
                                  "--timeout-ms", 1000, "--output", "-")
        time.sleep(6)
        running.send_signal(signal.SIGINT)
        out, err = running.communicate(timeout=PATIENCE)
        self.assertEqual(running.returncode, INTERRUPTED, err)
        self.assertRegex(err, r"(?m)^    1  answers: holding")
        stub = self.folder / "stub.json"
        stub.write_text(out)
        self.assertIn("1 station, 4 routes", self.check(stub))

    def test_damaged_answers(self):
        garbled = GarbledStation(self.folder / "garbled")
        garbled.start()
        self.addCleanup(garbled.end)
        status, out, _ = self.scan("--device", self.folder / "garbled", "--bauds", "9600", "--formats", "8N1",
                                   "--protocols", "modbus-rtu", "--units", "7")
        self.assertEqual(status, NOBODY)
        self.assertRegex(out, r"(?m)^    7  sent something, damaged: ")
        self.assertIn("another baud rate or parity?", out)

    def test_mewtocol(self):
        fp7 = MewtocolStation(self.folder / "fp7", number=7)
        fp7.start()
        self.addCleanup(fp7.end)
        stub = self.folder / "stub.json"
        here = self.stations("--device", self.folder / "fp7", "--protocols", "mewtocol-com", "--bauds", "9600",
                             "--formats", "8O1", "--units", "6-8", "--timeout-ms", 500, "--output", stub)
        self.assertEqual(set(here), {7})
        self.assertIn({"area": "DT", "says": "values", "source": "DT0"}, here[7]["areas"])
        self.check(stub)

    def test_modbus_tcp(self):
        port = self.free_port()
        Program(self, "pymodbus", ["/usr/bin/python3", "-B", SERVER, "tcp", port, "2,5"]).ready()
        stub = self.folder / "stub.json"
        here = self.stations("--host", "127.0.0.1", "--port", port, "--units", "1-6", "--timeout-ms", 500,
                             "--output", stub)
        self.assertEqual(set(here), {2, 5})
        self.assertEqual(here[2]["identification"], "Debian pymodbus 3.0")
        self.check(stub)
        self.assertIn("// Debian pymodbus 3.0", stub.read_text())

    def test_nobody_listens(self):
        status, out, err = self.scan("--host", "127.0.0.1", "--port", self.free_port(), "--units", "1")
        self.assertEqual((status, out), (1, ""))
        self.assertIn("cannot be reached", err)


main()
