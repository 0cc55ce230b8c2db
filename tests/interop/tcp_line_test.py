"""A line that is a MODBUS TCP connection: libmodbus, pymodbus and a server that misbehaves at its other end."""

import select
import socket
import struct
import threading
import time

from support import Device, InteropTest, Program, Refused, holds, main, route, station, wait_for

PYMODBUS_SERVER = """
import sys
from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.server import StartTcpServer
block = ModbusSequentialDataBlock(0, list(range(200)))
StartTcpServer(context=ModbusServerContext(slaves=ModbusSlaveContext(hr=block, zero_mode=True)),
               address=("127.0.0.1", int(sys.argv[1])), allow_reuse_address=True)
"""


class FakeServer(threading.Thread):
    """Holding registers that hold their own address. It keeps `together` requests and then answers the last one first."""

    def __init__(self, test):
        super().__init__(daemon=True)
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        self.together = 1
        self.most = 0          # requests that were kept at a time
        self.connections = 0
        self.strange = lambda answer: b""  # what is sent before an answer
        self.ended = False
        self.deaf_on = ()      # connections, counted from 1, on which nothing is answered
        test.addCleanup(self.end)

    def run(self):
        while not self.ended:
            if select.select([self.listener], [], [], 0.05)[0]:
                client, _ = self.listener.accept()
                self.connections += 1
                with client:
                    self.serve(client)

    def serve(self, client):
        received, kept = b"", []
        while not self.ended:
            if select.select([client], [], [], 0.1)[0]:
                try:
                    heard = client.recv(4096)
                except ConnectionResetError:
                    return
                if not heard:
                    return
                received += heard
            else:
                self.answer_all(client, kept)  # no more will come
            if self.connections in self.deaf_on:
                received = b""
            while len(received) >= 12:
                kept.append(received[:12])
                received = received[12:]
            self.most = max(self.most, len(kept))
            if len(kept) >= self.together:
                self.answer_all(client, kept)

    def answer_all(self, client, kept):
        while kept:
            transaction, _, _, unit, function, first, count = struct.unpack(">HHHBBHH", kept.pop())
            values = struct.pack(f">{count}H", *range(first, first + count))
            answer = struct.pack(">HHHBBB", transaction, 0, 3 + 2 * count, unit, function, 2 * count) + values
            client.sendall(self.strange(answer) + answer)

    def end(self):
        self.ended = True
        self.join()
        self.listener.close()


