"""How long a client's write of a PLC register takes until it is on the wire, while polling saturates the line."""

import random
import socket
import struct
import time

import bus
from support import (Bench, CannotMeasure, Table, ask, configuration, knows_merge, percentile, quiet_window, station,
                     wait_for)

BAUDS = (19200, 115200)
WRITTEN = 4000  # register of the station
DEVICE = 7000   # of the PLC: D7000, and its holding register
TARGET = 2      # longest transactions


class Writer:
    """A MODBUS TCP client that writes ever new values, with pauses in which the one before has long been written."""

    def __init__(self, port, pause):
        self.connection = socket.create_connection(("127.0.0.1", port), timeout=10)
        self.connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.pause = pause
        self.value = 0
        self.random = random.Random(5)

    def write(self):
        self.value = self.value % 65535 + 1
        began = time.monotonic_ns()
        ask(self.connection, 247, struct.pack(">BHH", 6, DEVICE, self.value))
        return self.value, began

    def during(self, seconds):
        deadline = time.monotonic() + seconds
        asked = []
        while time.monotonic() < deadline:
            asked.append(self.write())
            time.sleep(self.pause * self.random.uniform(1, 2))
        time.sleep(4 * self.pause)
        return asked


def latencies(window):
    """Microseconds of each write of the window."""
    asked = [each for of in window.results for each in of]
    done = {value: end for _, first, value, end in window.line["writes"] if first == WRITTEN}
    if missing := [value for value, _ in asked if value not in done]:
        raise CannotMeasure(f"{len(missing)} of {len(asked)} writes were not on the wire")
    return [(done[value] - began) / 1000 for value, began in asked]


def measure(baud, options):
    with Bench() as bench:
        wires = bench.wires({"baud": baud, "stations": [{"unit": 1, "turnaround_us": options.turnaround_us}]})
        alone = {"merge": "off"} if knows_merge() else {}
        routes = bus.block_routes() + [{"name": "written", "station": "device", "table": "holding", "first": WRITTEN,
                                        "count": 1, "plc": "main", "device": f"D{DEVICE}", "direction": "write"}]
        gateway = bench.gateway(configuration(bench, wires, [station("device", 1, **alone)], routes))
        seen = wait_for("every block is read", lambda: (lines := wires.report()["lines"])[0]["blocks"] >= len(bus.BLOCKS)
                        and lines)
        longest = max(seen[0]["longest_us"], bus.longest_us(baud, options.turnaround_us)) / 1e6
        writer = Writer(gateway.configuration["modbus_tcp"][0]["port"], longest)
        return quiet_window(f"writes at {baud}", wires, gateway, options, writer.during)


def run(options):
    table = Table(f"write: a client writes a register with a write route, line saturated, {options.seconds} s each; until "
                  "the write request is on the wire", ("baud", 7), ("writes", 6), ("longest ms", 10), ("p50 ms", 7),
                  ("p99 ms", 7), ("p50/longest", 11), ("p99/longest", 11), ("too short", 9))
    for baud in options.bauds or BAUDS:
        window = measure(baud, options)
        took, longest = latencies(window), window.line["longest_us"]
        p50, p99 = percentile(took, 50), percentile(took, 99)
        table.row(baud, len(took), f"{longest / 1000:.1f}", f"{p50 / 1000:.1f}", f"{p99 / 1000:.1f}",
                  f"{p50 / longest:.2f}", f"{p99 / longest:.2f}", window.line["short_silences"], spoiled=window.spoiled)
        Table.target(p99 < TARGET * longest, f"write: p99 at {baud} is {p99 / longest:.2f} longest transactions, "
                                             f"target below {TARGET}")
