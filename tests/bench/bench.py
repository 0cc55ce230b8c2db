#!/usr/bin/python3
"""Benchmarks of plc-gateway on emulated serial wires. Prints tables of ratios; README.md says what they mean.

Ends with 1 when it could not measure, and with --check also when a target was missed (2). A bad figure is no failure.
"""

import argparse
import importlib
import os
import sys
from pathlib import Path

MODULES = {"bus": "bus", "write": "write_latency", "dead": "dead_stations", "forward": "forwarding", "scale": "scale",
           "dds": "dds", "failover": "failover", "smoke": "smoke", "dds_smoke": "dds_smoke"}
FOR_CTEST = ("smoke", "dds_smoke")
ROOT = Path(__file__).resolve().parents[2]
PROGRAMS = {"PLC_GATEWAY": "daemon/plc-gateway", "BENCH_WIRE": "tests/bench/bench-wire",
            "BENCH_BUS": "tests/bench/bench-bus", "BENCH_DDS": "tests/bench/bench-dds",
            "LIBMODBUS_LOOP": "tests/bench/libmodbus-loop"}
# The others are for all.
ONLY_FOR = {"BENCH_BUS": {"failover"}, "BENCH_DDS": {"dds", "dds_smoke"}, "LIBMODBUS_LOOP": {"bus"}}


def numbers(text):
    return [int(each) for each in text.split(",")]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("name", nargs="*", metavar="NAME", help=f"of {', '.join(MODULES)}; none: all but those of ctest")
    parser.add_argument("--build", default=ROOT / "build/release", type=Path, help="build folder of the programs")
    parser.add_argument("--seconds", type=float, default=20, help="length of one measurement")
    parser.add_argument("--slice", type=float, default=4, help="seconds that the machine has to be quiet for at a time")
    parser.add_argument("--check", action="store_true", help="exit status 2 when a target is missed")
    parser.add_argument("--realtime", action="store_true",
                        help="measured programs run before all ordinary ones: where others use the machine, too")
    parser.add_argument("--tcp", action="store_true", help="the same wires behind device servers, not on ptys: a busy "
                        "machine delays those less; the gateway only")
    parser.add_argument("--bauds", type=numbers, help="bus: 9600,115200")
    parser.add_argument("--clients", type=numbers, help="forward: 1,8,64")
    parser.add_argument("--programs", help="bus: gateway,libmodbus,pymodbus")
    parser.add_argument("--tenth", action="store_true", help="scale: a tenth of the plant only, no growth")
    parser.add_argument("--parts", help="dds: rates,latency,memory")
    parser.add_argument("--delivery", choices=("byte", "fifo", "frame"), default="byte",
                        help="bus: when the driver hands over received bytes")
    parser.add_argument("--runs", type=int, default=20, help="failover: of each fault")
    parser.add_argument("--turnaround-us", type=int, default=1000, help="bus: of the station, beyond the silence")
    options = parser.parse_args()
    if wrong := [each for each in options.name if each not in MODULES]:
        parser.error(f"there is no benchmark {', '.join(wrong)}")
    return options


def main():
    # Imported here: sys.path has this folder first, and support may say that it cannot measure.
    from support import REALTIME, Bench, CannotMeasure, Table
    options = arguments()
    if options.realtime:
        os.environ[REALTIME] = "1"
    names = options.name or [each for each in MODULES if each not in FOR_CTEST]
    for variable, path in PROGRAMS.items():
        os.environ.setdefault(variable, str(options.build.resolve() / path))
        needed = ONLY_FOR.get(variable, set(names)).intersection(names)
        if needed and not os.access(os.environ[variable], os.X_OK):
            sys.exit(f"{os.environ[variable]} is missing: ./test.sh --bench builds it")
    Bench.over_tcp = options.tcp
    failed = False
    for name in names:
        try:
            importlib.import_module(MODULES[name]).run(options)
        except CannotMeasure as why:
            print(f"{name}: cannot measure: {why}", file=sys.stderr, flush=True)
            failed = True
    for each in Table.missed:
        print(f"missed: {each}", flush=True)
    if failed:
        sys.exit(1)
    if options.check and Table.missed:
        sys.exit(2)


main()
