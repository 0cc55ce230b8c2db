"""Faults of the active member of a pair on one RS-485 line: how long until the other one asks, and until a subscriber has
its first sample; collisions on the wire and writes that were executed twice are counted."""

import json
import os
import random
import signal
import statistics
import threading
import time

from pymodbus.client import ModbusTcpClient
from pymodbus.exceptions import ModbusException
from support import Bench, Program, Table, free_port, wait_for

BAUD, PERIOD, METER, PUMP, SETPOINT = 19200, 200, 1, 2, 10
LEASE = 500
FAULTS = ("kill -9", "SIGSTOP", "cable", "SIGTERM")


class Bus(Program):
    def __init__(self, bench):
        self.ports = [bench.folder / f"member{k}" for k in range(2)]
        self.record, self.fifo = bench.folder / "wire.json", bench.folder / "wire.commands"
        plan = bench.folder / "wire.plan"
        plan.write_text(json.dumps({"baud": BAUD, "members": [str(each) for each in self.ports], "stations": [
            {"unit": METER, "turnaround_us": 2000, "moving": 1}, {"unit": PUMP, "turnaround_us": 2000}]}))
        super().__init__(bench, "bench-bus", [os.environ["BENCH_BUS"], plan, self.record, self.fifo])
        self.said("ready")

    def events(self, kind, since=0):
        text = self.record.read_text()
        every = (json.loads(line) for line in text[:text.rfind("\n") + 1].splitlines())
        return [each for each in every if each["event"] == kind and each["at"] >= since]

    def talks(self, member, since):
        def questions():
            return [each for each in self.events("request", since) if each["talker"] == member]
        return wait_for(f"member {member} asks", questions)[0]["at"]


class Subscriber(Program):
    """plc-gateway watch --json, whose lines get the time at which they came."""

    def __init__(self, bench, dds):
        super().__init__(bench, "watch", [os.environ["PLC_GATEWAY"], "watch", "--json", "--domain", dds["domain"],
                                          "--interface", dds["interface"], "--partition", dds["partition"]])

    def samples(self):
        text = self.log()
        lines = text[:text.rfind("\n") + 1].splitlines()
        every = (json.loads(line) for line in lines if line.startswith("{"))
        return [each for each in every if each["event"] == "registers" and each["route"] == "meter.energy"
                and each["quality"] == "good"]

    def heard_from(self, member):
        wait_for(f"a sample of {member}", lambda: any(each["member"] == member for each in self.samples()))
        return time.monotonic_ns()

    def steps_back(self):
        every = [(each["source_ns"], each["values"][0]) for each in self.samples()]
        return sum(1 for before, after in zip(every, every[1:]) if after[0] < before[0] or after[1] < before[1])


