"""How much of the wire's time a saturated line uses, at four baud rates; and how often the silence is too short."""

import os
import subprocess
import sys
from pathlib import Path

from support import (Bench, CannotMeasure, Program, Table, configuration, efficiency, knows_merge, percentile,
                     quiet_window, station, typical, wait_for)

SIZES = (10, 20, 33, 45, 58, 71, 84, 97, 110, 125)
BLOCKS = [(300 * i, size) for i, size in enumerate(SIZES)]  # too far apart for one request to hold two
BAUDS = (9600, 19200, 57600, 115200)
TARGETS = {9600: 0.99, 19200: 0.99, 57600: 0.96, 115200: 0.96}
BESIDE = Path(__file__).parent


def ideal_us(baud, request, response, turnaround_us):
    """What a transaction needs at least: both silences, both frames, and the station's time."""
    silence = 1750 if baud > 19200 else 3.5 * 11e6 / baud
    return (request + response) * 11e6 / baud + 2 * silence + turnaround_us


def longest_us(baud, turnaround_us):
    return ideal_us(baud, 8, 5 + 2 * SIZES[-1], turnaround_us)


def block_routes(period_ms=10):
    return [{"name": f"block{i}", "station": "device", "table": "holding", "first": first, "count": count,
             "plc": "main", "device": f"D{125 * i}", "period_ms": period_ms}
            for i, (first, count) in enumerate(BLOCKS)]


def gateway(bench, wires):
    alone = {"merge": "off"} if knows_merge() else {}
    return bench.gateway(configuration(bench, wires, [station("device", 1, **alone)], block_routes()))


def libmodbus(bench, wires):
    line = wires.lines[0]
    return Program(bench, "libmodbus", [os.environ["LIBMODBUS_LOOP"], line["link"], line["baud"], 1,
                                        *(f"{first}:{count}" for first, count in BLOCKS)])


def pymodbus(bench, wires):
    line = wires.lines[0]
    return Program(bench, "pymodbus", ["/usr/bin/python3", "-B", BESIDE / "pymodbus_loop.py", line["link"],
                                       line["baud"], 1, *(f"{first}:{count}" for first, count in BLOCKS)])


def has_pymodbus():
    return subprocess.run(["/usr/bin/python3", "-c", "import pymodbus, serial"], stderr=subprocess.DEVNULL,
                          check=False).returncode == 0


def measure(start, baud, options):
    with Bench() as bench:
        wires = bench.wires({"baud": baud, "delivery": options.delivery,
                             "stations": [{"unit": 1, "turnaround_us": options.turnaround_us}]})
        program = start(bench, wires)
        try:
            wait_for("every block is read", lambda: wires.report()["lines"][0]["blocks"] == len(BLOCKS))
        except CannotMeasure as why:
            raise CannotMeasure(f"{why}: {program.log()[-1000:]}") from why
        return quiet_window(f"{program.name} at {baud}", wires, program, options)


def run(options):
    programs = {"gateway": gateway, "libmodbus": libmodbus, "pymodbus": pymodbus}
    if not has_pymodbus():
        print("bus: left out: /usr/bin/python3 has no pymodbus", file=sys.stderr)
        del programs["pymodbus"]
    if options.tcp:
        programs = {"gateway": gateway}
    chosen = [each for each in options.programs.split(",") if each in programs] if options.programs else programs
    table = Table(f"bus: 10 blocks of 10 to 125 registers, line saturated, {options.seconds} s each, delivery by "
                  f"{options.delivery}", ("baud", 7), ("program", 10), ("used/bound", 10), ("typical", 8), ("requests", 8),
                  ("too short", 9), ("collisions", 10), ("least silence/rule", 18), ("beyond rule us p50", 18),
                  ("p99", 7), ("pty us", 6))
    for baud in options.bauds or BAUDS:
        for name in chosen:
            window = measure(programs[name], baud, options)
            line, used = window.line, efficiency(window.line)
            table.row(baud, name, f"{used:.2%}", f"{typical(line):.2%}", line["answered"], line["short_silences"], line["collisions"],
                      f"{line['least_silence_us'] / line['rule_us']:.3f}", f"{percentile(line['excess_us'], 50):.0f}",
                      f"{percentile(line['excess_us'], 99):.0f}", f"{window.hop_us:.0f}", spoiled=window.spoiled)
            if name != "gateway":
                continue
            Table.target(line["short_silences"] + line["collisions"] + line["torn_requests"] == 0,
                         f"bus: {line['short_silences']} silences at {baud} are too short")
            Table.target(used >= TARGETS.get(baud, 0) or options.delivery == "fifo",
                         f"bus: {used:.2%} at {baud}, target {TARGETS.get(baud, 0):.0%}")
