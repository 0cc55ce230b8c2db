"""What the benchmarks share: programs that end with them, emulated wires, windows of measurement, tables."""

import ctypes
import json
import os
import resource
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PATIENCE = 30   # seconds that anything may take which needs no time of its own
TRIES = 5       # runs until one is not spoiled
STARVED = 0.01  # of the window: a program that waited longer for a processor did not have the machine
LIBC = ctypes.CDLL(None)
PR_SET_PDEATHSIG = 1
REALTIME = "BENCH_REALTIME"  # in the environment: the measured programs run before all ordinary ones


class CannotMeasure(Exception):
    pass


def wait_for(what, condition, seconds=PATIENCE):
    """Looks until the condition holds, and returns what it returned."""
    deadline = time.monotonic() + seconds
    while True:
        found = condition()
        if found:
            return found
        if time.monotonic() > deadline:
            raise CannotMeasure(f"not within {seconds} s: {what}")
        time.sleep(0.01)


def urgent():
    LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    try:
        os.nice(-15 - os.nice(0))
        if REALTIME in os.environ:
            os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(1))
    except OSError:
        pass  # not permitted: others on this machine spoil more runs


class Program:
    def __init__(self, bench, name, arguments, **environment):
        self.name = name
        self.log_file = bench.folder / f"{name}-{len(bench.programs)}.log"
        with open(self.log_file, "wb") as log:
            self.process = subprocess.Popen([str(each) for each in arguments], stdin=subprocess.DEVNULL, stdout=log,
                                            stderr=log, cwd=bench.folder, env={**os.environ, **environment},
                                            preexec_fn=urgent)
        bench.programs.append(self)

    def log(self):
        return self.log_file.read_text(errors="replace")

    def said(self, words):
        """Waits until it has printed them."""
        wait_for(f"{self.name} says {words!r}: {self.log()[-2000:]}",
                 lambda: words in self.log() or self.process.poll() is not None)
        if self.process.poll() is not None:
            raise CannotMeasure(f"{self.name} ended: {self.log()[-2000:]}")
        return self

    def stop(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            try:
                self.process.wait(10)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()

    def starved(self):
        """Seconds that its main thread was ready but had no processor."""
        fields = Path(f"/proc/{self.process.pid}/schedstat").read_text().split()
        return int(fields[1]) / 1e9

    def cpu_seconds(self):
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def resident_bytes(self):
        return int(Path(f"/proc/{self.process.pid}/statm").read_text().split()[1]) * resource.getpagesize()


class Wires(Program):
    """bench-wire: lines are rows of {baud, stations, delivery}; each gets a port in the bench's folder."""

    def __init__(self, bench, lines):
        self.lines = [{"link": str(bench.folder / f"wire{i}"), **each} for i, each in enumerate(lines)]
        self.reports_file = bench.folder / f"reports-{len(bench.programs)}.json"
        self.reports_file.touch()
        plan = bench.folder / f"plan-{len(bench.programs)}.json"
        plan.write_text(json.dumps({"lines": self.lines}))
        super().__init__(bench, "bench-wire", [os.environ["BENCH_WIRE"], plan, self.reports_file])
        self.said("lines")
        self.taken = 0

    def report(self):
        """What it measured since the last report."""
        self.process.send_signal(signal.SIGUSR1)
        lines = wait_for("a report of bench-wire", self.more_reports)
        self.taken = len(lines)
        return json.loads(lines[-1])

    def more_reports(self):
        text = self.reports_file.read_text()
        lines = text[:text.rfind("\n") + 1].splitlines()
        return lines if len(lines) > self.taken else None


class Bench:
    """A folder and programs for one measurement; a context that ends them."""

    def __enter__(self):
        self.programs = []
        self.made = tempfile.TemporaryDirectory(prefix="bench.")
        self.folder = Path(self.made.name)
        return self

    def __exit__(self, *_):
        for each in reversed(self.programs):
            each.stop()
        self.made.cleanup()

    def wires(self, *lines):
        return Wires(self, lines)

    def gateway(self, configuration, **environment):
        file = self.folder / "gateway.json"
        file.write_text(json.dumps(configuration, indent=1))
        gateway = Program(self, "plc-gateway", [os.environ["PLC_GATEWAY"], "run", file], **environment)
        gateway.configuration = configuration
        return gateway.said("MODBUS TCP listens on")


def configuration(bench, wires, stations, routes, units=(), plcs=("main",), **line):
    """A gateway's: wire k is line `wirek`."""
    return {"gateway": "bench", "plcs": [{"name": each} for each in plcs],
            "lines": [{"name": f"wire{i}", "device": each["link"], "baud_rate": each["baud"], **line}
                      for i, each in enumerate(wires.lines)],
            "stations": stations, "routes": routes,
            "modbus_tcp": [{"port": free_port(), "units": [{"unit": 247, "plc": plcs[0]}, *units]}],
            "dds": {"domain": 1 + os.getpid() % 100, "interface": "lo", "partition": f"bench.{os.getpid()}"},
            "control": {"socket": str(bench.folder / "control.sock")}}


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def station(name, unit, line="wire0", **more):
    return {"name": name, "line": line, "unit": unit, **more}


def knows_merge():
    """Whether this gateway has the station key `merge`."""
    schema = subprocess.run([os.environ["PLC_GATEWAY"], "schema"], stdout=subprocess.PIPE, check=True).stdout
    return b'"merge"' in schema


class Window:
    """One measurement of a running load: what the wires saw, and whether the machine stood still."""

    def __init__(self, wires, program, seconds, during=None):
        wires.report()
        starved = program.starved()
        began = time.monotonic()
        self.result = during(seconds) if during else time.sleep(seconds)
        self.seconds = time.monotonic() - began
        self.starved = (program.starved() - starved) / self.seconds
        report = wires.report()
        self.machine = report["machine"]
        self.urgent = report["urgent"]
        self.lines = report["lines"]
        self.line = self.lines[0]
        self.spoiled = self.machine["spoiled"] or self.starved > STARVED

    def why(self):
        return (f"stolen {self.machine['stolen']:.1%}, timers stood still {self.machine['still']:.2%} (worst "
                f"{self.machine['worst_late_us'] / 1000:.1f} ms), a byte through a pty {self.machine['mean_hop_us']:.0f} us, waited for a processor {self.starved:.2%}")


def quiet_window(what, wires, program, seconds, during=None):
    """Measures until the machine did not stand still meanwhile. The best of spoiled runs counts, and says so."""
    best = None
    for _ in range(TRIES):
        window = Window(wires, program, seconds, during)
        if not window.spoiled:
            return window
        print(f"  {what}: the machine stood still ({window.why()}), again", file=sys.stderr, flush=True)
        if best is None or window.machine["still"] + window.starved < best.machine["still"] + best.starved:
            best = window
    return best


def efficiency(line):
    """The time that the answered requests need at least, of the time that they took."""
    if line["answered"] < 2:
        raise CannotMeasure(f"{line['answered']} requests were answered on {line['link']}: {line}")
    return line["ideal_us"] / line["elapsed_us"]


def percentile(values, percent):
    ordered = sorted(values)
    return ordered[int((len(ordered) - 1) * percent / 100)]


class Table:
    """Prints rows as they come, and remembers which targets were missed."""

    missed = []

    def __init__(self, title, *columns):
        print(f"\n{title}\n" + "  ".join(f"{name:>{width}}" for name, width in columns), flush=True)
        self.widths = [width for _, width in columns]

    def row(self, *values, spoiled=False):
        cells = "  ".join(f"{value!s:>{width}}" for value, width in zip(values, self.widths))
        print(cells + ("  (spoiled)" if spoiled else ""), flush=True)

    @classmethod
    def target(cls, met, sentence):
        if not met:
            cls.missed.append(sentence)


def receive(connection, size):
    data = b""
    while len(data) < size:
        piece = connection.recv(size - len(data))
        if not piece:
            raise CannotMeasure("the gateway closed a connection")
        data += piece
    return data


def ask(connection, unit, pdu):
    """One MODBUS TCP request on a blocking socket. Returns the PDU of the answer."""
    connection.sendall(struct.pack(">HHHB", 1, 0, len(pdu) + 1, unit) + pdu)
    length = struct.unpack(">HHHB", receive(connection, 7))[2]
    return receive(connection, length - 1)
