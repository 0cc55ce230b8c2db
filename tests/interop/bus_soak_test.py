"""The gateway as two of 33 stations on a busy RTU line at the pace of 115200 bit/s: a client talks to all of them.

Every request to the gateway must be answered, rightly, and nothing else may ever be said by it. BUS_SOAK_SECONDS makes
it longer than 10 s, BUS_SOAK_SEED repeats a run.
"""

import os
import random
import select
import struct
import time
import tty

from faulty_device import framed
from support import InteropTest, main, wait_for

SECONDS = float(os.environ.get("BUS_SOAK_SECONDS", "10"))
SEED = int(os.environ.get("BUS_SOAK_SEED", str(time.time_ns() % 1_000_000)))

BIT = 10 / 115200  # seconds of a character, 8N1
GAP = 0.00175      # between frames, above 19200 bit/s
SILENCE = 0.02     # the gateway's silence_ms
OURS = (5, 17)
NEIGHBOURS = [unit for unit in range(1, 34) if unit not in OURS]
UNKNOWN = 0x41       # a function that no station has
PATIENCE = 2       # seconds for an answer, on a machine that has other things to do
LAST_D = 100       # registers D0 to D99 are read and written
LAST_M = 64


def bits_to_bytes(bits):
    return bytes(sum(bit << i for i, bit in enumerate(bits[at:at + 8])) for at in range(0, len(bits), 8))


