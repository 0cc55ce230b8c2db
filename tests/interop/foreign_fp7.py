"""What the tests with the simulated FP7 of tests/field share: station 7 that traces its frames, and a line to it."""

import os
import re
import select
import time

from support import PATIENCE, InteropTest, Program, binary, station, wait_for

TRACED = re.compile(r"^([%<])(?:07|FF)#(.*)(..) -> ", re.MULTILINE)


def bcc(text):
    value = 0
    for character in text.encode():
        value ^= character
    return f"{value:02X}"


def source(name, first, device, count=1, **more):
    return {"name": name, "station": name.split(".")[0], "source": first, "count": count, "plc": "main",
            "device": device, "period_ms": 100, **more}


class ForeignFp7Test(InteropTest):
    line = {}

    def start_fp7(self, *options, number=7):
        arguments = ["--link", self.folder / "line", "--still", "--trace", "--station", number, *options]
        self.fp7 = Program(self, "field-fp7", [binary("FIELD_FP7"), *arguments]).ready()
        return self.fp7

    def configure(self, *routes):
        """A gateway with these routes; the stations are fp and all."""
        line = {"name": "line", "device": str(self.folder / "line"), "protocol": "mewtocol-com", "baud_rate": 115200,
                "parity": "odd", "response_timeout_ms": 1000, "retries": 1, **self.line}
        self.gateway = self.start_gateway(self.configuration(
            lines=[line], stations=[station("fp", 7, merge="off"), station("all", 0)], routes=list(routes)))
        self.watch = self.gateway.watch()

    def heard(self):
        """The commands that the station heard, each behind its header. All have a check code, and none was refused."""
        self.assertNotIn("!", self.fp7.log)
        found = TRACED.findall(self.fp7.log)
        self.assertNotIn("**", [check for _, _, check in found])
        return [header + text for header, text, _ in found]


class RawMaster:
    """Asks the simulated FP7 without a gateway."""

    def __init__(self, test):
        self.fd = os.open(test.folder / "line", os.O_RDWR | os.O_NOCTTY)
        test.addCleanup(os.close, self.fd)
        self.ask_until_heard()

    def ask_until_heard(self):
        """A device looks every few milliseconds whether somebody opened its port, and what was sent before is lost."""
        wait_for("it answers", lambda: self.ask("%EE#RT**", 0.1))
        heard = self.ask("%EE#RCSX0000**")
        while not heard.startswith("%EE$RC"):  # the answers of RT that came late
            heard = self.hear(PATIENCE)

    def ask(self, text, patience=PATIENCE):
        """Its answer without CR, or ""."""
        os.write(self.fd, text.encode("latin-1") + b"\r")
        return self.hear(patience)

    def hear(self, patience):
        heard = b""
        deadline = time.monotonic() + patience
        while not heard.endswith(b"\r"):
            if not select.select([self.fd], [], [], max(0, deadline - time.monotonic()))[0]:
                return heard.decode("latin-1")
            heard += os.read(self.fd, 1)
        return heard[:-1].decode("latin-1")
