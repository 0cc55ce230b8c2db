"""A pair whose members do not hear each other by DDS any more, but both hear the line: the standby stays silent as long
as the other one speaks. Each member is in a network namespace of its own; that needs root."""

import os
import subprocess
import time
import unittest

import support
from standby_support import LEASE, StandbyTest, wait_for


def run(*words):
    subprocess.run(words, check=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def may_make_namespaces():
    return os.geteuid() == 0 and subprocess.run(["unshare", "--net", "ip", "link"], check=False, capture_output=True,
                                                stdin=subprocess.DEVNULL).returncode == 0


@unittest.skipUnless(may_make_namespaces(), "network namespaces need root")
class Split(StandbyTest):
    def setUp(self):
        self.spaces = [f"plcgw-{os.getpid()}-{k}" for k in range(2)]
        for space in self.spaces:
            run("ip", "netns", "add", space)
            self.addCleanup(run, "ip", "netns", "delete", space)
        run("ip", "link", "add", "dds0", "netns", self.spaces[0], "type", "veth", "peer", "name", "dds0", "netns",
            self.spaces[1])
        for k, space in enumerate(self.spaces):
            run("ip", "-n", space, "addr", "add", f"10.99.0.{k + 1}/24", "dev", "dds0")
            run("ip", "-n", space, "link", "set", "lo", "up")
            run("ip", "-n", space, "link", "set", "dds0", "up")

    def network(self, state):
        run("ip", "-n", self.spaces[0], "link", "set", "dds0", state)
        return time.monotonic_ns()

    def far_member(self, number, **standby):
        return self.member(number, "ip", "netns", "exec", self.spaces[number], dds={"interface": "dds0"}, **standby)

    def both(self, **standby):
        self.line()
        made = [self.far_member(0, **standby)]
        self.wire.talks(0, 0)
        made.append(self.far_member(1, **standby))
        for k in range(2):
            wait_for(f"member {k} hears the other one", lambda k=k: self.hears(k))
        return made

    def test_the_standby_stays_silent_while_the_other_speaks(self):
        self.both()
        down = self.network("down")
        wait_for("member 1 misses the other one", lambda: not self.hears(1))
        self.quiet_watch(5 * LEASE)
        self.check_wire(only=0, since=down)
        up = self.network("up")
        wait_for("member 1 hears the other one", lambda: self.hears(1), 40)
        self.quiet_watch(2 * LEASE)
        self.check_wire(only=0, since=down)
        self.assertTrue(self.wire.questions(0, up))

    def test_killed_while_they_do_not_hear_each_other(self):
        active, _ = self.both()
        self.network("down")
        wait_for("member 1 misses the other one", lambda: not self.hears(1))
        active.kill()
        killed = time.monotonic_ns()
        self.takeover(1, killed)
        self.quiet_watch(2 * LEASE)
        self.check_wire(only=1, since=killed + 50_000_000)

    def test_cable_and_network_come_back(self):
        """The active member has neither network nor line: both are active in the end. When both come back, one of them
        gives way, and no word is spoken into the other's for longer than that takes."""
        self.both()
        self.network("down")
        wait_for("member 1 misses the other one", lambda: not self.hears(1))
        cut = self.wire.command("cut", 0)
        self.takeover(1, cut)
        self.network("up")
        wait_for("they hear each other", lambda: self.hears(0), 40)
        self.quiet_watch(2 * LEASE)
        joined = self.wire.command("join", 0)
        self.quiet_watch(4 * LEASE)
        self.check_wire()
        talkers = {each["talker"] for each in self.wire.events("request", joined + int(2e9))}
        self.assertEqual(len(talkers), 1, talkers)


if __name__ == "__main__":
    support.main()
