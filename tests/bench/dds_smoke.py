"""The arithmetic of the DDS benchmarks, and seconds of them, for ctest: what is added up fits together, not how fast it is."""

import dds_latency
import dds_parts
from support import CannotMeasure, Slice, wait_for

SECONDS = 2
SUB = "[576] 2.001  size 120 total 4920 lost 0 delta 2460 lost 0 rate 2.46 kS/s 2.36 Mb/s (0.49 kS/s 0.47 Mb/s)"
PING = "[703] 3.000  vm:704 size 120 mean 92.3us min 82.9us 50% 92.5us 90% 95.7us 99% 101.2us max 101.2us cnt 50"


def same(what, found, expected):
    if found != expected:
        raise CannotMeasure(f"{what}: {found} instead of {expected}")


def arithmetic():
    same("ddsperf's lines", dds_parts.ddsperf_rows(f"[1] participant vm:1: new\n{SUB}\n[1] 2.001 rss:7.5MB vcsw:27\n{PING}\n"),
         [{"samples": 2460}, {"p50_us": 92.5, "p99_us": 101.2}])
    changes = [[1, 100, 7, 1_000_000], [1, 100, 8, 2_000_000], [1, 200, 7, 3_000_000]]
    heard = [["block1", 7, 0, 1_250_000], ["block1", 7, 0, 9_000_000], ["block2", 7, 0, 3_500_000], ["block3", 1, 0, 4_000_000]]
    same("latencies", dds_parts.latencies(changes, heard, lambda first: f"block{first // 100}"), [250, 500])
    same("memory", dds_parts.memory_per_thousand(lambda count: 5_000_000 + 4000 * count, (1000, 11000)), 4000)

    class Window:
        spoiled = False
        results = [{"samples": 100, "seconds": 1, "publisher": 0.01, "reader": 0.02},
                   {"samples": 300, "seconds": 3, "publisher": 0.03, "reader": 0.02}]
    same("rates", dds_parts.rates(Window), {"rate": 100, "publisher": 100, "reader": 100, "spoiled": False})


def changes_on_a_wire(options):
    with dds_parts.DdsBench() as bench:
        changing = dds_latency.Changing(bench, options.turnaround_us)
        one = Slice(changing.wires, changing.gateway, SECONDS, changing.heard)
        took = dds_latency.of_changes(one.lines[0]["changes"], one.result)
        if not took or min(took) <= 0:
            raise CannotMeasure(f"{len(took)} changes came, one of them {min(took, default=0)} us after it was on the wire")
        return len(took)


def bare_writer():
    with dds_parts.DdsBench() as bench:
        reader = dds_parts.Reporting(bench, "reader", "read")
        writer = dds_parts.Reporting(bench, "writer", "write", "point", 50, 10, 20_000)
        came = wrote = 0

        def enough():
            nonlocal came, wrote
            came += reader.report()["points"]  # before: all of these were written
            report = writer.report()
            wrote += report["written"]
            same("samples that failed", report["failed"], 0)
            return came >= 500
        wait_for("500 samples", enough)
        if came > wrote:
            raise CannotMeasure(f"{came} samples came, {wrote} were written")
        return came


def run(options):
    arithmetic()
    print(f"dds_smoke: {changes_on_a_wire(options)} changes, {bare_writer()} samples of a bare writer")
