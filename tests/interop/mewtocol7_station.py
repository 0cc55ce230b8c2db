"""A simulated FP7 on a pty that speaks MEWTOCOL7-COM, and other readings of what is not published about it.

Written from the protocol's notes alone, with its own CRC: nothing of it is shared with the gateway.
"""

from mewtocol_station import PtyStation, Refused

HEAD = 7  # characters: > @ station, frame number
SIZES = {"DT": 10000, "LD": 10000, "WX": 128, "WY": 128, "WR": 128, "WL": 128}
PUBLISHED = {"item": "D001", "scope": "G0", "address_digits": 8, "count_digits": 5, "base": 10,
             "high_byte_first": False, "before_words": "", "before_error": "", "before_piece": "", "names": {area: area for area in SIZES}}


def crc(text):
    """CRC-16/MCRF4XX, bit by bit. Of "123456789" it is 6F91."""
    value = 0xFFFF
    for character in text.encode():
        value ^= character
        for _ in range(8):
            value = value >> 1 ^ (0x8408 if value & 1 else 0)
    return f"{value:04X}"


class Mewtocol7Station(PtyStation):
    """DT and LD words hold their number; WX, WY, WR and WL are 0, until somebody writes."""

    def __init__(self, link, number=500, split=None, reading=None):
        super().__init__(link)
        self.number = number
        self.split = split   # characters of text in a frame of a response, or None: 4096 characters in all
        self.reading = {**PUBLISHED, **(reading or {})}
        self.memory = {}     # (area, number): word
        self.numbers = []    # of the frames heard, as they came
        self.rest = ""       # of a response, which waits for `&`
        self.awaited = None  # the frame number that asks for it

    def hear(self, frame):
        more = frame.endswith("&")
        text, check = (frame[:-5], frame[-5:-1]) if more else (frame[:-4], frame[-4:])
        if check != crc(text) or len(frame) + 1 > 4096 or not text.startswith(">@"):
            self.wrong.append(frame)
            return
        if text[2:5] != f"{self.number:03}":
            return
        number, body = int(text[5:7], 16), text[HEAD:]
        self.numbers.append(number)
        self.commands.append(body[1:])
        if more:
            if not self.rest or number != self.awaited or body:
                self.wrong.append(frame)
                return
            self.pass_on(number, self.reading["before_piece"], self.rest)
            return
        try:
            if not body.startswith("#"):
                raise Refused("41")
            if self.refuse:
                raise Refused(self.refuse)
            self.pass_on(number, "", self.execute(body[1:]))
        except Refused as refused:
            self.pass_on(number, "", f"!{self.reading['before_error']}{refused}")

    def pass_on(self, number, before, text):
        """One frame of a response; what does not fit waits."""
        fits = (self.split or 4096 - HEAD - len(before) - len("CRC4&\r")) if text[0] != "!" else len(text)
        if not self.split and len(text) == fits + 1:
            fits += 1  # the last frame has no `&`
        self.rest, self.awaited = text[fits:], (number + 1) % 256
        answer = f">@{self.number:03}{number:02X}{before}{text[:fits]}"
        self.say((answer + crc(answer) + ("&" if self.rest else "") + "\r").encode())

    def execute(self, command):
        name, fields, r = command[:6], command[6:], self.reading
        if name not in ("00MMRD", "00MMWT"):
            raise Refused("42")
        front = r["item"] + r["scope"]
        area = next((a for a, called in r["names"].items() if fields.startswith(front + called)), None)
        if area is None:
            raise Refused("60")
        fields = fields[len(front) + len(r["names"][area]):]
        digits = r["address_digits"], r["count_digits"]
        first = int(fields[:digits[0]], r["base"])
        count = int(fields[digits[0]:sum(digits)], r["base"])
        data = fields[sum(digits):]
        if count == 0 or first + count > SIZES[area]:
            raise Refused("61")
        order = "big" if r["high_byte_first"] else "little"
        if name == "00MMRD":
            if data:
                raise Refused("41")
            words = (self.word(area, first + i) for i in range(count))
            return f"${name}{r['before_words']}" + "".join(w.to_bytes(2, order).hex().upper() for w in words)
        if len(data) != 4 * count or data != data.upper():
            raise Refused("41")
        for i in range(count):
            self.memory[area, first + i] = int.from_bytes(bytes.fromhex(data[4 * i:4 * i + 4]), order)
        return f"${name}"

    def word(self, area, number):
        return self.memory.get((area, number), number if area in ("DT", "LD") else 0)
