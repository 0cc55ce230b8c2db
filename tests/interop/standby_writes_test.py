"""DDS requests to a pair whose active member dies, stands still or hands over: each value reaches the station once at
most, each request has one kind of reply, and what one member answered the other one knows."""

import json
import os
import signal
import subprocess
import time

import support
from standby_support import PATIENCE, StandbyTest, wait_for
from support import Program, binary

OK_AGAIN = 10  # seconds on a busy machine, from the first question of the new member; the client repeats its request every 100 ms
ROUTE, AREA = "pump.setpoint", "holding"


class Orders(Program):
    """dds_peer orders: request N writes N, the next one follows the reply. What it says is read as it comes."""

    def __init__(self, test, client):
        self.client, self.said_file = client, test.folder / f"{client}.json"
        here, there = os.pipe()
        self.until = os.fdopen(there, "wb", buffering=0)
        test.addCleanup(self.until.close)
        d = test.dds()
        with os.fdopen(here, "rb") as stdin, open(self.said_file, "wb") as output:
            super().__init__(test, "dds_peer", [binary("DDS_PEER"), "orders", f"{d['domain']}/{d['partition']}", "interop",
                                                client, ROUTE, AREA, StandbyTest.SETPOINT], output, stdin)

    def said(self, what):
        complete = self.said_file.read_bytes().rpartition(b"\n")[0]
        return [each for each in map(json.loads, complete.splitlines()) if what in each]

    def replies(self, since=0, **wanted):
        return [each for each in self.said("answered")
                if each["at"] >= since and all(each[key] == value for key, value in wanted.items())]

    def ok(self, member, count, since=0, seconds=PATIENCE):
        """Waits until so many requests were done by that member, and returns the replies."""
        return wait_for(lambda: f"{count} requests done by m{member}, the last replies: {self.replies()[-4:]}",
                        lambda: (lambda found: found if len(found) >= count else None)(
                            self.replies(since, member=f"m{member}", result="OK")), seconds)

    def end(self):
        self.until.close()
        self.wait(2 * PATIENCE)


