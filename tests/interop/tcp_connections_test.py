"""Connections to the MODBUS TCP server: many, pipelined, in pieces, and those that are no MODBUS TCP."""

import socket
import struct
import threading
import time

from support import PATIENCE, Client, InteropTest, main, wait_for


def adu(transaction, pdu, unit=1, protocol=0, length=None):
    return struct.pack(">HHHB", transaction, protocol, len(pdu) + 1 if length is None else length, unit) + pdu


def read_holding(first, count=1):
    return struct.pack(">BHH", 3, first, count)


def write_register(at, value):
    return struct.pack(">BHH", 6, at, value)


class Connection:
    """A plain socket: what it sends is up to the test."""

    def __init__(self, test, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=PATIENCE)
        self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        test.addCleanup(self.socket.close)

    def send(self, data):
        self.socket.sendall(data)

    def receive(self, size):
        data = b""
        while len(data) < size:
            piece = self.socket.recv(size - len(data))
            if not piece:
                raise AssertionError(f"closed after {data.hex(' ')}")
            data += piece
        return data

    def answer(self):
        """Transaction id, unit and PDU."""
        transaction, protocol, length, unit = struct.unpack(">HHHB", self.receive(7))
        if protocol != 0:
            raise AssertionError(f"protocol id {protocol}")
        return transaction, unit, self.receive(length - 1)

    def closed(self):
        """Waits until the server closes, and returns the bytes that came before."""
        data = b""
        try:
            while piece := self.socket.recv(4096):
                data += piece
        except ConnectionResetError:
            pass  # it had not read all of what we sent
        return data