class TcpLineTest(InteropTest):
    def start(self, port, host="127.0.0.1", routes=None, merge="auto", **line):
        self.gateway = self.start_gateway(self.configuration(
            lines=[{"name": "line", "protocol": "modbus-tcp", "host": host, "port": port, "response_timeout_ms": 500,
                    **line}],
            stations=[station("pump", 1, merge=merge)],
            routes=routes or [route("pump.low", "holding", 10, "D100", 2, period_ms=50)]))
        self.watch = self.gateway.watch()
        self.client = self.gateway.client()

    def start_side_door(self, port=None):
        """A field device of which the side door is used."""
        if port is None:
            self.start_bus(3)
            return self.start_device(1, 1, "--set", "hr:10=1234", "--set", "hr:11=5")
        test = self

        class SamePort:  # what Device wants of its test
            def __getattr__(self, name):
                return (lambda: port) if name == "free_port" else getattr(test, name)

        return Device(SamePort(), self.folder / "line.1", 1, "--set", "hr:10=4321", "--set", "hr:11=5")

    def expect_values(self, values):
        self.watch.expect("pump.low", quality="good", values=values)
        self.assertEqual(self.client.holding(100, 2), values)

    def test_libmodbus(self):
        device = self.start_side_door()
        self.start(device.tcp_port, routes=[
            route("pump.low", "holding", 10, "D100", 2, period_ms=50),
            route("pump.coils", "coil", 0, "M0", 3, period_ms=50),
            route("pump.out", "holding", 30, "D200", 2, direction="write")])
        self.expect_values([1234, 5])
        device.door.write_registers(10, [7, 8])
        device.door.write_coils(0, [1, 0, 1])
        self.expect_values([7, 8])
        wait_for("the coils", lambda: self.client.coils(0, 3) == [1, 0, 1])
        self.client.write_registers(200, [41, 42])
        wait_for("what is written arrives", lambda: device.door.holding(30, 2) == [41, 42])

    def test_name_of_a_host(self):
        device = self.start_side_door()
        self.start(device.tcp_port, host="localhost")
        self.expect_values([1234, 5])

    def test_server_that_ends_and_comes_back(self):
        device = self.start_side_door()
        self.start(device.tcp_port)
        self.expect_values([1234, 5])
        device.kill()
        self.watch.expect("pump.low", quality="comm error", values=[1234, 5])
        time.sleep(1)
        self.assertEqual(self.client.holding(100, 2), [1234, 5])
        self.start_side_door(device.tcp_port)
        self.expect_values([4321, 5])

    def test_connection_on_which_nothing_comes_any_more(self):
        server = FakeServer(self)
        server.deaf_on = (1,)
        server.start()
        self.start(server.port)
        self.expect_values([10, 11])
        self.assertEqual(server.connections, 2)

    def test_server_that_comes_later(self):
        port = self.free_port()
        self.start(port)
        self.watch.expect("pump.low", quality="comm error")
        self.start_bus(3)
        self.start_side_door(port)
        self.expect_values([4321, 5])

    def test_pymodbus(self):
        port = self.free_port()
        Program(self, "pymodbus", ["/usr/bin/python3", "-c", PYMODBUS_SERVER, port])
        self.start(port, max_outstanding=4)
        self.expect_values([10, 11])

    def start_fake(self, **line):
        self.server = FakeServer(self)
        routes = [route(f"pump.{i}", "holding", 10 * i, f"D{100 + 10 * i}", 2, period_ms=20) for i in range(8)]
        self.server.start()
        self.start(self.server.port, routes=routes, merge="off", **line)  # many requests are what this is about

    def expect_fake_values(self):
        for i in range(8):
            self.watch.expect(f"pump.{i}", quality="good", values=[10 * i, 10 * i + 1])
            self.assertEqual(self.client.holding(100 + 10 * i, 2), [10 * i, 10 * i + 1])

    def test_requests_under_way_at_a_time(self):
        self.start_fake(max_outstanding=4)
        self.server.together = 4
        self.expect_fake_values()
        wait_for(lambda: f"4 requests at a time, not {self.server.most}", lambda: self.server.most == 4)
        time.sleep(0.5)
        self.assertEqual((self.server.most, self.server.connections), (4, 1))

    def test_one_request_at_a_time(self):
        self.start_fake()
        self.expect_fake_values()
        self.assertEqual((self.server.most, self.server.connections), (1, 1))

    def test_strangers_are_dropped(self):
        self.start_fake(max_outstanding=2)
        self.expect_fake_values()

        def with_number(answer):  # the values are wrong as well
            return struct.pack(">H", struct.unpack(">H", answer[:2])[0] + 1000 & 0xFFFF) + answer[2:-1] + b"\xee"

        for name, strange in (("transaction", with_number),
                              ("unit", lambda answer: answer[:6] + b"\x09" + answer[7:-1] + b"\xee")):
            with self.subTest(name):
                self.server.strange = strange
                time.sleep(0.5)
                self.expect_fake_values()
                holds("good values", lambda: all(self.watch.latest(f"pump.{i}")["quality"] == "good"
                                                 for i in range(8)), seconds=0.5)
        self.assertEqual(self.server.connections, 1)
        self.assertNotIn(0xEE, [value & 0xFF for i in range(8) for value in self.client.holding(100 + 10 * i, 2)])

    def test_what_is_no_modbus_tcp_ends_the_connection(self):
        self.start_fake()
        self.expect_fake_values()
        self.server.strange = lambda answer: b"HTTP/1.1 400 Bad Request\r\n\r\n"
        wait_for("a new connection", lambda: self.server.connections > 1)
        self.server.strange = lambda answer: b""
        self.expect_fake_values()

    def test_forwarding_through_a_tcp_line(self):
        device = self.start_side_door()
        configuration = self.configuration(lines=[
            {"name": "line", "protocol": "modbus-tcp", "host": "127.0.0.1", "port": device.tcp_port}])
        configuration["modbus_tcp"][0]["units"].append({"unit": 11, "line": "line", "line_unit": 1})
        client = self.start_gateway(configuration).client(11)
        wait_for("a connection", lambda: "connected to" in self.programs[-1].log)
        self.assertEqual(client.holding(10, 2), [1234, 5])
        client.write_register(10, 9)
        self.assertEqual(device.door.holding(10), [9])

    def test_forwarded_request_when_the_connection_is_lost(self):
        self.start_fake()
        configuration = self.configuration(lines=[
            {"name": "line", "protocol": "modbus-tcp", "host": "127.0.0.1", "port": self.server.port}])
        self.gateway.stop()
        configuration["modbus_tcp"][0]["units"].append({"unit": 11, "line": "line"})
        client = self.start_gateway(configuration).client(11)
        wait_for("a connection", lambda: "connected to" in self.programs[-1].log)
        self.assertEqual(client.holding(10, 2), [10, 11])
        self.server.strange = lambda answer: b"no MODBUS TCP at all"
        with self.assertRaises(Refused) as raised:
            client.holding(10, 2)
        self.assertEqual(raised.exception.code, 0x0A)


main()
