"""What the DDS benchmarks share: bench-dds, ddsperf, and the arithmetic."""

import json
import os
import re
import signal
import subprocess
from pathlib import Path

from support import Bench, CannotMeasure, Program, percentile, wait_for


class DdsBench(Bench):
    """With a DDS domain, and an idle wire that notices when the machine stands still."""

    def __enter__(self):
        self.dds = {"domain": 1 + os.getpid() % 100, "interface": "lo", "partition": f"bench.{os.getpid()}"}
        return super().__enter__()

    def witness(self):
        return self.wires({"baud": 9600, "stations": []})


class Reporting(Program):
    """bench-dds: reports what it counted since the last time."""

    def __init__(self, bench, name, *arguments):
        self.reports_file = bench.folder / f"dds-{len(bench.programs)}.json"
        self.reports_file.touch()
        place = bench.dds["domain"], bench.dds["partition"]
        super().__init__(bench, name, [os.environ["BENCH_DDS"], *arguments[:1], *place, self.reports_file, *arguments[1:]])
        self.said("ready")
        self.taken = 0

    def report(self):
        self.process.send_signal(signal.SIGUSR1)
        line = wait_for("a report of bench-dds", self.next_report)
        self.taken += 1
        return json.loads(line)

    def next_report(self):
        lines = self.reports_file.read_text().split("\n")
        return lines[self.taken] if len(lines) > self.taken + 1 else None

    def starved(self):
        return of_all_threads(self, 1)


class DdsPerf(Program):
    """ddsperf with the gateway's settings; its lines of statistics are counted, one for each second."""

    def __init__(self, bench, *arguments):
        xml = subprocess.run([os.environ["BENCH_DDS"], "xml"], stdout=subprocess.PIPE, text=True, check=True).stdout
        super().__init__(bench, f"ddsperf-{arguments[-1]}", ["ddsperf", "-i", bench.dds["domain"], *arguments],
                         CYCLONEDDS_URI=xml)

    def rows(self):
        return ddsperf_rows(self.log())

    def starved(self):
        return of_all_threads(self, 1)


def ddsperf_rows(text):
    """What ddsperf prints each second: {"samples", "p50_us", "p99_us"}, as far as it is on the line."""
    rows = []
    for line in text.splitlines():
        samples = re.search(r" total \d+ lost \d+ delta (\d+) lost", line)
        trips = re.search(r" 50% ([\d.]+)us .* 99% ([\d.]+)us .* cnt \d+", line)
        if samples:
            rows.append({"samples": int(samples.group(1))})
        if trips:
            rows.append({"p50_us": float(trips.group(1)), "p99_us": float(trips.group(2))})
    return rows


def of_all_threads(program, column):
    """Seconds that its threads ran (column 0), or were ready and had no processor (1); to the nanosecond."""
    tasks = Path(f"/proc/{program.process.pid}/task")
    return sum(int((each / "schedstat").read_text().split()[column]) for each in tasks.iterdir()) / 1e9


def processor_seconds(program):
    return of_all_threads(program, 0)


def latencies(changes, heard, route_of):
    """Microseconds from the end of an answer on the wire until a subscriber had the value, each change once.

    `changes` are [unit, first, value, end_ns], `heard` [route, value, source_ns, at_ns].
    """
    came = {(route, value): at for route, value, _, at in reversed(heard)}  # the first of several
    keyed = [((route_of(first), value), end) for _, first, value, end in changes]
    return [(came[key] - end) / 1000 for key, end in keyed if key in came]


def rates(window):
    """Samples per second, and microseconds of a processor for each: of the publisher, of the reader."""
    total = {key: sum(each[key] for each in window.results) for key in window.results[0]}
    if total["samples"] == 0:
        raise CannotMeasure("no sample came")
    return {"rate": total["samples"] / total["seconds"], "publisher": total["publisher"] / total["samples"] * 1e6,
            "reader": total["reader"] / total["samples"] * 1e6, "spoiled": window.spoiled}


def spread(values, spoiled=False):
    if not values:
        raise CannotMeasure("no change came")
    return {"p50": percentile(values, 50), "p99": percentile(values, 99), "count": len(values), "spoiled": spoiled}


def memory_per_thousand(resident, counts):
    """Kilobytes that 1,000 more instances need; `resident` says bytes with so many."""
    fewer, more = (resident(count) for count in counts)
    return (more - fewer) / (counts[1] - counts[0])  # bytes for one: kilobytes for 1,000