class TcpConnectionsTest(InteropTest):
    def start(self, **more):
        configuration = self.configuration(dds={"enabled": False})
        configuration["modbus_tcp"][0].update(more)
        self.gateway = self.start_gateway(configuration)

    def connect(self):
        return Connection(self, self.gateway.port)

    def test_twenty_clients_at_once(self):
        self.start()
        clients = [self.gateway.client() for _ in range(20)]
        wrong = []

        def use(number, client):
            try:
                for turn in range(30):
                    values = [number, turn, number * turn]
                    client.write_registers(100 * number, values)
                    if client.holding(100 * number, 3) != values:
                        wrong.append((number, turn))
            except Exception as error:  # pylint: disable=broad-except
                wrong.append((number, error))

        threads = [threading.Thread(target=use, args=each) for each in enumerate(clients)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])

    def test_pipelined_requests_are_answered_in_order(self):
        self.start()
        connection = self.connect()
        requests = []
        for i in range(25):
            requests += [adu(1000 + 2 * i, write_register(i, 7 * i)), adu(1001 + 2 * i, read_holding(i))]
        connection.send(b"".join(requests))
        for i in range(25):
            self.assertEqual(connection.answer(), (1000 + 2 * i, 1, write_register(i, 7 * i)))
            self.assertEqual(connection.answer(), (1001 + 2 * i, 1, struct.pack(">BBH", 3, 2, 7 * i)))

    def test_pipelined_requests_to_several_units_keep_their_order(self):
        self.start()
        connection = self.connect()
        connection.send(b"".join(adu(i, read_holding(0), unit=1 + i % 2) for i in range(50)))
        answers = [connection.answer() for _ in range(50)]
        self.assertEqual(answers, [(i, 1 + i % 2, b"\x83\x0a" if i % 2 else b"\x03\x02\x00\x00") for i in range(50)])

    def test_largest_requests_and_answers_pipelined(self):
        self.start()
        connection = self.connect()
        values = struct.pack(">123H", *range(500, 623))
        connection.send(adu(1, struct.pack(">BHHB", 16, 0, 123, 246) + values) + adu(2, read_holding(0, 125)) * 50)
        self.assertEqual(connection.answer(), (1, 1, struct.pack(">BHH", 16, 0, 123)))
        for _ in range(50):
            self.assertEqual(connection.answer(), (2, 1, b"\x03\xfa" + values + bytes(4)))

    def test_frame_byte_by_byte(self):
        self.start()
        connection = self.connect()
        for byte in adu(0xBEEF, write_register(3, 4)) + adu(0xF00D, read_holding(3)):
            connection.send(bytes([byte]))
        self.assertEqual(connection.answer(), (0xBEEF, 1, write_register(3, 4)))
        self.assertEqual(connection.answer(), (0xF00D, 1, b"\x03\x02\x00\x04"))

    def test_what_is_no_modbus_tcp_is_closed_and_others_stay(self):
        self.start()
        bystander = self.gateway.client()
        strangers = {"protocol id 1": adu(1, read_holding(0), protocol=1),
                     "length 0": adu(1, read_holding(0), length=0),
                     "length 1": adu(1, b"", length=1),
                     "length 255": adu(1, bytes(254), length=255),
                     "length 65535": adu(1, bytes(100), length=65535),
                     "HTTP": b"GET / HTTP/1.1\r\n\r\n",
                     "TLS": bytes.fromhex("1603010200010001fc0303"),
                     "FF": b"\xff" * 1000}
        for what, data in strangers.items():
            with self.subTest(what):
                connection = self.connect()
                connection.send(data)
                self.assertEqual(connection.closed(), b"")
                self.assertIn(f":{connection.socket.getsockname()[1]} sent what is no MODBUS TCP", self.gateway.log)
                bystander.write_register(9, len(what))
                self.assertEqual(bystander.holding(9), [len(what)])

    def test_request_before_garbage_is_answered(self):
        self.start()
        connection = self.connect()
        connection.send(adu(1, write_register(0, 5)) + b"\xff" * 20)
        self.assertEqual(connection.closed(), adu(1, write_register(0, 5)))
        self.assertEqual(self.gateway.client().holding(0), [5])

    def test_client_beyond_max_clients_is_refused(self):
        self.start(max_clients=3)
        clients = [self.gateway.client() for _ in range(3)]
        for client in clients:
            client.holding(0)
        for _ in range(3):
            self.assertEqual(self.connect().closed(), b"")
        self.assertEqual(self.gateway.log.count("max_clients"), 1)
        self.assertEqual([client.holding(0) for client in clients], [[0]] * 3)

        clients[0].modbus.close()
        self.accepted()

    def test_client_that_leaves_in_the_middle_of_a_frame(self):
        self.start(max_clients=2)
        bystander = self.gateway.client()
        frame = adu(1, write_register(0, 1))
        for size in range(len(frame)):
            connection = self.connect()
            connection.send(frame[:size])
            connection.socket.close()
            self.accepted()  # its place is free again
        self.assertEqual(bystander.holding(0), [0])

    def test_client_that_never_reads_its_answers_holds_up_nobody(self):
        self.start()
        bystander = self.gateway.client()
        deaf = self.connect()
        deaf.socket.settimeout(0.5)
        with self.assertRaises(TimeoutError):  # all buffers between the two are full
            while True:
                deaf.send(adu(1, read_holding(0, 125)) * 1000)
        for value in range(20):
            bystander.write_register(0, value)
            self.assertEqual(bystander.holding(0), [value])

    def test_request_that_comes_too_slowly(self):
        self.start()
        connection = self.connect()
        begun = time.monotonic()
        with self.assertRaises(ConnectionError):
            for byte in adu(1, b"\x10" + bytes(252)):  # would take a minute
                connection.send(bytes([byte]))
                time.sleep(0.25)
        self.assertGreater(time.monotonic() - begun, 4.5)
        self.assertLess(time.monotonic() - begun, 9)
        self.assertIn("is silent for too long", self.gateway.log)

    def test_idle_timeout(self):
        configuration = self.configuration()
        configuration["modbus_tcp"][0]["idle_timeout_s"] = 1
        port = self.start_gateway(configuration).port
        with socket.create_connection(("127.0.0.1", port), timeout=PATIENCE) as silent:
            busy = Client(self, port)
            for _ in range(4):
                time.sleep(0.4)
                self.assertEqual(busy.holding(0), [0])
            self.assertEqual(silent.recv(1), b"")

    def accepted(self):
        """Connects until a request is answered, and leaves again."""
        def answered():
            connection = self.connect()
            try:
                connection.send(adu(1, read_holding(0)))
                connection.receive(11)
                return True
            except (AssertionError, ConnectionError):
                return False
            finally:
                connection.socket.close()
        wait_for("a place for one more client", answered)


main()
