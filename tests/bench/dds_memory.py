"""Memory that instances need in the publisher: of the gateway's points, and of a bare writer."""

from types import SimpleNamespace

from dds_parts import DdsBench, Reporting, memory_per_thousand
from support import configuration, wait_for

INSTANCES = (1000, 11000)


def points(count):
    return [{"name": f"point{i}", "plc": "main", "device": f"D{i}" if i < 8000 else f"R{i - 8000}", "type": "uint16"}
            for i in range(count)]


def gateway_of_points(bench, count, enabled=True):
    configured = configuration(bench, SimpleNamespace(lines=()), [], [])
    return bench.gateway({**configured, "points": points(count), "dds": {**bench.dds, "enabled": enabled}})


def all_came(reader, count):
    came = 0

    def enough():
        nonlocal came
        came += reader.report()["points"]
        return came >= count
    wait_for(f"{count} instances came", enough, 120)


def gateway_memory(enabled, options):
    def resident(count):
        with DdsBench() as bench:
            reader = Reporting(bench, "reader", "read")
            gateway = gateway_of_points(bench, count, enabled)
            if enabled:
                all_came(reader, count)
            return gateway.resident_bytes()
    return memory_per_thousand(resident, INSTANCES)


def bare_memory(options):
    def resident(count):
        with DdsBench() as bench:
            reader = Reporting(bench, "reader", "read")
            writer = Reporting(bench, "writer", "write", "point", count, 1, 1_000_000)
            all_came(reader, count)
            return writer.resident_bytes()
    return memory_per_thousand(resident, INSTANCES)
