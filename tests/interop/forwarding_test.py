"""MODBUS TCP clients reach the devices of a line through the gateway, while it polls them."""

import socket
import struct
import threading
import time

from faulty_device import framed
from support import PATIENCE, InteropTest, Refused, main, route, serial_line, station, wait_for


def read_holding(unit, first):
    return unit, struct.pack(">BHH", 3, first, 1)


def write_register(unit, at, value):
    return unit, struct.pack(">BHH", 6, at, value)


def rtu(unit, pdu):
    return framed(bytes([unit]) + pdu)


class Pipeline:
    """A plain connection: requests go out together, numbered from 0, and answers come as they come."""

    def __init__(self, test, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=PATIENCE)
        self.asked = 0
        test.addCleanup(self.socket.close)

    def ask(self, *requests):
        frames = []
        for unit, pdu in requests:
            frames.append(struct.pack(">HHHB", self.asked, 0, len(pdu) + 1, unit) + pdu)
            self.asked += 1
        self.socket.sendall(b"".join(frames))

    def receive(self, size):
        data = b""
        while len(data) < size:
            piece = self.socket.recv(size - len(data))
            if not piece:
                raise AssertionError(f"closed after {data.hex(' ')}")
            data += piece
        return data

    def answers(self, count):
        """Transaction id and PDU of each."""
        found = []
        for _ in range(count):
            transaction, _, length, _ = struct.unpack(">HHHB", self.receive(7))
            found.append((transaction, self.receive(length - 1)))
        return found