class StandbyWritesTest(StandbyTest):
    def dds(self):
        return {**super().dds(), "domain": 160 + os.getpid() % 16}

    def member_configuration(self, number, dds=None, **standby):
        made = super().member_configuration(number, {"writes": True, **(dds or {})},
                                            **{"lease_ms": 2000, "listen_ms": 4000, "line_silence_ms": 4000, **standby})
        # Each request counts here: on a busy machine no role may change by itself, and no answer be late.
        made["lines"][0]["response_timeout_ms"] = 1000
        return made

    def ordering(self):
        """Both members, and a client that has been answered for a while."""
        self.pair()
        self.orders = Orders(self, f"panel-{self.id()}"[-60:])
        self.orders.ok(0, 20)
        return self.members

    def taken_over(self, by, since):
        """Requests are done again soon after that member has begun to ask."""
        begun = self.wire.talks(by, since)
        done = self.orders.ok(by, 20, since)
        self.assertLess((done[0]["at"] - begun) / 1e9, OK_AGAIN)

    def ask_again(self, reply):
        """Repeats a request as a client of its own would that heard no reply."""
        d, number = self.dds(), str(reply["answered"])
        done = subprocess.run([binary("PLC_GATEWAY"), "write", "--dds", "-d", str(d["domain"]), "-i", "lo", "--partition",
                               d["partition"], "-g", "interop", "-t", str(1000 * PATIENCE), "--client", self.orders.client,
                               "--request", number, "--json", f"{ROUTE}/{AREA}:{self.SETPOINT}", number], text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, timeout=2 * PATIENCE, check=False)
        return json.loads(done.stdout)

    def check_answered_again(self, by, *replies):
        """That member knows what was answered, whoever did; nothing is written."""
        before = len(self.executed())
        for each in replies:
            again = self.ask_again(each)
            self.assertEqual([again["result"], again["detail"], again["member"]],
                             [each["result"], each["detail"], f"m{by}"])
        self.quiet_watch(5 * self.PERIOD / 1000)
        self.assertEqual(len(self.executed()), before)

    def executed(self):
        return self.wire.events("write", unit=self.PUMP, first=self.SETPOINT)

    def check_orders(self, *members, faults=1):
        """From the wire's record and all replies: who answered, in this order, how, and what was executed."""
        replies, sent = self.orders.replies(), {each["sent"]: each["at"] for each in self.orders.said("sent")}
        values = [each["value"] for each in self.executed()]
        self.assertEqual(values, sorted(set(values)), "a value was written twice, or after a newer one")
        self.assertEqual({each["answered"] for each in replies}, set(sent), "a request without a reply")
        written = {each["value"]: each["at"] for each in self.executed()}
        results = {}
        for each in replies:
            self.assertEqual(results.setdefault(each["answered"], each["result"]), each["result"], "two kinds of replies")
            self.assertIn(each["result"], ("OK", "TIMEOUT"), each)
            if each["result"] == "OK":
                self.assertLess(written.get(each["answered"], each["at"]), each["at"], f"not written: {each}")
            else:
                self.assertIn("not known", each["detail"])
        unknown = [each for each in replies if each["result"] == "TIMEOUT"]
        self.assertLessEqual(len({each["answered"] for each in unknown}), faults,
                             f"only one was under way at each takeover: {unknown[:6]}")
        # A member that is stopped while it sends a reply to one reader after the other goes on with that when it goes on:
        # the other one may have said the same in its name by then.
        first = {(each["answered"], each["done"]): each for each in reversed(replies)}
        replies = [each for each in replies if first[each["answered"], each["done"]] is each]
        spoke = [each["member"] for each in replies]
        around = [replies[k - 1:k + 1] for k, who in enumerate(spoke) if k > 0 and spoke[k - 1] != who]
        self.assertEqual([who for k, who in enumerate(spoke) if k == 0 or spoke[k - 1] != who],
                         [f"m{each}" for each in members], f"a standby has answered: {around}")
        self.check_wire()

    def check_memory(self, member):
        last = self.orders.replies(result="OK")[-1]["answered"]
        self.assertEqual(self.members[member].client().holding(self.SETPOINT), [last])

    def test_killed(self):
        active, _ = self.ordering()
        active.kill()
        killed = time.monotonic_ns()
        self.taken_over(1, killed)
        self.orders.end()
        self.check_memory(1)
        first = self.orders.replies(member="m0")
        self.check_answered_again(1, first[0], first[-1], *self.orders.replies(result="TIMEOUT"))
        self.check_memory(1)
        self.check_orders(0, 1)

    def test_stopped_and_continued(self):
        active, _ = self.ordering()
        active.signal(signal.SIGSTOP)
        self.taken_over(1, time.monotonic_ns())
        active.signal(signal.SIGCONT)
        continued = time.monotonic_ns()
        self.orders.ok(1, 60, continued)
        self.stands_by(0)
        self.quiet_watch(5 * self.PERIOD / 1000)  # in which the one that stood still hears the line
        switched = self.switch(1)
        self.taken_over(0, switched)
        self.orders.end()
        self.check_memory(0)
        of_other = self.orders.replies(continued, member="m1")
        self.check_answered_again(0, of_other[-20], *self.orders.replies(result="TIMEOUT"))
        self.check_orders(0, 1, 0, faults=2)

    def stands_by(self, member):
        """Waits until the other one, which is active, hears it as standby."""
        def is_standby():
            there = self.report(1 - member).get("there", {})
            return there.get("heard") and there.get("role") == "standby"
        wait_for(f"m{member} is standby", is_standby)

    def switch(self, active):
        at = time.monotonic_ns()
        answer = self.command(active, command="pair", action="switch")
        self.assertTrue(answer["ok"], answer)
        return at

    def test_handed_over_to_and_fro(self):
        self.ordering()
        members = [0]
        for _ in range(6):
            self.stands_by(1 - members[-1])
            switched = self.switch(members[-1])
            members.append(1 - members[-1])
            self.taken_over(members[-1], switched)
        self.orders.end()
        self.check_memory(0)
        self.check_answered_again(0, self.orders.replies(member="m1")[-1], *self.orders.replies(result="TIMEOUT"))
        self.check_orders(*members, faults=6)


if __name__ == "__main__":
    support.main()
