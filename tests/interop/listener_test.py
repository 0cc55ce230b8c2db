"""Serial device servers connect to the gateway, and pass on what is said on their RTU or ASCII lines."""

import select
import socket
import struct
import time

from faulty_device import framed
from support import PATIENCE, InteropTest, main

READ = struct.pack(">BHH", 3, 5, 1)


def rtu(unit, pdu):
    return framed(bytes([unit]) + pdu)


def ascii_framed(unit, pdu):
    content = bytes([unit]) + pdu
    return b":" + (content + bytes([-sum(content) & 0xFF])).hex().upper().encode() + b"\r\n"


def write(value):
    return struct.pack(">BHH", 6, 5, value)


def read(value):
    return struct.pack(">BBH", 3, 2, value)


class ListenerTest(InteropTest):
    def start(self, framing):
        """Units 1 and 2 are two PLCs."""
        self.framed = rtu if framing == "rtu" else ascii_framed
        configuration = self.configuration(units=("main", "spare"))
        configuration["modbus_tcp"][0]["framing"] = framing
        self.gateway = self.start_gateway(configuration)
        self.line = self.connect()
        self.tell(self.framed(1, write(7)), self.framed(1, write(7)))

    def connect(self):
        line = socket.create_connection(("127.0.0.1", self.gateway.port), timeout=PATIENCE)
        line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self.addCleanup(line.close)
        return line

    def tell(self, said, expected, line=None):
        """What is said in one piece brings these bytes, and nothing more before the next question does."""
        line = line or self.line
        line.sendall(said)
        self.hear(expected, line)

    def hear(self, expected, line):
        heard = b""
        while len(heard) < len(expected):
            piece = line.recv(4096)
            self.assertTrue(piece, f"closed after {heard.hex(' ')}")
            heard += piece
        self.assertEqual(heard, expected)

    def silence(self, said):
        self.line.sendall(said)
        self.assertFalse(select.select([self.line], [], [], 0.3)[0])

    def everything(self, framing):
        self.start(framing)
        asked, answered = self.framed(1, READ), self.framed(1, read(7))
        for size in range(1, len(asked)):  # torn by the network at every place
            self.line.sendall(asked[:size])
            time.sleep(0.005)
            self.tell(asked[size:], answered)
        self.tell(asked + asked + self.framed(2, READ), answered + answered + self.framed(2, read(0)))
        # Others of the line, and what they answer.
        self.silence(self.framed(9, READ))
        self.tell(self.framed(9, READ) + self.framed(9, read(1)) + asked, answered)
        # Of everybody's business, and answered by nobody.
        self.silence(self.framed(0, write(8)))
        for unit in (1, 2):
            self.tell(self.framed(unit, READ), self.framed(unit, read(8)))
        # Damage and halves are left out, the connection stays.
        self.silence(asked[:-3] + bytes([asked[-3] ^ 1]) + asked[-2:])
        self.silence(asked[:5])
        if framing == "ascii":
            time.sleep(1)
        self.tell(asked, self.framed(1, read(8)))
        # Who leaves in the middle disturbs nobody.
        for size in range(len(asked) + 1):
            leaving = self.connect()
            leaving.sendall(asked[:size])
            leaving.close()
        self.tell(asked, self.framed(1, read(8)), self.connect())
        self.tell(asked, self.framed(1, read(8)))

    def test_rtu(self):
        self.everything("rtu")

    def test_ascii(self):
        self.everything("ascii")


main()