class ForwardingTest(InteropTest):
    # A period is long enough for one time-out in between: no route becomes stale.
    def start(self, **listener):
        """Devices 1 and 2 on the line; units 11, 12 and 13 lead to units 1, 2 and 9 of it, 14 to a line without port,
        17 and 18 to units 8 and 7, which are not there either."""
        self.bus = self.start_bus(3)
        self.devices = [self.start_device(i, i, "--set", f"hr:0={100 * i}", "--set", f"hr:50={i}") for i in (1, 2)]
        configuration = self.configuration(
            lines=[serial_line(self.folder / "line", response_timeout_ms=300, retries=0),
                   {**serial_line(self.folder / "absent"), "name": "gone"}],
            stations=[station("one", 1), station("two", 2)],
            routes=[route("one.low", "holding", 0, "D100", 2, period_ms=200),
                    route("two.low", "holding", 0, "D110", 2, period_ms=200)])
        configuration["modbus_tcp"][0]["units"] += [
            {"unit": 11, "line": "line", "line_unit": 1}, {"unit": 12, "line": "line", "line_unit": 2},
            {"unit": 13, "line": "line", "line_unit": 9}, {"unit": 14, "line": "gone", "line_unit": 1},
            {"unit": 17, "line": "line", "line_unit": 8}, {"unit": 18, "line": "line", "line_unit": 7}]
        configuration["modbus_tcp"][0].update(listener)
        self.gateway = self.start_gateway(configuration)
        self.watch = self.gateway.watch()
        self.watch.expect("one.low", quality="good", values=[100, 0])
        self.watch.expect("two.low", quality="good", values=[200, 0])

    def refused(self, code, call, *arguments):
        with self.assertRaises(Refused) as raised:
            call(*arguments)
        self.assertEqual(raised.exception.code, code)

    def expect_good_all_along(self):
        for name in ("one.low", "two.low"):
            self.assertEqual({each["quality"] for each in self.watch.of(name)[1:]} - {"good"}, set(), name)

    def test_values_are_those_of_the_side_door(self):
        self.start()
        for device, unit in zip(self.devices, (11, 12)):
            client = self.gateway.client(unit)
            device.door.write_registers(20, [unit, 2, 3])
            device.door.write_coils(5, [1, 0, 1])
            self.assertEqual(client.holding(20, 3), [unit, 2, 3])
            self.assertEqual(client.coils(5, 3), [1, 0, 1])
            self.assertEqual(client.discrete(0, 16), device.door.discrete(0, 16))
            self.assertEqual(client.input(0, 10), device.door.input(0, 10))
            self.assertEqual(client.holding(0, 125), device.door.holding(0, 125))
            client.write_register(30, 0xABCD)
            client.write_registers(31, [1, 2])
            client.write_coil(40, 1)
            client.write_coils(41, [1, 0, 1])
            self.assertEqual(device.door.holding(30, 3), [0xABCD, 1, 2])
            self.assertEqual(device.door.coils(40, 4), [1, 1, 0, 1])
            answer = client.do(client.modbus.readwrite_registers(read_address=30, read_count=2, write_address=31,
                                                                 write_registers=[9], unit=unit))
            self.assertEqual(answer.registers, [0xABCD, 9])
            self.refused(2, client.holding, 60000)
        self.assertEqual(self.gateway.client(1).holding(100, 2), [100, 0])
        self.expect_good_all_along()

    def test_what_cannot_be_reached(self):
        self.start()
        self.refused(0x0B, self.gateway.client(13).holding, 0)
        self.refused(0x0A, self.gateway.client(14).holding, 0)
        self.refused(0x0A, self.gateway.client(15).holding, 0)  # leads nowhere
        self.assertEqual(self.gateway.client(11).holding(50), [1])
        self.expect_good_all_along()

    def test_nobody_answers_a_broadcast(self):
        self.start(other_units="line")
        pipeline = Pipeline(self, self.gateway.port)
        pipeline.ask(write_register(0, 60, 0xBEEF))
        wait_for("both devices have it", lambda: [d.door.holding(60) for d in self.devices] == [[0xBEEF]] * 2)
        pipeline.ask(read_holding(11, 60))
        self.assertEqual(pipeline.answers(1), [(1, bytes.fromhex("0302BEEF"))])

    def test_late_answer_is_not_taken_for_the_next_one_by_a_client_of_rtu_over_tcp(self):
        self.start(framing="rtu")
        with socket.create_connection(("127.0.0.1", self.gateway.port), timeout=PATIENCE) as client:
            client.sendall(rtu(*read_holding(13, 0)))  # nobody
            time.sleep(0.1)
            client.sendall(rtu(*read_holding(11, 50)))
            self.assertEqual(client.recv(64), rtu(11, bytes.fromhex("03020001")))

    def test_other_units(self):
        self.start(other_units="line")
        self.assertEqual(self.gateway.client(2).holding(50), [2])
        self.refused(0x0B, self.gateway.client(77).holding, 0)
        self.assertEqual(self.gateway.client(1).holding(100), [100])  # the PLC

    def test_several_clients_at_once(self):
        self.start()
        wrong, answers = [], []

        def ask(unit, at):
            client = self.gateway.client(unit)
            until = time.monotonic() + 3
            while time.monotonic() < until:
                for number in range(5):
                    client.write_register(at, number)
                    found = client.holding(at)
                    answers.append(unit)
                    if found != [number]:
                        wrong.append((unit, at, number, found))

        def guarded(*arguments):
            try:
                ask(*arguments)
            except Exception as error:  # pylint: disable=broad-except
                wrong.append(error)

        clients = [threading.Thread(target=guarded, args=(11 + i % 2, 60 + i)) for i in range(6)]
        for each in clients:
            each.start()
        for each in clients:
            each.join()
        print(f"{len(answers)} answers")
        self.assertEqual(wrong, [])
        self.assertEqual(set(answers), {11, 12})
        self.devices[0].door.write_register(0, 4711)
        self.watch.expect("one.low", quality="good", values=[4711, 0])
        self.expect_good_all_along()

    def test_device_that_died(self):
        self.start()
        client = self.gateway.client(11)
        self.assertEqual(client.holding(50), [1])
        self.devices[0].kill()
        self.refused(0x0B, client.holding, 50)
        self.watch.expect("one.low", quality="comm error")
        begun = time.monotonic()
        self.refused(0x0B, client.holding, 50)
        self.assertLess(time.monotonic() - begun, 2)
        self.assertEqual(self.gateway.client(12).holding(50), [2])
        self.assertEqual(self.watch.latest("two.low")["quality"], "good")

    def test_line_that_is_lost(self):
        self.start()
        client = self.gateway.client(11)
        self.assertEqual(client.holding(50), [1])
        self.bus.kill()
        self.watch.expect("one.low", quality="comm error")
        self.refused(0x0A, client.holding, 50)
        self.assertEqual(self.gateway.client(1).holding(100), [100])  # the PLC keeps its value

    def test_requests_to_other_places_do_not_wait(self):
        self.start()
        pipeline = Pipeline(self, self.gateway.port)
        # A unit that nobody has, a station, the PLC, a line without port, nowhere.
        pipeline.ask(read_holding(13, 0), read_holding(11, 50), read_holding(1, 100), read_holding(14, 0),
                     read_holding(15, 0))
        answers = pipeline.answers(5)
        self.assertEqual(dict(answers), {0: b"\x83\x0b", 1: b"\x03\x02\x00\x01", 2: b"\x03\x02\x00\x64",
                                         3: b"\x83\x0a", 4: b"\x83\x0a"})
        self.assertEqual({number for number, _ in answers[:3]}, {2, 3, 4})

    def test_requests_to_one_station_keep_their_order(self):
        self.start()
        pipeline = Pipeline(self, self.gateway.port)
        for turn in range(5):
            # Both stations get writes and reads in turn: each read finds what was written before it.
            pipeline.ask(*[request for value in range(4) for unit in (11, 12)
                           for request in (write_register(unit, 70, 100 * turn + value), read_holding(unit, 70))])
            answers = dict(pipeline.answers(16))
            first = 16 * turn
            for value in range(4):
                written = 100 * turn + value
                for station in (0, 2):
                    number = first + 4 * value + station
                    self.assertEqual(answers[number], write_register(0, 70, written)[1])
                    self.assertEqual(answers[number + 1], struct.pack(">BBH", 3, 2, written))
        self.expect_good_all_along()

    def test_max_outstanding(self):
        self.start(max_outstanding=2)
        pipeline = Pipeline(self, self.gateway.port)
        dead = [read_holding(unit, 0) for unit in (13, 13, 17, 18)]
        pipeline.ask(*dead[:3], read_holding(1, 100), dead[3], read_holding(1, 100))
        # The PLC's answers wait behind the request that is not under way yet.
        self.assertEqual([number for number, _ in pipeline.answers(6)], [0, 2, 3, 1, 5, 4])

    def test_a_unit_that_is_silent_costs_the_line_no_more(self):
        self.start()
        nobody = self.gateway.client(13)
        for _ in range(2):
            self.refused(0x0B, nobody.holding, 0)
        began = time.monotonic()
        for _ in range(20):
            self.refused(0x0B, nobody.holding, 0)
        self.assertLess(time.monotonic() - began, 2)  # 20 time-outs are 6 s; one may have gone out as a probe
        self.assertIn("unit 9 does not answer", self.gateway.log)

    def test_clients_that_read_the_same_at_the_same_time_are_answered_by_one_read(self):
        self.start()
        Pipeline(self, self.gateway.port).ask(read_holding(13, 0))  # the line is busy meanwhile
        readers = [Pipeline(self, self.gateway.port) for _ in range(10)]
        for each in readers:
            each.ask(read_holding(11, 50), read_holding(12, 50))
        for each in readers:
            self.assertEqual(sorted(each.answers(2)), [(0, b"\x03\x02\x00\x01"), (1, b"\x03\x02\x00\x02")])

    def leave_with_five_requests(self, most):
        self.start(max_outstanding=most)
        pipelines = [Pipeline(self, self.gateway.port) for _ in range(2)]
        for each in pipelines:
            each.ask(read_holding(13, 0))  # the line is busy for two time-outs
        left = Pipeline(self, self.gateway.port)
        left.ask(*[write_register(12, 70 + i, 1) for i in range(5)])
        left.socket.close()
        for each in pipelines:
            self.assertEqual(each.answers(1), [(0, b"\x83\x0b")])
        self.assertEqual(self.gateway.client(12).holding(70, 5), [0] * 5)

    def test_a_client_that_left_does_not_use_the_line(self):
        self.leave_with_five_requests(16)

    def test_a_client_that_left_while_it_was_not_read_from_does_not_use_the_line(self):
        self.leave_with_five_requests(2)

    def test_a_client_that_half_closes_gets_what_the_plc_answered(self):
        self.start()
        pipeline = Pipeline(self, self.gateway.port)
        pipeline.ask(*[read_holding(1, 100)] * 200)
        pipeline.socket.shutdown(socket.SHUT_WR)
        self.assertEqual(pipeline.answers(200), [(i, b"\x03\x02\x00\x64") for i in range(200)])
        self.assertEqual(pipeline.socket.recv(1), b"")

    def test_client_that_leaves_before_its_answer(self):
        self.start()
        for _ in range(20):
            with socket.create_connection(("127.0.0.1", self.gateway.port)) as client:
                client.sendall(bytes.fromhex("0001 0000 0006 0D 03 0000 0001") * 5)
        begun = time.monotonic()
        self.assertEqual(self.gateway.client(11).holding(50), [1])
        print(f"served after {time.monotonic() - begun:.1f} s")


main()
