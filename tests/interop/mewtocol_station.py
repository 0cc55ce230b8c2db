"""A simulated FP7 on a pty that speaks MEWTOCOL-COM: split responses, errors, late, damaged and missing answers.

Written from the protocol's notes alone, with its own check code: nothing of it is shared with the gateway. What it
needs of a pty is the base of the station that speaks MEWTOCOL7-COM, too.
"""

import heapq
import os
import re
import select
import threading
import time
import tty

WORD_COMMANDS = {"RD": re.compile(r"([DLF])(\d{5})(\d{5})$"), "RC": re.compile(r"C([XYRL])(\d{4})(\d{4})$"),
                 "WD": re.compile(r"([DLF])(\d{5})(\d{5})((?:[0-9A-F]{4})+)$"),
                 "WC": re.compile(r"C([YRL])(\d{4})(\d{4})((?:[0-9A-F]{4})+)$")}
CONTACT = re.compile(r"([XYRL])(\d{3})([0-9A-F])")


def bcc(text):
    value = 0
    for character in text.encode():
        value ^= character
    return f"{value:02X}"


def swapped(words):
    return "".join(f"{word & 0xFF:02X}{word >> 8:02X}" for word in words)


class Refused(Exception):
    """The two digits of an error response."""


class PtyStation(threading.Thread):
    """Hears frames that end with CR. What it answers, `misbehave` may spoil."""

    def __init__(self, link):
        super().__init__(daemon=True)
        self.ours, self.theirs = os.openpty()  # both stay open: the port never hangs up
        tty.setraw(self.theirs)
        os.set_blocking(self.ours, False)
        os.symlink(os.ttyname(self.theirs), link)
        self.link = link
        self.misbehave = None  # makes of the good answer a list of (seconds, bytes) that are sent instead
        self.refuse = None     # two digits: answered to everything
        self.commands = []     # heard, without header and check
        self.wrong = []        # frames that no client may send
        self.received = b""
        self.outgoing = []     # heap of (time, number, bytes)
        self.asked = 0
        self.ended = False

    def run(self):
        while not self.ended:
            if select.select([self.ours], [], [], self.patience())[0]:
                self.received += os.read(self.ours, 4096)
                while b"\r" in self.received:
                    frame, _, self.received = self.received.partition(b"\r")
                    self.hear(frame.decode())
            while self.outgoing and self.outgoing[0][0] <= time.monotonic():
                self.transmit(heapq.heappop(self.outgoing)[2])

    def transmit(self, data):
        """A pty takes some thousand bytes at a time; what nobody reads is lost after a while, as on a line."""
        give_up = time.monotonic() + 0.5
        while data and time.monotonic() < give_up:
            try:
                data = data[os.write(self.ours, data):]
            except BlockingIOError:
                time.sleep(0.001)

    def patience(self):
        return min(0.02, max(0, self.outgoing[0][0] - time.monotonic())) if self.outgoing else 0.02

    def hear(self, frame):
        raise NotImplementedError

    def say(self, answer):
        """With the end code."""
        for delay, data in self.misbehave(answer) if self.misbehave else [(0, answer)]:
            self.asked += 1
            heapq.heappush(self.outgoing, (time.monotonic() + delay, self.asked, data))

    def end(self):
        self.ended = True
        self.join()
        os.close(self.ours)
        os.close(self.theirs)
        os.unlink(self.link)


class MewtocolStation(PtyStation):
    """DT and LD words hold their number; WX, WY, WR and WL are 0, until somebody writes."""

    def __init__(self, link, number=7, split=None, longest=2048):
        super().__init__(link)
        self.number = number
        self.split = split     # characters of data in a frame of a `%` response, or None: it is never split
        self.longest = longest  # characters of a frame
        self.memory = {}       # (area, number): word
        self.sizes = {"D": 10000, "L": 10000, "WX": 128, "WY": 128, "WR": 128, "WL": 128}
        self.globals = []      # commands to all stations
        self.rest = []         # frames of a response that wait for `&`

    def hear(self, frame):
        more = frame.endswith("&")
        text, check = (frame[:-3], frame[-3:-1]) if more else (frame[:-2], frame[-2:])
        if check != bcc(text) or len(frame) + 1 > (118 if frame[0] == "%" else self.longest):
            self.wrong.append(frame)
            return
        head, station, body = text[0], text[1:3], text[3:]
        if station == "FF":
            self.globals.append(body[1:])
            self.execute(body[1:])
            return
        if station != f"{self.number:02}":
            return
        self.commands.append(body[1:])
        if more:
            answers = [self.rest.pop(0)] if self.rest else ["!43"]
        elif body == "#AB":
            self.rest = []
            return
        else:
            self.rest = []
            answers = self.respond(head, body[1:])
        last = not self.rest
        answer = f"{head}{station}{answers[0]}"
        self.say((answer + bcc(answer) + ("" if last else "&") + "\r").encode())

    def respond(self, head, command):
        try:
            if self.refuse:
                raise Refused(self.refuse)
            data = self.execute(command)
        except Refused as refused:
            return [f"!{refused}"]
        answer = f"${command[:2]}{data}"
        if head == "%" and self.split:
            self.rest = [answer[at:at + self.split] for at in range(0, len(answer), self.split)]
            return [self.rest.pop(0)]
        return [answer]

    def execute(self, command):
        name = command[:2]
        if command[:3] in ("RCS", "RCP", "WCS", "WCP"):
            return self.contacts(command)
        if name not in WORD_COMMANDS:
            raise Refused("42")
        found = WORD_COMMANDS[name].match(command[2:])
        if not found:
            raise Refused("41")
        area = ("W" if name in ("RC", "WC") else "") + found[1]
        first, last = int(found[2]), int(found[3])
        if last < first or last >= self.sizes.get(area, 0):
            raise Refused("61")
        if name.startswith("R"):
            return swapped(self.word(area, number) for number in range(first, last + 1))
        values = [int(found[4][at + 2:at + 4] + found[4][at:at + 2], 16) for at in range(0, len(found[4]), 4)]
        if len(values) != last - first + 1:
            raise Refused("41")
        for number, value in enumerate(values, first):
            self.memory[area, number] = value
        return ""

    def contacts(self, command):
        text = command[3:] if command[2] == "S" else command[4:]
        count = 1 if command[2] == "S" else int(command[3])
        found = []
        while text:
            contact = CONTACT.match(text)
            if not contact:
                raise Refused("41")
            area, word, bit = "W" + contact[1], int(contact[2]), int(contact[3], 16)
            text = text[5:]
            if word >= self.sizes[area]:
                raise Refused("61")
            if command.startswith("W"):
                if contact[1] == "X":
                    raise Refused("60")
                self.memory[area, word] = self.word(area, word) & ~(1 << bit) | int(text[0]) << bit
                text = text[1:]
            found.append(self.word(area, word) >> bit & 1)
        if len(found) != count:
            raise Refused("41")
        return "".join(map(str, found)) if command.startswith("R") else ""

    def word(self, area, number):
        return self.memory.get((area, number), number if area in "DL" else 0)
