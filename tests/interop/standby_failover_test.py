"""A pair on one serial line: whatever happens to the active member, the other goes on, and nobody speaks into its words.

Takeover times are figures of `./test.sh --bench failover`; here they only have to come.
"""

import random
import signal
import time

import support
from standby_support import LEASE, StandbyTest, wait_for


class Faults(StandbyTest):
    def test_killed(self):
        active, _ = self.pair()
        active.kill()
        killed = time.monotonic_ns()
        self.takeover(1, killed)
        self.heard_from(1)
        self.quiet_watch(2 * LEASE)
        self.check_wire(only=1, since=killed + 50_000_000)  # what its port still held goes out
        self.check_subscriber()

    def test_killed_and_started_again(self):
        active, _ = self.pair()
        active.kill()
        self.takeover(1, time.monotonic_ns())
        again = time.monotonic_ns()
        restarted = self.member(0)
        wait_for("it is open", lambda: "is open" in restarted.log)
        self.quiet_watch(4 * LEASE)
        self.check_wire(only=1, since=again)
        self.check_subscriber()

    def test_stopped_and_continued(self):
        active, _ = self.pair()
        active.signal(signal.SIGSTOP)
        stopped = time.monotonic_ns()
        self.takeover(1, stopped)
        self.heard_from(1)
        active.signal(signal.SIGCONT)
        self.quiet_watch(4 * LEASE)
        self.assertTrue(active.running())
        self.check_wire(only=1, since=stopped + 50_000_000)
        self.check_subscriber()

    def test_cable_of_the_active_member(self):
        self.pair()
        cut = self.wire.command("cut", 0)
        self.takeover(1, cut)
        self.heard_from(1)
        joined = self.wire.command("join", 0)
        self.quiet_watch(4 * LEASE)
        self.check_wire(only=1, since=joined)
        self.check_subscriber()

    def test_cable_of_the_standby(self):
        self.pair()
        cut = self.wire.command("cut", 1)
        self.quiet_watch(5 * LEASE)
        joined = self.wire.command("join", 1)
        self.quiet_watch(2 * LEASE)
        self.check_wire(only=0, since=cut)
        self.assertTrue(self.wire.questions(0, joined))
        self.check_subscriber()

    def test_ended_in_order(self):
        active, _ = self.pair()
        ended = time.monotonic_ns()
        self.assertEqual(active.stop(), 0)
        over = time.monotonic_ns()
        self.takeover(1, ended)
        self.heard_from(1)
        self.check_wire(only=1, since=over)
        self.check_subscriber()

    def test_handed_back(self):
        active, _ = self.pair(hand_back=True)
        active.kill()
        self.takeover(1, time.monotonic_ns())
        self.member(0, hand_back=True)
        again = self.wire.talks(0, time.monotonic_ns())
        self.quiet_watch(4 * LEASE)
        self.check_wire(only=0, since=again + 500_000_000)
        self.check_subscriber()

    def test_members_that_stumble(self):
        """Either member stands still now and then, for less or more than its lease: the role goes to and fro, and nobody
        speaks into the other's words."""
        self.pair()
        dice = random.Random(5)
        for _ in range(12):
            member = dice.choice(self.members)
            member.signal(signal.SIGSTOP)
            time.sleep(dice.choice((0.1, 0.3, 0.7, 1.2, 2.5)))
            member.signal(signal.SIGCONT)
            time.sleep(dice.choice((0.05, 0.5, 1.5)))
        end = time.monotonic_ns()
        wait_for("somebody asks in the end", lambda: self.wire.events("request", end))
        self.check_wire()
        self.check_subscriber()

    def test_standby_killed(self):
        _, standby = self.pair()
        standby.kill()
        killed = time.monotonic_ns()
        self.quiet_watch(3 * LEASE)
        self.check_wire(only=0, since=killed)
        self.assertTrue(self.wire.questions(0, killed))


class Writes(StandbyTest):
    def test_each_value_is_written_once(self):
        active, standby = self.pair()
        client = active.client()
        for value in (1001, 1002, 1003):
            client.write_register(10, value)
            wait_for(f"the pump has {value}", lambda v=value: self.wire.events("write", unit=self.PUMP, value=v))
        active.kill()
        self.takeover(1, time.monotonic_ns())
        after = standby.client()
        self.assertEqual(after.holding(10), [1003])
        self.quiet_watch(2 * LEASE)
        self.check_writes(1001, 1002, 1003)
        after.write_register(10, 1004)
        wait_for("the pump has 1004", lambda: self.wire.events("write", unit=self.PUMP, value=1004))
        self.check_writes(1001, 1002, 1003, 1004)
        self.check_wire()

    def test_commands_to_the_standby(self):
        """It asks nobody and says so at once; its memory may be read. What the active member scans ends with its role."""
        self.pair()
        for what in ({"command": "write", "target": "main:D10", "values": ["5"]},
                     {"command": "write", "target": "pump/holding:10", "values": ["5"]},
                     {"command": "read", "target": "pump/holding:10"},
                     {"command": "send", "line": "line", "text": "W"}):
            self.assertEqual(self.command(1, **what)["result"], "STANDBY", what)
        refused = self.command(1, command="scan", action="start", line="line")
        self.assertFalse(refused["ok"])
        self.assertIn("standby", refused["error"])
        self.assertEqual(self.command(1, command="read", target="main:D1000", count=4)["result"], "OK")
        self.assertEqual(self.command(0, command="scan", action="start", line="line")["state"], "running")
        self.assertTrue(self.command(0, command="pair", action="switch")["ok"])
        wait_for("the scan has ended", lambda: self.command(0, command="scan", line="line")["state"] == "stopped")
        self.check_wire()

    def test_what_a_client_wrote_while_the_active_member_died(self):
        """Values follow each other quickly, and the member dies in the middle: what it had confirmed last is written in
        the end, and nothing twice."""
        active, _ = self.pair()
        client = active.client()
        confirmed = 0
        for value in range(2001, 2021):
            client.write_register(10, value)
            confirmed = value
            time.sleep(0.01)
        active.kill()
        killed = time.monotonic_ns()
        self.takeover(1, killed)
        self.quiet_watch(2 * LEASE)
        values = [each["value"] for each in self.wire.events("write", unit=self.PUMP, first=self.SETPOINT)]
        self.assertEqual(values, sorted(set(values)), "a value was written twice, or after a newer one")
        self.assertGreaterEqual(values[-1], confirmed - 5, "more than the mirror's delay was lost")
        self.check_wire()


if __name__ == "__main__":
    support.main()
