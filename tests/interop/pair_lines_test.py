"""Lines of a pair on which no station is asked: the standby does not answer on a server line, and sends no messages."""

import json
import os
import select
import struct
import tty

from faulty_device import framed
from support import Client, Gateway, InteropTest, holds, main, wait_for

LEASE_MS = 1000


class FarEnd:
    """The other end of a line that a gateway opens."""

    def __init__(self, test, name):
        self.path = test.folder / name
        self.ours, theirs = os.openpty()
        tty.setraw(theirs)
        self.path.symlink_to(os.ttyname(theirs))
        self.heard = b""
        for fd in (self.ours, theirs):
            test.addCleanup(os.close, fd)

    def hear(self, seconds=0.0):
        """All that came until now and in this time."""
        while select.select([self.ours], [], [], seconds)[0]:
            self.heard += os.read(self.ours, 4096)
        return self.heard

    def ask(self, pdu, seconds):
        """What unit 5 answers in this time."""
        self.hear()
        self.heard = b""
        os.write(self.ours, framed(bytes([5]) + pdu))
        return self.hear(seconds)


def read_d0():
    return bytes.fromhex("0300000001")


def answer(value):
    return framed(bytes.fromhex("050302") + struct.pack(">H", value))


class PairLinesTest(InteropTest):
    def start_member(self, name, priority):
        ends = [FarEnd(self, f"{name}-server"), FarEnd(self, f"{name}-scale")]
        configuration = self.configuration(
            lines=[{"name": "server", "device": str(ends[0].path), "parity": "none", "role": "server",
                    "units": [{"unit": 5, "plc": "main"}]},
                   {"name": "scale", "device": str(ends[1].path), "parity": "none", "protocol": "general-purpose",
                    "general_purpose": {"end_code": "cr",
                                        "sends": [{"name": "ask", "text": "W", "period_ms": 200}],
                                        "messages": [{"name": "weighing", "pattern": "{weight:number}kg",
                                                      "plc": "main",
                                                      "fields": [{"name": "weight", "device": "D210"}]}]}}],
            dds={"member": name}, standby={"priority": priority, "lease_ms": LEASE_MS, "hand_back": False})
        configuration["control"]["socket"] = str(self.folder / f"{name}.sock")
        path = self.folder / f"{name}.json"
        path.write_text(json.dumps(configuration))
        written, self.write = self.write, lambda _: path
        gateway = Gateway(self, configuration)
        self.write = written
        return gateway, ends

    def test_server_and_message_lines(self):
        first, (server, scale) = self.start_member("a", 100)
        second, (other_server, other_scale) = self.start_member("b", 50)
        first.listening()
        wait_for("the active member answers", lambda: server.ask(read_d0(), 0.5) == answer(0))
        wait_for("the active member sends", lambda: b"W\r" in scale.hear())
        server.ask(bytes.fromhex("0600000155"), 0.5)
        self.assertEqual(server.ask(read_d0(), 0.5), answer(0x155))

        self.assertEqual(other_server.ask(read_d0(), 1), b"", "the standby does not answer")
        self.assertEqual(other_scale.hear(1), b"", "the standby sends nothing")
        os.write(other_scale.ours, b"12kg\r")  # but it listens

        first.kill()
        second.listening()
        wait_for("the other one answers with what was written to the first",
                 lambda: other_server.ask(read_d0(), 0.5) == answer(0x155))
        wait_for("the other one sends", lambda: b"W\r" in other_scale.hear())
        wait_for("the weight that came before", lambda: Client(self, second.port).holding(210) == [12])
        holds("what waited on the closed port is not answered", lambda: other_server.hear() == answer(0x155), 0.5)


if __name__ == "__main__":
    main()
