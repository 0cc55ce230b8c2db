"""tshark: captures the traffic of a DDS domain on loopback, and says how it decodes our samples."""

import os
import re
import socket
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

from support import PATIENCE, Program, wait_for

TOPICS = "plcgw/v1/"
KEY_HASH, STATUS_INFO = "0x0070", "0x0071"
DATA = "0x15"
PORTS_OF_A_DOMAIN = 250


def skip_unless_capturing(name):
    """Ends the program with 77, and says why, where packets cannot be captured."""
    try:
        # Into a file of its own: where it cannot capture, it deletes what it was to write to, were it /dev/null.
        with tempfile.TemporaryDirectory(prefix="interop.") as folder:
            done = subprocess.run(["tshark", "-i", "lo", "-c", "1", "-a", "duration:1", "-w", f"{folder}/probe"], text=True,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  timeout=3 * PATIENCE, check=False)
    except FileNotFoundError:
        reason = "tshark is missing"
    else:
        if done.returncode == 0:
            return
        reason = f"packets cannot be captured on lo: {' '.join(done.stdout.split())[:300]}"
    print(f"SKIPPED: {reason}")
    with open(os.environ.get("PLCGW_SKIP_REASONS", os.devnull), "a", encoding="utf-8") as reasons:
        reasons.write(f"{name}: {reason}\n")
    sys.exit(77)


class Capture(Program):
    """Captures what a domain's ports carry, from now until complete()."""

    def __init__(self, test, domain):
        self.file = test.folder / "traffic.pcapng"
        first = 7400 + PORTS_OF_A_DOMAIN * domain
        self.last_port = first + PORTS_OF_A_DOMAIN - 1  # of no participant: indices end long before
        super().__init__(test, "tshark", ["tshark", "-i", "lo", "-w", self.file, "-f",
                                          f"udp portrange {first}-{self.last_port}"])
        wait_for("tshark captures", lambda: "Capture started" in self.log or not self.running())
        test.assertTrue(self.running(), "tshark ended")

    def complete(self):
        """Ends it when all that was sent is in the file: a packet of our own is behind it."""
        mark = f"all of {self.pid}".encode()

        def marked():
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
                sender.sendto(mark, ("127.0.0.1", self.last_port))
            return mark in self.file.read_bytes()
        wait_for("tshark has written all", marked)
        self.stop()

    def decoded(self, wanted="", kind="pdml"):
        done = subprocess.run(["tshark", "-r", str(self.file), "-Y", wanted, "-T", kind], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=3 * PATIENCE, check=False)
        if done.returncode != 0:
            raise AssertionError(f"tshark: {done.stderr.decode(errors='replace')[-1000:]}")
        return done.stdout

    def samples(self):
        """Our samples, in their order."""
        root = ElementTree.fromstring(self.decoded(f'rtps.param.topicName contains "{TOPICS}"'))
        found = []
        for packet in root:
            for sub in packet.iter("field"):
                if sub.get("name") == "rtps.sm.id" and sub.get("show") == DATA:
                    found.append(Sample(sub))
        return [each for each in found if each.labelled]


class Sample:
    """One DATA submessage that tshark labels with its topic."""

    def __init__(self, sub):
        # Discovery carries topic names as well: this one is what tshark found for the writer.
        labels = [each for each in sub if each.get("show") == "[Topic Information (from Discovery)]"]
        self.labelled = bool(labels)
        if not self.labelled:
            return
        names = {each.get("name"): each.get("show") for each in labels[0]}
        self.name = names["rtps.param.topicName"].removeprefix(TOPICS)
        self.type = names["rtps.param.typeName"]
        self.encapsulation = self.data = self.key_hash = self.status = None
        for each in sub.iter("field"):
            identifier = each.find("field[@name='rtps.param.id']")
            number = None if identifier is None else identifier.get("show")
            if number == KEY_HASH:
                self.key_hash = bytes.fromhex(re.sub("[^0-9a-f]", "", each.find("field[@name='rtps.guid']").get("show")))
            if number == STATUS_INFO:
                self.status = each
            if each.get("name") == "rtps.param.serialize.encap_kind":
                self.encapsulation = each.get("showname")
            if each.get("name") == "rtps.issueData":
                self.data = bytes.fromhex(each.get("value"))

    def says(self, words):
        """Whether tshark shows these words about its status info."""
        return self.status is not None and any(words in each.get("showname", "") for each in self.status.iter("field"))
