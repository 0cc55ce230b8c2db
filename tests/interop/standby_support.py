"""What the tests of hot standby share: a line with several members, and gateways that are a pair on it."""

import json
import os
import socket
import time

from support import PATIENCE, Client, InteropTest, Program, Watch, binary, serial_line, station, route, wait_for

LEASE = 1.0  # seconds; longer than a busy machine keeps a process from its work


class PartyLine(Program):
    """bench-bus: one RS-485 pair, a port for each member, and a record of what was said on it."""

    def __init__(self, test, stations, members=2, baud=19200):
        self.ports = [test.folder / f"member{k}" for k in range(members)]
        self.record = test.folder / "wire.json"
        self.record.touch()
        self.fifo = test.folder / "wire.commands"
        self.read_until = 0
        self.all = []
        plan = test.folder / "wire.plan"
        plan.write_text(json.dumps({"baud": baud, "members": [str(each) for each in self.ports], "stations": stations}))
        super().__init__(test, "bench-bus", [binary("BENCH_BUS"), plan, self.record, self.fifo])
        self.ready()

    def events(self, kind, since=0, **wanted):
        """All that happened on the wire since that moment, of time.monotonic_ns()."""
        with open(self.record, "rb") as record:
            record.seek(self.read_until)
            for line in record:
                if not line.endswith(b"\n"):
                    break
                self.read_until += len(line)
                self.all.append(json.loads(line))
        return [each for each in self.all if each["event"] == kind and each["at"] >= since
                and all(each[key] == value for key, value in wanted.items())]

    def questions(self, member, since=0):
        return self.events("request", since, talker=member)

    def command(self, what, member):
        """cut or join. Returns when it happened."""
        before = len(self.events(what))
        self.fifo.write_text(f"{what} {member}\n")
        return wait_for(f"{what} {member}", lambda: self.events(what)[before:])[0]["at"]

    def talks(self, member, since):
        """Waits until that member asks, and returns when it began."""
        return wait_for(f"member {member} asks", lambda: self.questions(member, since), 2 * PATIENCE)[0]["at"]


class Member(Program):
    """A gateway that is one of a pair. Its log may say nothing of MODBUS TCP: a standby does not listen."""

    def __init__(self, test, number, configuration, *command_prefix):
        self.test, self.number, self.port = test, number, configuration["modbus_tcp"][0]["port"]
        self.control = configuration["control"]["socket"]
        file = test.folder / f"gateway{number}.json"
        file.write_text(json.dumps(configuration, indent=2))
        super().__init__(test, f"member-{number}", [*command_prefix, binary("PLC_GATEWAY"), "run", file])

    def client(self, unit=1):
        return Client(self.test, self.port, unit)


