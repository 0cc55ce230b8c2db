"""DDS on a network that is not there at the start, comes, and gets another address: two network namespaces of this host,
joined by a cable of their own. Needs the right to make them."""

import json
import subprocess
import unittest

from support import InteropTest, Program, binary, holds, main, wait_for

DOMAIN = 44


def may_make_namespaces():
    tried = subprocess.run(["unshare", "--net", "ip", "link", "add", "plant0", "type", "veth", "peer", "name", "office0"],
                           capture_output=True, check=False)
    return tried.returncode == 0


@unittest.skipUnless(may_make_namespaces(), "network namespaces with veth pairs cannot be made here")
class NetworkTest(InteropTest):
    def setUp(self):
        self.near, self.far = (self.namespace() for _ in range(2))
        self.inside(self.near, "ip", "link", "set", "lo", "up")
        self.inside(self.near, "ip", "link", "add", "plant0", "type", "veth", "peer", "name", "office0", "netns",
                    str(self.far.pid))
        self.inside(self.far, "ip", "addr", "add", "10.99.0.2/24", "dev", "office0")
        self.inside(self.far, "ip", "link", "set", "office0", "up")

    def namespace(self):
        """A process that keeps a network of its own alive."""
        program = Program(self, "sleep", ["unshare", "--net", "sleep", "600"])
        ours = subprocess.run(["readlink", "/proc/self/ns/net"], capture_output=True, check=True).stdout
        wait_for("another network", lambda: subprocess.run(["readlink", f"/proc/{program.pid}/ns/net"],
                                                           capture_output=True, check=True).stdout != ours)
        return program

    def enter(self, where):
        return ["nsenter", f"--net=/proc/{where.pid}/ns/net"]

    def inside(self, where, *command):
        subprocess.run([*self.enter(where), *command], check=True, timeout=20)

    def start(self):
        # The PLC link has its own part in the domain: it must close, too, or the old one stays.
        path = self.write(self.configuration(units=("main", "linked"), plc_links=[
            {"name": "link", "plc": "linked", "station": 1, "relay_count": 4}], dds={"domain": DOMAIN, "interface": "plant0", "partition": "",
                                                  "blocks": [{"plc": "main", "device": "D0", "count": 4}]})
                          | {"plcs": [{"name": "main"}, {"name": "linked", "model": "FP7"}]})
        self.gateway = Program(self, "plc-gateway", [*self.enter(self.near), binary("PLC_GATEWAY"), "run", path])

    def watch(self):
        self.heard = self.folder / "heard.json"
        with open(self.heard, "wb") as output:
            Program(self, "watch", [*self.enter(self.far), binary("PLC_GATEWAY"), "watch", "--json", "--domain", DOMAIN,
                                    "--interface", "office0"], output)

    def events(self, **wanted):
        lines = self.heard.read_text().splitlines(keepends=True)
        found = [json.loads(line) for line in lines if line.endswith("\n")]
        return [each for each in found if all(each.get(key) == value for key, value in wanted.items())]

    def test_an_interface_comes_later_and_then_gets_another_address(self):
        self.start()
        wait_for("it says that DDS cannot start", lambda: "It is tried again until it works" in self.gateway.log)
        self.watch()
        holds("it runs without a network", self.gateway.running, 1)
        self.assertEqual(self.gateway.log.count(" DDS: cannot create"), 1, "said once, not each second")

        self.inside(self.near, "ip", "addr", "add", "10.99.0.1/24", "dev", "plant0")
        self.inside(self.near, "ip", "link", "set", "plant0", "up")
        wait_for("the registers", lambda: self.events(event="registers", route="main.D0"), 60)
        self.assertTrue(wait_for("its state", lambda: self.events(event="port", port="dds", state="up", reopens=0)))

        began = len(self.events())
        self.inside(self.near, "ip", "addr", "del", "10.99.0.1/24", "dev", "plant0")
        self.inside(self.near, "ip", "addr", "add", "10.99.0.3/24", "dev", "plant0")
        wait_for("a new domain", lambda: "it is made anew" in self.gateway.log)
        again = wait_for("everything comes again", lambda: [
            each for each in self.events()[began:] if each["event"] == "port" and each["reopens"] == 1], 60)
        self.assertEqual(again[0]["port"], "dds")
        wait_for("registers, too", lambda: [each for each in self.events()[began:] if each["event"] == "registers"])


main()
