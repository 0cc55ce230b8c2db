"""What the interoperability tests share: programs that end with the test, ports, a DDS domain, clients, deadlines.

CMakeLists.txt passes the built programs as PLC_GATEWAY, FIELD_BUS, FIELD_DEVICE, FIELD_LINE and LIBMODBUS_CLIENT.
"""

import ctypes
import json
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from pymodbus.client import ModbusTcpClient
from pymodbus.pdu import ExceptionResponse

PATIENCE = 20  # seconds that anything may take which needs no time of its own
LIBC = ctypes.CDLL(None)
PR_SET_PDEATHSIG = 1


def wait_for(what, condition, seconds=PATIENCE):
    """Looks until the condition holds, and returns what it returned."""
    deadline = time.monotonic() + seconds
    while True:
        found = condition()
        if found:
            return found
        if time.monotonic() > deadline:
            raise AssertionError(f"not within {seconds} s: {what() if callable(what) else what}")
        time.sleep(0.02)


def holds(what, condition, seconds):
    """Looks for that time whether the condition holds all along."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        if not condition():
            raise AssertionError(f"no longer true: {what() if callable(what) else what}")
        time.sleep(0.02)


class Program:
    """A running program. What it prints is shown when the test fails."""

    def __init__(self, test, name, arguments, output=None, stdin=subprocess.DEVNULL, **environment):
        self.name = name
        self.log_file = test.folder / f"{len(test.programs)}-{name}.log"
        self.stopped_with = None
        test.programs.append(self)
        ours = ("NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID", "JOURNAL_STREAM")
        inherited = {name: value for name, value in os.environ.items() if name not in ours}
        # A test that CTest kills takes its programs along; field-line takes its own.
        orphaned = signal.SIGTERM if name == "field-line" else signal.SIGKILL
        with open(self.log_file, "wb") as log:
            self.process = subprocess.Popen([str(a) for a in arguments], stdin=stdin, stdout=output or log,
                                            stderr=log, cwd=test.folder, env={**inherited, **environment},
                                            preexec_fn=lambda: LIBC.prctl(PR_SET_PDEATHSIG, orphaned))
        test.addCleanup(self.finish, test)

    @property
    def pid(self):
        return self.process.pid

    @property
    def log(self):
        return self.log_file.read_text(errors="replace")

    def running(self):
        return self.process.poll() is None

    def signal(self, number):
        self.process.send_signal(number)

    def wait(self, seconds=PATIENCE):
        return self.process.wait(seconds)

    def stop(self):
        """Ends it by SIGTERM. Returns the exit status."""
        if self.running():
            self.signal(signal.SIGTERM)
        return self.wait()

    def kill(self):
        self.process.kill()
        self.process.wait()

    def finish(self, test):
        try:
            self.stop()
        except subprocess.TimeoutExpired:
            self.kill()
            test.fail(f"{self.name} did not end within {PATIENCE} s after SIGTERM")
        for sign in ("AddressSanitizer", "LeakSanitizer", "runtime error:"):
            test.assertNotIn(sign, self.log, f"in the output of {self.name}")

    def ready(self):
        """Waits for its first line of output."""
        wait_for(f"{self.name} is ready", lambda: self.log or not self.running())
        if not self.running():
            raise AssertionError(f"{self.name} ended: {self.log}")
        return self


class Gateway(Program):
    def __init__(self, test, configuration, program=None, **environment):
        self.test = test
        self.dds = configuration["dds"]
        self.port = configuration["modbus_tcp"][0]["port"]
        arguments = [program or binary("PLC_GATEWAY"), "run", test.write(configuration)]
        super().__init__(test, "plc-gateway", arguments, **environment)

    def listening(self):
        wait_for("the gateway listens", lambda: "MODBUS TCP listens on" in self.log or not self.running())
        self.test.assertTrue(self.running(), "the gateway ended")
        return self

    def client(self, unit=1):
        return Client(self.test, self.port, unit)

    def watch(self):
        return Watch(self.test, self.dds)

    def cpu_seconds(self):
        fields = Path(f"/proc/{self.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")  # utime and stime


class Watch(Program):
    """plc-gateway watch --json: the samples that a DDS subscriber gets."""

    def __init__(self, test, dds):
        self.json_file = test.folder / f"{len(test.programs)}-watch.json"
        self.read_until = 0
        self.samples = []  # of registers, in the order of their arrival
        self.heard = []    # messages of serial lines
        self.statuses = []
        self.points = {}   # the latest sample of each, by name
        self.states = {}   # the latest of each port and device, by kind and name
        self.events = []   # what the gateway had to say
        with open(self.json_file, "wb") as output:
            super().__init__(test, "watch", [binary("PLC_GATEWAY"), "watch", "--json", "--domain", dds["domain"],
                                             "--interface", dds["interface"], "--partition", dds["partition"]], output)

    def read(self):
        with open(self.json_file, "rb") as output:
            output.seek(self.read_until)
            for line in output:
                if not line.endswith(b"\n"):
                    break
                self.read_until += len(line)
                event = json.loads(line)
                if event["event"] == "registers":
                    self.samples.append(event)
                if event["event"] == "point":
                    self.points[event["name"]] = event
                if event["event"] == "status":
                    self.statuses.append(event)
                if event["event"] == "message":
                    self.heard.append(event)
                if event["event"] in ("port", "device"):
                    self.states[event["event"], event[event["event"]]] = event
                if event["event"] == "event":
                    self.events.append(event)

    def connected(self):
        """Waits until it hears the gateway, and so every message from then on."""
        wait_for("the gateway is heard", lambda: self.read() or self.statuses)
        return self

    def messages(self, line, **wanted):
        """All messages of a line so far that have these fields."""
        self.read()
        return [each for each in self.heard
                if each["line"] == line and all(each[key] == value for key, value in wanted.items())]

    def of(self, route):
        """All samples of a route so far."""
        self.read()
        return [each for each in self.samples if each["route"] == route]

    def latest(self, route):
        samples = self.of(route)
        return samples[-1] if samples else {}

    def expect(self, route, seconds=PATIENCE, **wanted):
        """Waits for a sample with these fields, and returns it."""
        def fitting():
            latest = self.latest(route)
            return latest if all(latest.get(key) == value for key, value in wanted.items()) else None
        return wait_for(lambda: f"{route} with {wanted}, the latest is {self.latest(route)}", fitting, seconds)


class Client:
    """pymodbus, with values instead of responses; an exception response raises Refused."""

    def __init__(self, test, port, unit=1):
        self.unit = unit
        self.modbus = ModbusTcpClient("127.0.0.1", port, timeout=PATIENCE, retries=0)
        wait_for(f"a connection to port {port}", self.modbus.connect)
        test.addCleanup(self.modbus.close)

    def do(self, response):
        if isinstance(response, ExceptionResponse):
            raise Refused(response.exception_code)
        if response.isError():
            raise AssertionError(f"pymodbus: {response}")
        return response

    def holding(self, first, count=1):
        return self.do(self.modbus.read_holding_registers(first, count, self.unit)).registers

    def input(self, first, count=1):
        return self.do(self.modbus.read_input_registers(first, count, self.unit)).registers

    def coils(self, first, count=1):
        return [int(b) for b in self.do(self.modbus.read_coils(first, count, self.unit)).bits[:count]]

    def discrete(self, first, count=1):
        return [int(b) for b in self.do(self.modbus.read_discrete_inputs(first, count, self.unit)).bits[:count]]

    def write_coil(self, at, value):
        self.do(self.modbus.write_coil(at, bool(value), self.unit))

    def write_register(self, at, value):
        self.do(self.modbus.write_register(at, value, self.unit))

    def write_coils(self, first, values):
        self.do(self.modbus.write_coils(first, [bool(v) for v in values], self.unit))

    def write_registers(self, first, values):
        self.do(self.modbus.write_registers(first, values, self.unit))


class Refused(Exception):
    def __init__(self, code):
        super().__init__(f"exception {code:02X}")
        self.code = code


class Device(Program):
    """A field device with its side door."""

    def __init__(self, test, port, unit, *options):
        self.tcp_port = test.free_port()
        super().__init__(test, f"field-device-{unit}", [binary("FIELD_DEVICE"), "--port", port, "--unit", unit,
                                                        "--tcp", self.tcp_port, *options])
        self.ready()
        self.door = Client(test, self.tcp_port, unit)

    def answers(self):
        """Requests that it has answered on its line."""
        high, low = self.door.input(998, 2)
        return high << 16 | low


class InteropTest(unittest.TestCase):
    """A test with a folder of its own, and everything that it started ended after it."""

    def run(self, result=None):
        self.programs = []
        bad = len(result.failures) + len(result.errors)
        with tempfile.TemporaryDirectory(prefix="interop.") as folder:
            self.folder = Path(folder)
            super().run(result)
            if len(result.failures) + len(result.errors) > bad:
                self.show_logs()

    def show_logs(self):
        for program in self.programs:
            log = program.log.splitlines()
            print(f"--- {self.id()}: {program.name}, exit status {program.process.poll()}", file=sys.stderr)
            print("\n".join(log[-200:]), file=sys.stderr, flush=True)

    def free_port(self):
        """A TCP port that nobody else gets while the test runs: it stays bound, but does not listen."""
        reserved = socket.socket()
        reserved.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        reserved.bind(("127.0.0.1", 0))
        self.addCleanup(reserved.close)
        return reserved.getsockname()[1]

    def configuration(self, program=(), units=("main",), dds=None, **more):
        """A configuration with one listener; unit 1 leads to the first of `units`, and so on."""
        return {"gateway": "interop",
                "plcs": [{"name": name, "program": list(program)} for name in units],
                "modbus_tcp": [{"port": self.free_port(),
                                "units": [{"unit": i + 1, "plc": name} for i, name in enumerate(units)]}],
                "dds": {"domain": 1 + os.getpid() % 100, "interface": "lo",
                        "partition": f"interop.{os.getpid()}.{id(self)}", **(dds or {})},
                "control": {"socket": str(self.control_socket)},
                "state": {"folder": str(self.folder / "state")},
                **more}

    @property
    def control_socket(self):
        return self.folder / "control.sock"

    def plc_command(self, *words):
        """plc-gateway plc: its exit status, output and errors."""
        done = subprocess.run([binary("PLC_GATEWAY"), "plc", *words, "--socket", self.control_socket], text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              timeout=PATIENCE, check=False)
        return done.returncode, done.stdout, done.stderr

    def write(self, configuration):
        path = self.folder / "gateway.json"
        path.write_text(configuration if isinstance(configuration, str) else json.dumps(configuration, indent=2))
        return path

    def start_gateway(self, configuration, program=None, **environment):
        return Gateway(self, configuration, program, **environment).listening()

    def start_bus(self, ports=3):
        """A bus of which the gateway opens `folder/line`, and device k `folder/line.k`."""
        arguments = [binary("FIELD_BUS"), "--link", self.folder / "line", "--ports", ports]
        return Program(self, "field-bus", arguments).ready()

    def start_device(self, port, unit, *options):
        return Device(self, self.folder / f"line.{port}", unit, *options)


def binary(name):
    return os.environ[name]


def serial_line(device, **more):
    return {"name": "line", "device": str(device), "parity": "none", **more}


def station(name, unit, **more):
    return {"name": name, "line": "line", "unit": unit, **more}


def route(name, table, first, device, count=1, **more):
    """A route of the station whose name comes before the dot."""
    return {"name": name, "station": name.split(".")[0], "table": table, "first": first, "count": count,
            "plc": "main", "device": device, **more}


def mbpoll(port, table, first, count=1, write=(), unit=1):
    """mbpoll on MODBUS TCP; table is its -t, addresses are zero-based. Returns what it read."""
    command = ["mbpoll", "-m", "tcp", "-p", port, "-a", unit, "-t", table, "-0", "-r", first,
               *([] if write else ["-c", count]), "-1", "-o", "10", "127.0.0.1", *write]
    return mbpoll_values(command)


def mbpoll_values(command):
    """Runs an mbpoll command. Returns what it read."""
    done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, timeout=PATIENCE, check=False)
    if done.returncode != 0:
        raise AssertionError(f"mbpoll: {done.stdout}")
    return [int(value) for value in re.findall(r"^\[\d+\]:\s*(-?\d+)", done.stdout, re.MULTILINE)]


def main():
    done = unittest.main(verbosity=2, exit=False).result
    # A file whose tests are not found would pass without running any.
    sys.exit(0 if done.wasSuccessful() and done.testsRun > 0 else 1)