class StandbyTest(InteropTest):
    """Two gateways on one line: member 0 has the higher priority. `meter` counts up with each read of it, the setpoint
    of `pump` is written."""

    PERIOD = 200
    METER, PUMP = 1, 2
    SETPOINT = 10

    def line(self):
        stations = [{"unit": self.METER, "turnaround_us": 2000, "moving": 1},
                    {"unit": self.PUMP, "turnaround_us": 2000}]
        self.wire = PartyLine(self, stations)
        return self.wire

    def pair(self, **standby):
        """Both members, of which 0 is active already."""
        self.line()
        self.members = [self.member(0, **standby)]
        self.wire.talks(0, 0)
        self.members.append(self.member(1, **standby))
        self.subscriber = Watch(self, self.dds()).connected()
        self.subscriber.expect("meter.energy", quality="good")
        wait_for("both know each other", lambda: self.hears(0) and self.hears(1))
        self.quiet_watch(5 * self.PERIOD / 1000)  # in which the standby hears the line
        return self.members

    def dds(self):
        return {"domain": 70 + os.getpid() % 20, "interface": "lo",
                "partition": f"standby.{os.getpid()}.{id(self)}"}

    def member(self, number, *command_prefix, dds=None, **standby):
        return Member(self, number, self.member_configuration(number, dds, **standby), *command_prefix)

    def member_configuration(self, number, dds=None, **standby):
        line = serial_line(self.wire.ports[number], response_timeout_ms=200)
        routes = [route("meter.energy", "holding", 0, "D1000", 4, period_ms=self.PERIOD),
                  route("pump.speed", "holding", 0, "D1100", 2, period_ms=self.PERIOD),
                  route("pump.setpoint", "holding", self.SETPOINT, "D10", direction="write")]
        made = self.configuration(lines=[line], stations=[station("meter", self.METER), station("pump", self.PUMP)],
                                  routes=routes)
        made["dds"] = {**self.dds(), "member": f"m{number}", **(dds or {})}
        made["control"] = {"socket": str(self.folder / f"control{number}.sock")}
        made["state"] = {"folder": str(self.folder / f"state{number}")}
        made["standby"] = {"priority": 60 - 10 * number, "lease_ms": int(1000 * LEASE), "hand_back": False,
                           "hand_back_after_ms": 1000, "listen_ms": int(2000 * LEASE), **standby}
        return made

    def command(self, number, **what):
        """The answer of the control socket of a member."""
        with socket.socket(socket.AF_UNIX) as asking:
            asking.settimeout(PATIENCE)
            asking.connect(str(self.folder / f"control{number}.sock"))
            asking.sendall(json.dumps(what).encode() + b"\n")
            return json.loads(asking.makefile().readline())

    def report(self, number):
        """What the control socket of a member says of the pair."""
        try:
            return self.command(number, command="pair", action="show")
        except (OSError, ValueError):
            return {}

    def hears(self, number):
        return self.report(number).get("there", {}).get("heard", False)

    def takeover(self, by, since):
        """Waits until that member asks; returns after how many seconds it did."""
        return (self.wire.talks(by, since) - since) / 1e9

    def heard_from(self, number):
        """Waits until the subscriber has a good sample of the meter from that member."""
        return wait_for(f"a sample of member {number}",
                        lambda: [each for each in self.subscriber.of("meter.energy")
                                 if each["quality"] == "good" and each["member"] == f"m{number}"])[0]

    def check_wire(self, only=None, since=0):
        """Nobody has spoken into anybody's words; since then only that member has asked."""
        for each in self.wire.events("collision"):
            near = [r for r in self.wire.all if abs(r["at"] - each["at"]) < 500_000_000]
            talkers = {r["talker"] for r in near if r["talker"] >= 0} | {each["other"]}
            # On a machine that stood still for longer than a station may take, the wire sees a question and its
            # repetition at once, and the answer to the first one between them: one member alone.
            self.assertEqual(len(talkers - {-1}), 1, f"a collision: {each}; around it: {near}")
        if only is not None:
            others = [each for each in self.wire.events("request", since) if each["talker"] != only]
            self.assertEqual(others, [])

    def check_subscriber(self):
        """No older value came after a newer one: the meter counts up, and source times grow."""
        samples = [each for each in self.subscriber.of("meter.energy") if each["quality"] == "good"]
        self.assertTrue(samples)
        for before, after in zip(samples, samples[1:]):
            self.assertLessEqual(before["values"][0], after["values"][0])
            self.assertLessEqual(before["source_ns"], after["source_ns"], f"{before} {after}")

    def check_writes(self, *written):
        """Each of these values was executed by the pump once, in this order, and no other."""
        values = [each["value"] for each in self.wire.events("write", unit=self.PUMP, first=self.SETPOINT)]
        self.assertEqual(values, list(written))

    def quiet_watch(self, seconds):
        """Lets things go on: what must not happen would happen now."""
        time.sleep(seconds)


__all__ = ["LEASE", "PATIENCE", "Member", "PartyLine", "StandbyTest", "wait_for"]