class Pair:
    """One run: a line, both members, a subscriber."""

    def __init__(self, bench, run):
        self.bench = bench
        self.over = False
        self.bus = Bus(bench)
        self.dds = {"domain": 70 + os.getpid() % 20, "interface": "lo", "partition": f"failover.{os.getpid()}.{run}"}
        self.tcp = [free_port(), free_port()]
        self.members = [self.member(k) for k in range(2)]
        self.bus.talks(0, 0)
        self.watch = Subscriber(bench, self.dds)
        wait_for("a sample", self.watch.samples)
        time.sleep(1)  # the standby hears a few periods

    def member(self, number):
        configuration = {
            "gateway": "bench", "plcs": [{"name": "main"}],
            "lines": [{"name": "line", "device": str(self.bus.ports[number]), "parity": "none", "baud_rate": BAUD,
                       "response_timeout_ms": 200}],
            "stations": [{"name": "meter", "line": "line", "unit": METER}, {"name": "pump", "line": "line", "unit": PUMP}],
            "routes": [
                {"name": "meter.energy", "station": "meter", "table": "holding", "first": 0, "count": 4,
                 "plc": "main", "device": "D1000", "period_ms": PERIOD},
                {"name": "pump.setpoint", "station": "pump", "table": "holding", "first": SETPOINT,
                 "plc": "main", "device": "D10", "direction": "write"}],
            "modbus_tcp": [{"port": self.tcp[number], "units": [{"unit": 1, "plc": "main"}]}],
            "dds": {**self.dds, "member": f"m{number}"},
            "standby": {"priority": 60 - 10 * number, "lease_ms": LEASE, "hand_back": False, "listen_ms": 1000},
            "control": {"socket": str(self.bench.folder / f"control{number}.sock")},
            "state": {"folder": str(self.bench.folder / f"state{number}")}}
        file = self.bench.folder / f"gateway{number}.json"
        file.write_text(json.dumps(configuration))
        return Program(self.bench, f"member{number}", [os.environ["PLC_GATEWAY"], "run", file])

    def write(self):
        """A client writes one value after the other into the active member, until it is gone."""
        client = ModbusTcpClient("127.0.0.1", self.tcp[0], timeout=2, retries=0)
        client.connect()
        value = 1000
        while not self.over:
            value += 1
            try:
                if client.write_register(10, value, 1).isError():
                    return
            except ModbusException:
                return
            time.sleep(0.03)

    def strike(self, fault):
        process = self.members[0].process
        if fault == "cable":
            self.bus.fifo.write_text("cut 0\n")
        else:
            process.send_signal({"kill -9": signal.SIGKILL, "SIGSTOP": signal.SIGSTOP, "SIGTERM": signal.SIGTERM}[fault])

    def cure(self, fault):
        if fault == "cable":
            self.bus.fifo.write_text("join 0\n")
        if fault == "SIGSTOP":
            self.members[0].process.send_signal(signal.SIGCONT)
        time.sleep(2)  # whatever it did wrong would be heard now


def one_run(bench, fault, run):
    pair = Pair(bench, run)
    client = threading.Thread(target=pair.write, daemon=True)
    client.start()
    wait_for("writes", lambda: len(pair.bus.events("write")) > 5)
    time.sleep(random.random() * PERIOD / 1000)  # anywhere in the cycle
    struck = time.monotonic_ns()
    pair.strike(fault)
    wire = pair.bus.talks(1, struck) - struck
    subscriber = pair.watch.heard_from("m1") - struck
    pair.cure(fault)
    pair.over = True
    client.join()
    values = [each["value"] for each in pair.bus.events("write") if each["unit"] == PUMP]
    return {"wire": wire / 1e6, "subscriber": subscriber / 1e6,
            "collisions": len(pair.bus.events("collision")),
            "back": pair.watch.steps_back(),
            "twice": sum(1 for before, after in zip(values, values[1:]) if after <= before)}


def run(options):
    table = Table(f"failover: {options.runs} runs of each fault at {BAUD}, period {PERIOD} ms, lease {LEASE} ms; "
                  "milliseconds from the fault to the other member's first question, and to a subscriber's first sample",
                  ("fault", 8), ("wire p50", 8), ("max", 6), ("subscriber p50", 14), ("max", 6), ("collisions", 10),
                  ("steps back", 10), ("written again", 13))
    for fault in FAULTS:
        runs = []
        for number in range(options.runs):
            with Bench() as bench:
                runs.append(one_run(bench, fault, number))
        of = {key: [each[key] for each in runs] for key in runs[0]}
        table.row(fault, *(f"{figure(of[key]):.0f}" for key in ("wire", "subscriber")
                           for figure in (statistics.median, max)),
                  *(sum(of[key]) for key in ("collisions", "back", "twice")))
        for key, what in (("collisions", "collisions on the wire"), ("back", "older values after newer ones"),
                          ("twice", "values written again or after a newer one")):
            Table.target(sum(of[key]) == 0, f"failover: {fault}: {sum(of[key])} {what}")
