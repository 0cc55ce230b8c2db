"""DDS: samples per second, latency of a change on the wire, processor time, memory; as ratios to a bare Cyclone writer
with the same types, QoS and settings (bench-dds), and to ddsperf where it can do the same."""

import os

import dds_latency as latency
import dds_memory as memory
import dds_rates as rates
from support import REALTIME, CannotMeasure, Table


class Ratios:
    """A table with the gateway, what it is compared with, and the ratios."""

    def __init__(self, options):
        self.table = Table(f"dds: the gateway, a bare Cyclone writer with its types and QoS, and ddsperf; {options.seconds} s "
                           "each", ("what", 44), ("gateway", 9), ("bare", 9), ("ddsperf", 9), ("gateway/bare", 12),
                           ("gateway/ddsperf", 15))

    def row(self, what, key, gateway, bare, ddsperf=None, digits=1):
        others = [None if each is None else each[key] for each in (bare, ddsperf)]
        ratios = ["-" if other is None else f"{gateway[key] / other:.2f}" for other in others]
        shown = ["-" if value is None else f"{value:.{digits}f}" for value in (gateway[key], *others)]
        self.table.row(what, *shown, *ratios,
                       spoiled=any(each and each.get("spoiled") for each in (gateway, bare, ddsperf)))


def rate_rows(ratios, options):
    realtime = os.environ.pop(REALTIME, None)  # of two that are as fast as they can, nothing would be left to others
    for paced in (False, True):
        how = f"{rates.PACE * rates.POINTS} samples/s" if paced else "as fast as it can"
        found = [measure(paced, options) for measure in (rates.measure_gateway, rates.measure_bare, rates.measure_ddsperf)]
        if not paced:
            ratios.row("samples/s that came, " + how, "rate", *found, digits=0)
        ratios.row("publisher's us for a sample, " + how, "publisher", *found)
        ratios.row("subscriber's us for a sample, " + how, "reader", *found)
    if realtime:
        os.environ[REALTIME] = realtime


def latency_rows(ratios, options):
    found = [measure(options) for measure in (latency.wire_latencies, latency.bare_latencies, latency.ddsperf_latencies)]
    for key in ("p50", "p99"):
        ratios.row(f"us from the wire to a subscriber, {key}", key, *found, digits=0)
    through = "a device server" if options.tcp else f"a pty, of which a byte through it took {found[0]['hop']:.0f} us"
    print(f"  through {through}; {found[0]['count']} changes", flush=True)


def memory_rows(ratios, options):
    with_dds, without = ({"kB": memory.gateway_memory(enabled, options)} for enabled in (True, False))
    bare = {"kB": memory.bare_memory(options)}
    ratios.row("publisher's kB for 1,000 instances", "kB", {"kB": with_dds["kB"] - without["kB"]}, bare)
    ratios.row("the same, with the gateway's own of points", "kB", with_dds, bare)


PARTS = {"rates": rate_rows, "latency": latency_rows, "memory": memory_rows}


def run(options):
    wanted = options.parts.split(",") if options.parts else list(PARTS)
    if wrong := [each for each in wanted if each not in PARTS]:
        raise CannotMeasure(f"there is no part {', '.join(wrong)}, only {', '.join(PARTS)}")
    ratios = Ratios(options)
    for each in wanted:
        PARTS[each](ratios, options)
