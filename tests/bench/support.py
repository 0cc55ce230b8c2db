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

PATIENCE = 30  # seconds that anything may take which needs no time of its own
# Beyond one of these, the machine stood still and the figures are not the program's.
MOST = {"stolen": 0.01,           # by the hypervisor, of the processors' time
        "still": 0.002,           # of the time, timers of bench-wire were late
        "worst_late_us": 20_000,  # one of them
        "mean_hop_us": 250,       # a byte through a pty
        "starved": 0.01}          # of the time, the measured program was ready and had no processor
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
        where = "port" if bench.over_tcp else "link"
        self.lines = [{where: free_port() if bench.over_tcp else str(bench.folder / f"wire{i}"), **each}
                      for i, each in enumerate(lines)]
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

    over_tcp = False  # the lines are behind device servers

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
            "lines": [{"name": f"wire{i}", **where(each), "baud_rate": each["baud"], **line}
                      for i, each in enumerate(wires.lines)],
            "stations": stations, "routes": routes,
            "modbus_tcp": [{"port": free_port(), "units": [{"unit": 247, "plc": plcs[0]}, *units]}],
            "dds": {"domain": 1 + os.getpid() % 100, "interface": "lo", "partition": f"bench.{os.getpid()}"},
            "control": {"socket": str(bench.folder / "control.sock")}}


def where(line):
    return {"device": line["link"]} if "link" in line else {"host": "127.0.0.1", "port": line["port"]}


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


class Slice:
    """A few seconds of a running load: what the wires saw, and whether the machine stood still."""

    def __init__(self, wires, program, seconds, during=None, ignored=()):
        wires.report()
        starved, began = program.starved(), time.monotonic()
        self.result = during(seconds) if during else time.sleep(seconds)
        self.seconds = time.monotonic() - began
        report = wires.report()
        self.lines = report["lines"]
        self.machine = {**report["machine"], "starved": (program.starved() - starved) / self.seconds}
        self.spoiled = any(self.machine[what] > most for what, most in MOST.items()
                           if what not in ignored and (what != "mean_hop_us" or not Bench.over_tcp))

    def badness(self):
        return self.machine["still"] + self.machine["starved"] + self.machine["mean_hop_us"] / 1e4

    def why(self):
        return (f"stolen {self.machine['stolen']:.1%}, timers late {self.machine['still']:.2%} (worst "
                f"{self.machine['worst_late_us'] / 1000:.1f} ms), a byte through a pty {self.machine['mean_hop_us']:.0f} us, "
                f"waited for a processor {self.machine['starved']:.2%}")


class Window:
    """Slices of a load, added up. None of them cuts a transaction, so there may be anything between them."""

    def __init__(self, slices):
        self.spoiled = any(each.spoiled for each in slices)
        self.seconds = sum(each.seconds for each in slices)
        self.results = [each.result for each in slices]
        self.hop_us = sum(each.machine["mean_hop_us"] for each in slices) / len(slices)
        self.lines = [added_up(lines) for lines in zip(*(each.lines for each in slices))]
        self.line = self.lines[0]


def added_up(reports):
    """Reports of one line as one: what is counted is added, also where it stands deeper."""
    sums = dict(reports[0])
    for more in reports[1:]:
        for key, value in more.items():
            if key == "least_silence_us":
                sums[key] = min(sums[key], value) if None not in (sums[key], value) else sums[key] or value
            elif key in ("longest_us", "blocks", "last_new_block_ns"):
                sums[key] = max(sums[key], value)
            elif isinstance(value, dict):
                sums[key] = added_up([sums[key], value]) if key in sums else value
            elif key not in sums:
                sums[key] = value
            elif key not in ("link", "baud", "rule_us"):
                sums[key] = sums[key] + value
    return sums


def quiet_window(what, wires, program, options, during=None, ignored=()):
    """Slices in which the machine did not stand still, until they are long enough together. Where there are none, the
    least bad one, marked as spoiled. `ignored` of MOST is what the load does to itself."""
    good, spoiled = [], []
    deadline = time.monotonic() + PATIENCE + 2 * options.seconds
    while sum(each.seconds for each in good) < options.seconds:
        one = Slice(wires, program, min(options.slice, options.seconds), during, ignored)
        (spoiled if one.spoiled else good).append(one)
        if time.monotonic() > deadline:
            break
    if spoiled:
        worst = max(spoiled, key=Slice.badness)
        print(f"  {what}: {len(spoiled)} of {len(good) + len(spoiled)} slices were spoiled: the machine stood still "
              f"(the worst: {worst.why()})", file=sys.stderr, flush=True)
    return Window(good or [min(spoiled, key=Slice.badness)])


def efficiency(line):
    """The time that the answered requests need at least, of the time that they took."""
    if line["answered"] < 2:
        raise CannotMeasure(f"{line['answered']} requests were answered on {line['link']}: {line}")
    return line["ideal_us"] / line["elapsed_us"]


def typical(line):
    """The same if every silence had been as long as the median one: what the machine's hiccups leave out."""
    return line["ideal_us"] / (line["ideal_us"] + percentile(line["excess_us"], 50) * (line["answered"] - 1))


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
