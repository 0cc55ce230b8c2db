"""A plant of 1,000 stations on 32 lines with 10,000 routes and 100,000 points, and a tenth of it: what the gateway needs."""

import socket
import time

from support import Bench, Table, configuration, knows_merge, quiet_window, station, wait_for

PLANTS = {"a tenth": (100, 3), "all": (1000, 32)}  # stations, lines
ROUTES = 10     # of a station
REGISTERS = 10  # of a route, each of them a point
PERIOD_MS = 5000
BAUD = 115200
MOVING = 10     # a register changes with every tenth reading


class Plant:
    """Who is on which line, and the configuration of a gateway for it."""

    def __init__(self, stations, lines):
        self.of_line = [[] for _ in range(lines)]
        for i in range(stations):
            self.of_line[i % lines].append(i)
        self.routes = stations * ROUTES

    def wires(self, turnaround_us):
        return [{"baud": BAUD, "delivery": "frame",
                 "stations": [{"unit": at + 1, "turnaround_us": turnaround_us, "moving": MOVING,
                               "registers": ROUTES * 2 * REGISTERS} for at in range(len(here))]}
                for here in self.of_line]

    def configuration(self, bench, wires):
        stations, routes, points = [], [], []
        alone = {"merge": "off"} if knows_merge() else {}
        for line, here in enumerate(self.of_line):
            for at, i in enumerate(here):
                stations.append(station(f"s{i}", at + 1, f"wire{line}", **alone))
                routes += [{"name": f"s{i}.{k}", "station": f"s{i}", "table": "holding", "first": 2 * REGISTERS * k,
                            "count": REGISTERS, "plc": f"plc{line}", "device": f"D{REGISTERS * (at * ROUTES + k)}",
                            "period_ms": PERIOD_MS} for k in range(ROUTES)]
                points += [{"name": f"s{i}.{k // REGISTERS}.{k % REGISTERS}", "plc": f"plc{line}",
                            "device": f"D{at * ROUTES * REGISTERS + k}", "type": "uint16"}
                           for k in range(ROUTES * REGISTERS)]
        made = configuration(bench, wires, stations, routes, plcs=[f"plc{i}" for i in range(len(self.of_line))])
        return {**made, "points": points}


class Status:
    """What the gateway tells systemd: how many routes are up."""

    def __init__(self, folder):
        self.path = str(folder / "notify")
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.socket.bind(self.path)
        self.socket.setblocking(False)
        self.latest = ""

    def all_up(self, routes):
        try:
            while True:
                for field in self.socket.recv(4096).decode().splitlines():
                    if field.startswith("STATUS="):
                        self.latest = field
        except BlockingIOError:
            return self.latest.startswith(f"STATUS={routes} of {routes} ")


def measure(name, options):
    plant = Plant(*PLANTS[name])
    with Bench() as bench:
        wires = bench.wires(*plant.wires(options.turnaround_us))
        status = Status(bench.folder)
        configured = plant.configuration(bench, wires)
        began = time.monotonic_ns()
        gateway = bench.gateway(configured, NOTIFY_SOCKET=status.path)
        listened = time.monotonic_ns()
        wait_for(f"all {plant.routes} routes are up", lambda: status.all_up(plant.routes), 300)
        last = max(each["last_new_block_ns"] for each in wires.report()["lines"])

        def used_processor(seconds):
            before = gateway.cpu_seconds()
            time.sleep(seconds)
            return gateway.cpu_seconds() - before

        window = quiet_window(name, wires, gateway, options, used_processor)
        answered = sum(each["answered"] for each in window.lines)
        return {"window": window, "listens": (listened - began) / 1e9, "all good": (last - began) / 1e9,
                "cpu": sum(window.results) / window.seconds, "MB": gateway.resident_bytes() / 1e6,
                "rate": answered / window.seconds, "wanted": plant.routes / PERIOD_MS * 1000,
                "short": sum(each["short_silences"] for each in window.lines)}


def run(options):
    table = Table(f"scale: {ROUTES} routes of {REGISTERS} registers for each station, every {PERIOD_MS / 1000:.0f} s, "
                  f"{options.seconds} s", ("plant", 10), ("stations", 8), ("lines", 5), ("routes", 6),
                  ("points", 9), ("CPU", 7), ("RSS MB", 7), ("listens s", 9), ("all good s", 10), ("reads/s", 8),
                  ("of wanted", 9), ("too short", 9))
    found = {}
    for name, (stations, lines) in list(PLANTS.items())[:1 if options.tenth else None]:
        of = found[name] = measure(name, options)
        table.row(name, stations, lines, stations * ROUTES, stations * ROUTES * REGISTERS, f"{of['cpu']:.1%}",
                  f"{of['MB']:.1f}", f"{of['listens']:.2f}", f"{of['all good']:.2f}", f"{of['rate']:.1f}",
                  f"{of['rate'] / of['wanted']:.2%}", of["short"], spoiled=of["window"].spoiled)
        Table.target(of["short"] == 0, f"scale: {of['short']} silences are too short")
    if options.tenth:
        return
    tenth, whole = found["a tenth"], found["all"]
    table.row("growth", *("",) * 4, *(f"x {whole[key] / max(tenth[key], 1e-9):.1f}"
                                      for key in ("cpu", "MB", "listens", "all good", "rate")))
