"""The pace of the healthy stations of a line on which others are dead."""

import argparse

from support import Bench, Table, configuration, efficiency, quiet_window, station, wait_for

STATIONS = 20
BAUD = 19200
REGISTERS = 20
DEAD = (0, 2, 10, 18)
PROBES = 0.05  # of the line's time, at most, for the dead
TARGET = 0.9
SLICE = 10     # seconds


def measure(dead, options):
    # The dead are spread among the others.
    is_dead = [i * dead // STATIONS != (i + 1) * dead // STATIONS for i in range(STATIONS)]
    with Bench() as bench:
        wires = bench.wires({"baud": BAUD, "stations": [
            {"unit": i + 1, "turnaround_us": options.turnaround_us, "dead": is_dead[i]} for i in range(STATIONS)]})
        routes = [{"name": f"r{i}", "station": f"s{i}", "table": "holding", "first": 0, "count": REGISTERS,
                   "plc": "main", "device": f"D{REGISTERS * i}", "period_ms": 10} for i in range(STATIONS)]
        stations = [station(f"s{i}", i + 1) for i in range(STATIONS)]
        gateway = bench.gateway(configuration(bench, wires, stations, routes, response_timeout_ms=300))
        wait_for(f"{dead} stations are found dead", lambda: gateway.log().count("does not answer") >= dead, 60)
        wait_for("the others are read", lambda: wires.report()["lines"][0]["blocks"] == STATIONS - dead)
        # Long enough for a probe and the time that it has to wait for.
        longer = argparse.Namespace(**{**vars(options), "slice": max(options.slice, SLICE)})
        return quiet_window(f"{dead} dead", wires, gateway, longer)


def run(options):
    table = Table(f"dead: {STATIONS} stations at {BAUD}, saturated, {options.seconds} s each", ("dead", 5),
                  ("healthy reads/s", 15), ("used/bound", 10), ("wire allows", 11), ("used/allowed", 12), ("of none dead", 12),
                  ("probes", 6), ("slowest/fastest", 15), ("too short", 9))
    unharmed = None  # used while nobody is dead: what this machine leaves of the wire
    for dead in DEAD:
        window = measure(dead, options)
        line, allowed = window.line, 1 - (PROBES if dead else 0)
        used = efficiency(line)
        of_none_dead = used / allowed / (unharmed := unharmed or used)
        each = [of["answered"] for of in line["units"].values()]
        table.row(f"{dead / STATIONS:.0%}", f"{line['answered'] / line['elapsed_us'] * 1e6:.2f}", f"{used:.2%}",
                  f"{allowed:.0%}", f"{used / allowed:.2%}", f"{of_none_dead:.2%}", line["unanswered"],
                  f"{min(each) / max(each):.3f}", line["short_silences"], spoiled=window.spoiled)
        Table.target(used / allowed >= TARGET, f"dead: with {dead} dead the healthy use {used / allowed:.2%} of what "
                                               f"the wire allows them, target {TARGET:.0%}")
        Table.target(line["short_silences"] == 0, f"dead: {line['short_silences']} silences are too short")
