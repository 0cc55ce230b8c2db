"""MODBUS TCP clients that read a station through a unit id, while the line polls another for half of its time."""

import selectors
import socket
import struct
import time

import bus
from support import (Bench, CannotMeasure, Table, configuration, efficiency, knows_merge, percentile, quiet_window,
                     station, wait_for)

CLIENTS = (1, 2, 4, 8, 16, 32, 64)
BAUD = 115200
REGISTERS = 10
POLLS = 0.5  # of the line's time
UNIT = 100   # of the forwarded station, for the clients


class Client:
    """Asks, and asks again when the answer is there."""

    def __init__(self, port, number):
        self.connection = socket.create_connection(("127.0.0.1", port), timeout=10)
        self.connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        # Input registers, and each client its own: nobody may answer two of them with one request.
        self.pdu = struct.pack(">BHH", 4, 32 * number, REGISTERS)
        self.received = b""
        self.latencies = []
        self.refused = 0

    def ask(self):
        self.received = b""
        self.began = time.monotonic()
        self.connection.sendall(struct.pack(">HHHB", 1, 0, len(self.pdu) + 1, UNIT) + self.pdu)

    def hear(self):
        piece = self.connection.recv(4096)
        if not piece:
            raise CannotMeasure("the gateway closed a connection")
        self.received += piece
        if len(self.received) < 9:
            return
        size = struct.unpack_from(">H", self.received, 4)[0]
        if len(self.received) < 6 + size:
            return
        if self.received[7] != 4:
            self.refused += 1
        else:
            self.latencies.append(time.monotonic() - self.began)
        self.ask()


class Clients:
    def __init__(self, port, count):
        self.all = [Client(port, i) for i in range(count)]
        self.selector = selectors.DefaultSelector()
        for each in self.all:
            self.selector.register(each.connection, selectors.EVENT_READ, each)
            each.ask()

    def during(self, seconds):
        for each in self.all:
            each.latencies, each.refused = [], 0
        deadline = time.monotonic() + seconds
        while (left := deadline - time.monotonic()) > 0:
            for key, _ in self.selector.select(left):
                key.data.hear()
        return [each.latencies for each in self.all], sum(each.refused for each in self.all)


def measure(count, options):
    with Bench() as bench:
        device = {"turnaround_us": options.turnaround_us}
        wires = bench.wires({"baud": BAUD, "stations": [{"unit": 1, **device}, {"unit": 2, **device}]})
        alone = {"merge": "off"} if knows_merge() else {}
        cycle_us = sum(bus.ideal_us(BAUD, 8, 5 + 2 * size, options.turnaround_us) for size in bus.SIZES)
        configured = configuration(bench, wires, [station("device", 1, **alone), station("asked", 2, **alone)],
                                   bus.block_routes(round(cycle_us / 1000 / POLLS)),
                                   units=[{"unit": UNIT, "line": "wire0", "line_unit": 2}])
        gateway = bench.gateway(configured)
        wait_for("every block is read", lambda: wires.report()["lines"][0]["blocks"] >= len(bus.BLOCKS))
        clients = Clients(configured["modbus_tcp"][0]["port"], count)
        clients.during(0.5)
        return quiet_window(f"{count} clients", wires, gateway, options, clients.during)


def run(options):
    table = Table(f"forward: clients that read {REGISTERS} registers each at {BAUD}, while polling takes "
                  f"{POLLS:.0%} of the line, {options.seconds} s each", ("clients", 7), ("requests/s", 10),
                  ("bound", 7), ("rate/bound", 10), ("line used", 9), ("polls kept", 10), ("p50 ms", 8), ("p99 ms", 8),
                  ("least/most", 10), ("refused", 7), ("too short", 9))
    for count in options.clients or CLIENTS:
        window = measure(count, options)
        line = window.line
        latencies = [sum(of, []) for of in zip(*(slice_latencies for slice_latencies, _ in window.results))]
        refused = sum(slice_refused for _, slice_refused in window.results)
        polled, forwarded = (line["functions"].get(code, {"answered": 0, "ideal_us": 0}) for code in ("3", "4"))
        if not forwarded["answered"] or not all(latencies):
            raise CannotMeasure(f"{count} clients: some got no answer")
        rate = forwarded["answered"] / line["elapsed_us"] * 1e6
        bound = (line["elapsed_us"] - polled["ideal_us"]) / (forwarded["ideal_us"] / forwarded["answered"]) \
            / line["elapsed_us"] * 1e6
        took = [each for of in latencies for each in of]
        counts = [len(of) for of in latencies]
        table.row(count, f"{rate:.1f}", f"{bound:.1f}", f"{rate / bound:.2%}", f"{efficiency(line):.2%}",
                  f"{polled['ideal_us'] / line['elapsed_us'] / POLLS:.2%}", f"{percentile(took, 50) * 1000:.1f}",
                  f"{percentile(took, 99) * 1000:.1f}", f"{min(counts) / max(counts):.3f}", refused,
                  line["short_silences"], spoiled=window.spoiled)
        Table.target(line["short_silences"] == 0, f"forward: {line['short_silences']} silences are too short")
