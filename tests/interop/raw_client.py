"""The client of a serial line, byte by byte."""

import os
import select
import struct
import time
import tty

from faulty_device import framed
from support import PATIENCE


class RawClient:
    """The client's end of a pty whose other end the gateway opens as folder/line."""

    def __init__(self, test):
        self.ours, theirs = os.openpty()
        tty.setraw(theirs)
        os.symlink(os.ttyname(theirs), test.folder / "line")
        self.delays = []  # seconds from before a request was written to the first byte of its answer
        for fd in (self.ours, theirs):
            test.addCleanup(os.close, fd)

    def send(self, data):
        self.sent_at = time.monotonic()
        os.write(self.ours, data)

    def hear(self, patience=PATIENCE):
        """The next answer: what comes until 50 ms of silence."""
        heard = b""
        while select.select([self.ours], [], [], 0.05 if heard else patience)[0]:
            if not heard:
                self.delays.append(time.monotonic() - self.sent_at)
            heard += os.read(self.ours, 4096)
        return heard

    def ask(self, unit, pdu, patience=PATIENCE):
        """The answer's PDU; it must be of that unit and have a good CRC."""
        self.send(framed(bytes([unit]) + pdu))
        answer = self.hear(patience)
        if answer and (answer[0] != unit or framed(answer[:-2]) != answer):
            raise AssertionError(f"no answer of unit {unit}: {answer.hex(' ')}")
        return answer[1:-2]

    def number(self, unit, sub):
        """A counter, by 08 and its sub-function."""
        answer = self.ask(unit, struct.pack(">BHH", 8, sub, 0))
        function, same, value = struct.unpack(">BHH", answer)
        if (function, same) != (8, sub):
            raise AssertionError(f"no answer to 08/{sub:02X}: {answer.hex(' ')}")
        return value
