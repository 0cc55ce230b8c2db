"""A field device on a pty that can do what libmodbus would never do: answer late, wrong, in pieces, or babble."""

import heapq
import os
import select
import struct
import threading
import time
import tty

from support import InteropTest, route, serial_line, station


def crc(data):
    value = 0xFFFF
    for byte in data:
        value ^= byte
        for _ in range(8):
            value = value >> 1 ^ (0xA001 if value & 1 else 0)
    return struct.pack("<H", value)


def framed(body):
    return body + crc(body)


class FaultyDevice(threading.Thread):
    """Unit 1, whose holding registers hold their own address plus `offset`."""

    def __init__(self, link):
        super().__init__(daemon=True)
        self.ours, self.theirs = os.openpty()  # both stay open: the port never hangs up
        tty.setraw(self.theirs)
        os.set_blocking(self.ours, False)
        os.symlink(os.ttyname(self.theirs), link)
        self.link = link
        self.offset = 0
        self.stood_still = 0   # seconds at most by which the machine was late
        self.misbehave = None  # makes of the good answer a list of (seconds, bytes) that are sent instead
        self.babble = None     # bytes that are sent all the time
        self.asked = 0         # requests so far
        self.silences = []     # seconds from before an answer's last byte was written to the next request
        self.wrote_at = None
        self.outgoing = []     # heap of (time, number, bytes)
        self.ended = False

    def run(self):
        while not self.ended:
            patience, began = self.patience(), time.monotonic()
            heard = select.select([self.ours], [], [], patience)[0]
            self.stood_still = max(self.stood_still, time.monotonic() - began - patience)
            if heard:
                self.hear(os.read(self.ours, 4096))
            while self.outgoing and self.outgoing[0][0] <= time.monotonic():
                self.say(heapq.heappop(self.outgoing)[2])
            if self.babble:
                self.say(self.babble)

    def patience(self):
        if self.babble:
            return 0.001
        return min(0.05, max(0, self.outgoing[0][0] - time.monotonic())) if self.outgoing else 0.05

    def hear(self, received):
        if self.wrote_at is not None:
            self.silences.append(time.monotonic() - self.wrote_at)
            self.wrote_at = None
        for request in (received[at:at + 8] for at in range(0, len(received), 8)):
            self.asked += 1
            for delay, data in self.misbehave(self.answer(request)) if self.misbehave else [(0, self.answer(request))]:
                heapq.heappush(self.outgoing, (time.monotonic() + delay, self.asked, data))

    def answer(self, request):
        unit, function, first, count = struct.unpack(">BBHH", request[:6])
        if (unit, function) != (1, 3) or framed(request[:6]) != request:
            raise AssertionError(f"no request of ours: {request.hex(' ')}")
        values = range(first + self.offset, first + self.offset + count)
        return framed(struct.pack(f">BBB{count}H", unit, function, 2 * count, *values))

    def say(self, data):
        self.wrote_at = time.monotonic()
        try:
            os.write(self.ours, data)
        except BlockingIOError:
            pass  # lost, as on a line that nobody reads

    def end(self):
        self.ended = True
        self.join()
        os.close(self.ours)
        os.close(self.theirs)
        os.unlink(self.link)


class FaultyDeviceTest(InteropTest):
    """A gateway with two routes of the device: equal counts, different addresses."""

    def start(self, period_ms=20, **line):
        self.device = FaultyDevice(self.folder / "line")
        self.addCleanup(self.device.end)
        self.device.start()
        self.gateway = self.start_gateway(self.configuration(
            lines=[serial_line(self.folder / "line", **line)], stations=[station("pump", 1)],
            routes=[route("pump.low", "holding", 0, "D100", 2, period_ms=period_ms),
                    route("pump.high", "holding", 1000, "D110", 2, period_ms=period_ms)]))
        self.watch = self.gateway.watch()
        self.client = self.gateway.client()
        self.expect_good(0)

    def expect_good(self, offset):
        self.watch.expect("pump.low", quality="good", values=[offset, offset + 1])
        self.watch.expect("pump.high", quality="good", values=[offset + 1000, offset + 1001])
        self.assertEqual(self.client.holding(100, 2), [offset, offset + 1])
        self.assertEqual(self.client.holding(110, 2), [offset + 1000, offset + 1001])
