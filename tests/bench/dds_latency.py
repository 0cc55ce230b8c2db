"""From the last byte of an answer on the wire to a subscriber; and what Cyclone itself needs of that."""

import time

from dds_parts import DdsBench, DdsPerf, Reporting, latencies, spread
from support import CannotMeasure, configuration, percentile, quiet_window, station, wait_for

BLOCKS = 4         # of 10 registers, on a wire at 115200
BLOCK_BYTES = 136  # of such a sample: ddsperf's size
PERIOD_MS = 20     # of each
NO_PTY = ("mean_hop_us",)


def block_routes():
    return [{"name": f"block{i}", "station": "device", "table": "holding", "first": 100 * i, "count": 10, "plc": "main",
             "device": f"D{100 * i}", "period_ms": PERIOD_MS} for i in range(BLOCKS)]


class Changing:
    """A gateway that polls a station whose registers change with every read, and a subscriber."""

    def __init__(self, bench, turnaround_us):
        self.wires = bench.wires({"baud": 115200, "stations": [{"unit": 1, "turnaround_us": turnaround_us, "moving": 1}]})
        self.reader = Reporting(bench, "reader", "read")
        configured = configuration(bench, self.wires, [station("device", 1, merge="off")], block_routes())
        self.gateway = bench.gateway({**configured, "dds": bench.dds})
        wait_for("blocks come", lambda: self.reader.report()["blocks"])

    def heard(self, seconds):
        self.reader.report()
        time.sleep(seconds + 0.1)  # what is on its way
        return self.reader.report()["heard"]


def of_changes(changes, heard):
    took = latencies(changes, heard, lambda first: f"block{first // 100}")
    if len(took) < 0.9 * len(changes):
        raise CannotMeasure(f"{len(took)} of {len(changes)} changes came")
    return took


def wire_latencies(options):
    """Of each change, beyond the wire's own time."""
    with DdsBench() as bench:
        changing = Changing(bench, options.turnaround_us)
        window = quiet_window("changes on the wire", changing.wires, changing.gateway, options, changing.heard)
        took = of_changes(window.line["changes"], [each for heard in window.results for each in heard])
        return {**spread(took, window.spoiled), "hop": window.hop_us}


def bare_latencies(options):
    """From before dds_write until the sample is taken, at the pace of the wire."""
    with DdsBench() as bench:
        reader = Reporting(bench, "reader", "read")
        writer = Reporting(bench, "writer", "write", "block", BLOCKS, 1, 1000 * PERIOD_MS // BLOCKS)
        wait_for("blocks come", lambda: reader.report()["blocks"])

        def noted(seconds):
            reader.report()
            time.sleep(seconds)
            return [(at - source) / 1000 for _, _, source, at in reader.report()["heard"]]
        window = quiet_window("bare blocks", bench.witness(), writer, options, noted, NO_PTY)
        return spread([each for took in window.results for each in took], window.spoiled)


def ddsperf_latencies(options):
    """Half of its round trips: it has no one-way latency."""
    with DdsBench() as bench:
        DdsPerf(bench, "pong")
        pings = DdsPerf(bench, "ping", f"{1000 * BLOCKS // PERIOD_MS}Hz", "size", BLOCK_BYTES)
        wait_for("ddsperf has round trips", pings.rows)

        def noted(seconds):
            seen = len(pings.rows())
            time.sleep(seconds)
            return pings.rows()[seen:]
        window = quiet_window("ddsperf's round trips", bench.witness(), pings, options, noted, NO_PTY)
        rows = [each for rows in window.results for each in rows]
        if not rows:
            raise CannotMeasure("ddsperf has no round trips")
        return {"p50": percentile([each["p50_us"] for each in rows], 50) / 2,
                "p99": max(each["p99_us"] for each in rows) / 2, "spoiled": window.spoiled}
