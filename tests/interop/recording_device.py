"""A MODBUS TCP device that keeps a record of who asked what: the members of a pair reach it by different addresses."""

import socket
import struct
import threading
import time


class RecordingDevice(threading.Thread):
    """Holding registers. Register 0 counts the times that it was read, so that its values are never the same."""

    def __init__(self, test):
        super().__init__(daemon=True)
        self.listener = socket.create_server(("0.0.0.0", 0))
        self.port = self.listener.getsockname()[1]
        self.registers = [0] * 100
        self.lock = threading.Lock()
        self.record = []  # (time, address that was asked, function, first, values or count)
        test.addCleanup(self.listener.close)
        self.start()

    def run(self):
        while True:
            try:
                client, _ = self.listener.accept()
            except OSError:
                return
            threading.Thread(target=self.serve, args=(client,), daemon=True).start()

    def serve(self, client):
        name = client.getsockname()[0]
        received = b""
        with client:
            while True:
                try:
                    heard = client.recv(4096)
                    if not heard:
                        return
                    received += heard
                    while len(received) >= 8 and len(received) >= 6 + int.from_bytes(received[4:6], "big"):
                        size = 6 + int.from_bytes(received[4:6], "big")
                        pdu = self.answer(name, received[7:size])
                        client.sendall(received[:4] + struct.pack(">HB", len(pdu) + 1, received[6]) + pdu)
                        received = received[size:]
                except OSError:
                    return

    def answer(self, name, pdu):
        function, first, count = struct.unpack(">BHH", pdu[:5])
        with self.lock:
            if function == 3:
                self.record.append((time.monotonic(), name, function, first, count))
                if first == 0:
                    self.registers[0] = (self.registers[0] + 1) % 65536
                values = self.registers[first:first + count]
                return struct.pack(f">BB{count}H", 3, 2 * count, *values)
            if function == 6:
                values = [count]
            elif function == 16:
                values = list(struct.unpack(f">{count}H", pdu[6:6 + 2 * count]))
            else:
                return bytes([function | 0x80, 1])
            self.record.append((time.monotonic(), name, function, first, values))
            self.registers[first:first + len(values)] = values
            return pdu[:5]

    def asked_by(self, name, since=0.0):
        with self.lock:
            return [each for each in self.record if each[1] == name and each[0] >= since]

    def writes(self):
        """What was written, in this order, whoever did."""
        with self.lock:
            return [(first, values) for _, _, function, first, values in self.record if function != 3]
