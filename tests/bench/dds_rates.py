"""Samples of points per second, and the processor's time for each: the gateway's, a bare writer's, ddsperf's."""

import contextlib
import os
import socket
import struct
import time

from dds_memory import gateway_of_points
from dds_parts import DdsBench, DdsPerf, Reporting, processor_seconds, rates
from support import CannotMeasure, ask, quiet_window, wait_for

POINTS = 123      # of one MODBUS write
POINT_BYTES = 96  # of such a sample: ddsperf's size
PACE = 20         # writes per second of the paced load
UNIT = 247
# Several processes share the processors here, and keep each other and the kernel waiting: part of the load.
OWN = ("starved", "mean_hop_us")


@contextlib.contextmanager
def as_urgent_as_the_measured():
    """Who makes the load of them must not wait for others on this machine."""
    before = os.getpriority(os.PRIO_PROCESS, 0)
    with contextlib.suppress(PermissionError):
        os.setpriority(os.PRIO_PROCESS, 0, -15)
    try:
        yield
    finally:
        os.setpriority(os.PRIO_PROCESS, 0, before)


class Load:
    """Who publishes, and who reads: what both used and how many samples came, in one slice."""

    def __init__(self, publisher, reader, count):
        self.publisher, self.reader, self.count = publisher, reader, count

    def during(self, work):
        def measured(seconds):
            self.count()
            before = [processor_seconds(each) for each in (self.publisher, self.reader)]
            began = time.monotonic()
            work(seconds)
            samples, took = self.count(), time.monotonic() - began
            used = [processor_seconds(each) - was for each, was in zip((self.publisher, self.reader), before)]
            return {"samples": samples, "seconds": took, "publisher": used[0], "reader": used[1]}
        return measured


class Writer:
    """MODBUS TCP clients that change all points with each write; several, so that the gateway never waits for them."""

    def __init__(self, port, clients=8):
        self.connections = [socket.create_connection(("127.0.0.1", port), timeout=10) for _ in range(clients)]
        for each in self.connections:
            each.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.value = 0

    def pdu(self):
        self.value = self.value % 65535 + 1
        return struct.pack(">BHHB", 16, 0, POINTS, 2 * POINTS) + struct.pack(">H", self.value) * POINTS

    def write_each(self):
        for each in self.connections:
            pdu = self.pdu()
            each.sendall(struct.pack(">HHHB", 1, 0, len(pdu) + 1, UNIT) + pdu)
        for each in self.connections:
            if each.recv(64)[7] != 16:
                raise CannotMeasure("the gateway refused a write")

    def saturate(self, seconds):
        deadline = time.monotonic() + seconds
        with as_urgent_as_the_measured():
            while time.monotonic() < deadline:
                self.write_each()

    def pace(self, seconds):
        began = time.monotonic()
        for i in range(int(seconds * PACE)):
            time.sleep(max(0, began + i / PACE - time.monotonic()))
            ask(self.connections[0], UNIT, self.pdu())
        time.sleep(max(0, began + seconds - time.monotonic()))


def measure_gateway(paced, options):
    with DdsBench() as bench:
        reader = Reporting(bench, "reader", "read")
        gateway = gateway_of_points(bench, POINTS)
        writer = Writer(gateway.configuration["modbus_tcp"][0]["port"])
        wait_for("points came", lambda: reader.report()["points"])
        load = Load(gateway, reader, lambda: reader.report()["points"])
        work = load.during(writer.pace if paced else writer.saturate)
        return rates(quiet_window("the gateway's points", bench.witness(), gateway, options, work, OWN))


def measure_bare(paced, options):
    with DdsBench() as bench:
        reader = Reporting(bench, "reader", "read")
        writer = Reporting(bench, "writer", "write", "point", POINTS, POINTS, 1_000_000 // PACE if paced else 0)
        wait_for("points came", lambda: reader.report()["points"])
        load = Load(writer, reader, lambda: reader.report()["points"])
        return rates(quiet_window("the bare writer's points", bench.witness(), writer, options, load.during(time.sleep), OWN))


def measure_ddsperf(paced, options):
    """Its topic KS with as many octets, reliable and keep-last 1, but volatile: it cannot do otherwise."""
    with DdsBench() as bench:
        common = ("-n", str(POINTS), "-k", "1")
        reader = DdsPerf(bench, *common, "sub")
        writer = DdsPerf(bench, *common, "pub", *((f"{PACE}Hz", "burst", POINTS) if paced else ()), "size", POINT_BYTES)
        wait_for("ddsperf has samples", reader.rows)

        def work(seconds):
            # Whole seconds of its own: it counts by those.
            before_it = len(reader.rows())
            seen = wait_for("ddsperf's statistics", lambda: len(rows) if len(rows := reader.rows()) > before_it else None)
            before = [processor_seconds(each) for each in (writer, reader)]
            wanted = max(1, int(seconds) - 1)
            wait_for("ddsperf's statistics", lambda: len(reader.rows()) >= seen + wanted, seconds + 10)
            used = [processor_seconds(each) - was for each, was in zip((writer, reader), before)]
            rows = reader.rows()[seen:seen + wanted]
            return {"samples": sum(each["samples"] for each in rows), "seconds": len(rows), "publisher": used[0],
                    "reader": used[1]}
        return rates(quiet_window("ddsperf", bench.witness(), writer, options, work, OWN))