class Station:
    """What a PLC of ours must answer."""

    def __init__(self):
        self.registers = [0] * LAST_D
        self.coils = [0] * LAST_M

    def answer(self, pdu):
        function = pdu[0]
        if function == 0x11:
            return bytes([0x11, 2, 0xF3, 0xFF])
        if function == 0x41:
            return bytes([0xC1, 1])
        first, value = struct.unpack(">HH", pdu[1:5])
        if function == 8:
            return pdu
        if function in (3, 4):
            if first + value > LAST_D:
                return bytes([function | 0x80, 2])
            return bytes([function, 2 * value]) + struct.pack(f">{value}H", *self.registers[first:first + value])
        if function in (1, 2):
            return bytes([function, (value + 7) // 8]) + bits_to_bytes(self.coils[first:first + value])
        if function == 5:
            self.coils[first] = int(value == 0xFF00)
            return pdu
        if function == 6:
            self.registers[first] = value
            return pdu
        if function == 0x0F:
            self.coils[first:first + value] = [pdu[6 + i // 8] >> i % 8 & 1 for i in range(value)]
            return pdu[:5]
        if function == 0x10:
            self.registers[first:first + value] = struct.unpack(f">{value}H", pdu[6:])
            return pdu[:5]
        if function == 0x16:
            or_mask, = struct.unpack(">H", pdu[5:7])
            self.registers[first] = self.registers[first] & value | or_mask & ~value & 0xFFFF
            return pdu
        to, count = struct.unpack(">HH", pdu[5:9])  # 17
        self.registers[to:to + count] = struct.unpack(f">{count}H", pdu[10:])
        return bytes([0x17, 2 * value]) + struct.pack(f">{value}H", *self.registers[first:first + value])


class Talk:
    """Random requests, and what neighbours answer."""

    def __init__(self, dice):
        self.dice = dice

    def words(self, count):
        return struct.pack(f">{count}H", *(self.dice.choice((0, 1, 0xFFFF, self.dice.randrange(0x10000)))
                                           for _ in range(count)))

    def ours(self, known_only=False):
        """A request that a Station can answer."""
        dice = self.dice
        count = dice.randint(1, 20)
        first = dice.randrange(LAST_D - count)
        bits = dice.randint(1, 30)
        bit = dice.randrange(LAST_M - bits)
        kinds = [
            lambda: struct.pack(">BHH", dice.choice((3, 4)), first, count),
            lambda: struct.pack(">BHH", 3, 0xFFF0, 0x10),
            lambda: struct.pack(">BHH", dice.choice((1, 2)), bit, bits),
            lambda: struct.pack(">BHH", 5, bit, dice.choice((0, 0xFF00))),
            lambda: struct.pack(">BHH", 6, first, dice.randrange(0x10000)),
            lambda: struct.pack(">BHHB", 0x0F, bit, bits, (bits + 7) // 8) +
            bytes(dice.randrange(256) for _ in range((bits + 7) // 8)),
            lambda: struct.pack(">BHHB", 0x10, first, count, 2 * count) + self.words(count),
            lambda: struct.pack(">BHHH", 0x16, first, dice.randrange(0x10000), dice.randrange(0x10000)),
            lambda: struct.pack(">BHHHHB", 0x17, first, count, first, count, 2 * count) + self.words(count),
            lambda: struct.pack(">BHH", 8, 0, dice.randrange(0x10000)),
            lambda: bytes([0x11]),
            lambda: bytes([UNKNOWN]) + self.words(dice.randint(0, 3)),
        ]
        return dice.choice(kinds[:-1] if known_only else kinds)()

    def neighbours(self):
        """A request and its response, of any function and size. Some of their data are whole requests to us."""
        dice = self.dice
        count = dice.choice((1, 2, 10, 60, 120))
        data = self.words(count)
        if count >= 10 and dice.random() < 0.3:
            held = framed(bytes([dice.choice((0, *OURS)), 6, 0, dice.randrange(LAST_D), 0xBA, 0xD0]))
            at = dice.randrange(2 * count - len(held))
            data = data[:at] + held + data[at + len(held):]
        first = dice.randrange(0x10000)
        return dice.choice((
            lambda: (struct.pack(">BHH", 3, first, count), bytes([3, 2 * count]) + data),
            lambda: (struct.pack(">BHH", 4, first, count), bytes([4, 2 * count]) + data),
            lambda: (struct.pack(">BHH", 1, first, 16 * count), bytes([1, 2 * count]) + data),
            lambda: (struct.pack(">BHHB", 0x10, first, count, 2 * count) + data,
                     struct.pack(">BHH", 0x10, first, count)),
            lambda: (struct.pack(">BHH", 6, first, count),) * 2,
            lambda: (struct.pack(">BHH", 5, first, 0xFF00),) * 2,
            lambda: (struct.pack(">BHH", 8, 0, first),) * 2,
            lambda: (bytes([7]), bytes([7, dice.randrange(256)])),
            lambda: (bytes([0x11]), bytes([0x11, 2, 0xF3, 0xFF])),
            lambda: (struct.pack(">BHH", 3, first, count), bytes([0x83, dice.choice((1, 2, 3, 4))])),
        ))()


class BusSoakTest(InteropTest):
    def setUp(self):
        self.dice = random.Random(SEED)
        self.talk = Talk(self.dice)
        self.stations = {unit: Station() for unit in OURS}
        self.line, theirs = os.openpty()
        tty.setraw(theirs)
        os.symlink(os.ttyname(theirs), self.folder / "line")
        for fd in (self.line, theirs):
            self.addCleanup(os.close, fd)
        self.in_step = True  # silence, and no noise since
        self.slowest = 0.0
        units = [{"unit": unit, "plc": f"plc{unit}", "channel": 1} for unit in OURS]
        self.gateway = self.start_gateway(self.configuration(units=[each["plc"] for each in units], lines=[
            {"name": "bus", "device": str(self.folder / "line"), "baud_rate": 115200, "parity": "none",
             "role": "server", "silence_ms": int(SILENCE * 1000), "units": units}]))
        wait_for("the line is open", lambda: "line bus: " in self.gateway.log and "is open" in self.gateway.log)
        self.be_silent()

    def be_silent(self):
        """Until the gateway has surely noticed it."""
        time.sleep(4 * SILENCE)
        self.in_step = True

    def nothing_said(self, about):
        if select.select([self.line], [], [], 0)[0]:
            self.fail(f"the gateway said {os.read(self.line, 4096).hex(' ')} {about}")

    def say(self, frame):
        """Writes a frame at once or in two parts. Returns whether the parts came close enough to be one frame."""
        cut = self.dice.randrange(len(frame)) if self.dice.random() < 0.3 else 0
        first_at = time.monotonic()
        if cut:
            os.write(self.line, frame[:cut])
            time.sleep(cut * BIT)
        os.write(self.line, frame[cut:])
        whole = time.monotonic() - first_at < SILENCE / 2 or not cut
        time.sleep((len(frame) - cut) * BIT)
        return whole

    def hear(self, size):
        heard = b""
        deadline = time.monotonic() + PATIENCE
        while len(heard) < size and select.select([self.line], [], [], max(0, deadline - time.monotonic()))[0]:
            heard += os.read(self.line, 4096)
        return heard

    def gap(self):
        time.sleep(GAP + self.dice.choice((0, 0, 0.001, 0.005)) * self.dice.random())

    def ask_us(self):
        unit = self.dice.choice(OURS)
        pdu = self.talk.ours(known_only=not self.in_step)  # only silence ends an unknown function
        before = (self.stations[unit].registers[:], self.stations[unit].coils[:])
        expected = framed(bytes([unit]) + self.stations[unit].answer(pdu))
        asked_at = time.monotonic()
        whole = self.say(framed(bytes([unit]) + pdu))
        if not whole:  # this machine stood still in the middle of the frame
            self.stations[unit].registers, self.stations[unit].coils = before
            self.torn += 1
            if self.hear(len(expected)) == expected:
                self.stations[unit].answer(pdu)
            self.be_silent()
            return
        heard = self.hear(len(expected))
        if not heard and pdu[0] == UNKNOWN:
            # Only silence ends it, and shows where it begins: the gateway may not have had the processor for so long.
            self.torn += 1
            self.be_silent()
            self.say(framed(bytes([unit]) + pdu))
            heard = self.hear(len(expected))
        self.assertEqual(heard.hex(" "), expected.hex(" "), f"to {unit:02x} {pdu.hex(' ')}")
        self.slowest = max(self.slowest, time.monotonic() - asked_at)
        self.asked += 1
        self.in_step = True  # the client was silent while it waited

    def tell_all(self):
        if not self.in_step:
            self.be_silent()
        pdu = struct.pack(">BHH", 6, self.dice.randrange(LAST_D), self.dice.randrange(0x10000))
        if not self.say(framed(b"\0" + pdu)):
            self.be_silent()  # told again, whether it was heard or not
            os.write(self.line, framed(b"\0" + pdu))
        for each in self.stations.values():
            each.answer(pdu)
        time.sleep(SILENCE * 2)  # the turnaround delay
        self.told += 1

    def ask_neighbour(self, noisy):
        unit = self.dice.choice(NEIGHBOURS)
        request, response = (framed(bytes([unit]) + pdu) for pdu in self.talk.neighbours())
        self.say(request)
        self.neighbours_asked += 1
        if self.dice.random() < 0.03:  # it does not answer
            time.sleep(0.03)
            return
        self.gap()
        damaged = noisy and self.dice.random() < 0.1
        if damaged:
            at = self.dice.randrange(len(response))
            response = response[:at] + bytes([response[at] ^ 1 << self.dice.randrange(8)]) + response[at + 1:]
        self.say(response)
        if damaged:
            self.in_step = False
            time.sleep(0.03)  # the client's response timeout

    def soak(self, seconds, noisy):
        self.asked = self.told = self.torn = self.neighbours_asked = 0
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.gap()
            self.nothing_said("unasked")
            if noisy and self.dice.random() < 0.1:
                os.write(self.line, self.dice.choice((b"\0", b"\xff", b"\xff\0", self.dice.randbytes(5))))
                self.in_step = False
            what = self.dice.random()
            if what < 0.25:
                self.ask_us()
            elif what < 0.28:
                self.tell_all()
            else:
                self.ask_neighbour(noisy)
        time.sleep(0.3)
        self.nothing_said("at the end")
        for unit, each in self.stations.items():
            registers = struct.pack(f">{LAST_D}H", *each.registers)
            os.write(self.line, framed(struct.pack(">BBHH", unit, 3, 0, LAST_D)))
            expected = framed(bytes([unit, 3, 2 * LAST_D]) + registers)
            self.assertEqual(self.hear(len(expected)).hex(" "), expected.hex(" "))
            time.sleep(GAP)
        print(f"seed {SEED}, {seconds:.0f} s: {self.asked} own requests, all answered, the slowest after "
              f"{self.slowest * 1000:.0f} ms; {self.neighbours_asked} to neighbours, {self.told} to all; "
              f"{self.torn} own requests torn by this machine", flush=True)
        self.assertGreater(self.asked, 2 * seconds)

    def test_clean_line(self):
        self.soak(SECONDS / 2, noisy=False)

    def test_noisy_line(self):
        self.soak(SECONDS / 2, noisy=True)


main()
