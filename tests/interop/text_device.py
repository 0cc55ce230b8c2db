"""What tests of general-purpose lines share: a text device on a pty, and a gateway whose line shows its status."""

import os
import select
import threading
import tty

from support import PATIENCE, InteropTest, wait_for

STATUS = 300  # D300-D307
ERROR, ERRORS, WAITING, RECEIVED, REFUSED, LOST, SENT, UNANSWERED = range(STATUS, STATUS + 8)
BUFFERS_FULL = 1 << 9


class TextDevice:
    """The far end of a pty that the gateway opens by its name in the test's folder."""

    def __init__(self, test, name="line"):
        self.link = test.folder / name
        self.ours, self.theirs = os.openpty()
        tty.setraw(self.theirs)
        self.link.symlink_to(os.ttyname(self.theirs))
        test.addCleanup(self.unplug)

    def unplug(self):
        if self.ours is not None:
            self.link.unlink()
            os.close(self.ours)
            os.close(self.theirs)
            self.ours = None

    def say(self, data):
        while data:
            data = data[os.write(self.ours, data):]

    def hear(self, end, patience=PATIENCE):
        """What the gateway sends, up to this end."""
        heard = b""
        while not heard.endswith(end):
            if not select.select([self.ours], [], [], patience)[0]:
                raise AssertionError(f"only {heard!r} came within {patience} s")
            heard += os.read(self.ours, 1)
        return heard


class Answering(threading.Thread):
    """Answers each request that it knows; `silent` switches it off."""

    def __init__(self, device, answers):
        super().__init__(daemon=True)
        self.device, self.answers = device, answers
        self.silent = self.ended = False
        self.asked = []

    def run(self):
        heard = b""
        while not self.ended:
            if not select.select([self.device.ours], [], [], 0.05)[0]:
                continue
            heard += os.read(self.device.ours, 100)
            while b"\r" in heard:
                request, _, heard = heard.partition(b"\r")
                self.asked.append(request)
                if not self.silent and request in self.answers:
                    self.device.say(self.answers[request])

    def end(self):
        self.ended = True
        self.join()


class GeneralPurpose(InteropTest):
    """The line is "text", its status stands in D300 to D307, M90 resets it."""

    def start(self, content, **line):
        self.device = TextDevice(self)
        self.gateway = self.start_gateway(self.configuration(lines=[
            {"name": "text", "device": str(self.device.link), "protocol": "general-purpose", "parity": "none", **line,
             "general_purpose": {"status": {"plc": "main", "device": f"D{STATUS}", "reset": "M90"}, **content}}]))
        self.client = self.gateway.client()
        wait_for("the line is open", lambda: "is open" in self.gateway.log)

    def number(self, device):
        return self.client.holding(device)[0]

    def wait_number(self, device, value):
        wait_for(lambda: f"D{device} is {value}, not {self.number(device)}", lambda: self.number(device) == value)

    def words(self, device, count):
        """A message in words, as GPRECV leaves it."""
        registers = [self.client.holding(device + i)[0] for i in range(count)]
        data = b"".join(bytes([word & 255, word >> 8]) for word in registers[1:])
        return data[:registers[0]]
