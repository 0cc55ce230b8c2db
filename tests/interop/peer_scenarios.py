"""What is tried with every peer of docs/peers.md: its functions, an exception, a broadcast; values at both ends."""

import re

import peer_clients
import peer_servers
from peer_table import FRAMINGS, rows
from support import InteropTest, Refused, route, station, wait_for

# What each call of peer_clients asks.
FUNCTIONS = {"coils": "01", "discrete": "02", "holding": "03", "input": "04", "write_coil": "05",
             "write_register": "06", "exception_status": "07", "diagnostics": "08", "event_counter": "0B",
             "event_log": "0C", "write_coils": "0F", "write_registers": "10", "server_id": "11", "mask": "16",
             "read_write": "17", "identification": "2B/0E", "broadcast_register": "broadcast 06"}
OF_SERIAL_LINES = ("exception_status", "diagnostics", "event_counter", "event_log", "server_id")
M8061 = 0x1E00 + 61  # bit 1 of the exception status
BITS = [1, 0, 1, 1, 0, 0, 0, 0, 1, 1]
WORDS = [0x1234, 0, 0xFFFF]
NOWHERE = 0xFFFF     # an address that neither the gateway nor a peer has
# pymodbus's server takes no 7E1 on a pty, which keeps 8N whatever is asked for: the peers use 8N1 for ASCII as well.
SERIAL = {"rtu": {"parity": "none"}, "ascii": {"data_bits": 7, "parity": "even"}}

READ_ROUTES = [route("peer.holding", "holding", 10, "D100", 3, period_ms=50),
               route("peer.input", "input", 20, "D110", 3, period_ms=50),
               route("peer.coils", "coil", 0, "M0", 10, period_ms=50),
               route("peer.discrete", "discrete", 1, "M20", 10, period_ms=50),
               route("peer.words back", "holding", 49, "D300", 14, period_ms=50),
               route("peer.bits back", "coil", 49, "M200", 21, period_ms=50)]
WRITE_ROUTES = [route("peer.one word", "holding", 50, "D200", direction="write"),
                route("peer.words", "holding", 60, "D210", 3, direction="write"),
                route("peer.one bit", "coil", 50, "M100", direction="write"),
                route("peer.bits", "coil", 60, "M110", 10, direction="write")]
BROADCAST_ROUTE = route("all.word", "holding", 90, "D230", direction="write")
# call at the door, address there, value, address in the peer, function that carries it
WRITES = [("write_register", 200, 4242, 50, "06"), ("write_registers", 210, WORDS, 60, "10"),
          ("write_coil", 100, 1, 50, "05"), ("write_coils", 110, BITS, 60, "0F")]
MASKED = 0x0458  # 1080, what the peers hold at 80, after the mask
FORWARDED_WITH = {"mask": (80, 0xFF0F, 0x0050), "read_write": (80, 3, 81, [5, 6]), "diagnostics": (0xA55A,)}


class PeerTest(InteropTest):
    """The scenarios. A subclass names the peer and has a test for each row."""

    peer = ""
    single_coil = (1, 0)  # what its client can write with 05

    def setUp(self):
        self.tried = set()
        self.refusals = {}

    def answered(self, client, call, *arguments):
        answer = getattr(client, call)(*arguments)
        self.tried.add(FUNCTIONS[call])
        return answer

    def refused(self, client, code, call, *arguments):
        with self.assertRaises(Refused, msg=call) as raised:
            getattr(client, call)(*arguments)
        self.assertEqual(raised.exception.code, code, call)
        self.refusals.setdefault(code, set()).add(FUNCTIONS[call])

    def expect_row(self, role, framing):
        """Compares what was tried with the table."""
        functions = " ".join(sorted(self.tried, key=lambda each: (each.startswith("b"), each)))
        exceptions = ", ".join(f"{code:02X} for {' '.join(sorted(self.refusals[code]))}"
                               for code in sorted(self.refusals))
        row = (f"{self.peer} {self.version()}", role, FRAMINGS[framing], functions, exceptions, self.ctest_name())
        self.assertIn(row, [each for each in rows() if each[0].split()[0] == self.peer and each[1:3] == row[1:3]],
                      "a row that docs/peers.md does not have")

    def ctest_name(self):
        return f"interop.peers_{self.peer.replace('-', '_')}"

    def test_every_row_of_the_table_is_a_test(self):
        tests = [tuple(name.split("_", 2)[1:]) for name in dir(self) if re.match("test_(client|server)_", name)]
        mine = [row[1:3] for row in rows() if row[5] == self.ctest_name()]
        self.assertEqual(sorted(mine), sorted((role, FRAMINGS[framing.replace("_", "-")]) for role, framing in tests))

    # The gateway is the server.

    def client_row(self, framing, make, identifies="tcp", unit=5):
        """The peer's client and the gateway's server; `make` opens the client."""
        line = {"name": "bus", "device": str(self.folder / "line"), "role": "server",
                "protocol": "modbus-ascii" if framing == "ascii" else "modbus-rtu",
                "units": [{"unit": unit, "plc": "main", "channel": 1}], **SERIAL.get(framing, {})}
        configuration = self.configuration(lines=[] if "tcp" in framing else [line])
        where = self.folder / "line.1"
        if "tcp" in framing:
            where = self.free_port()
            configuration["modbus_tcp"].append({"port": where, "units": [{"unit": unit, "plc": "main"}]})
            if framing != "tcp":
                configuration["modbus_tcp"][1]["framing"] = framing.split("-")[0]
        else:
            self.start_bus(2)
        gateway = self.start_gateway(configuration)
        if "tcp" not in framing:
            wait_for("the line is open", lambda: re.search("line bus: .* is open", gateway.log))
        wait_for("all listeners", lambda: gateway.log.count("listens on") == len(configuration["modbus_tcp"]))
        client, door = make(self, framing, unit, where), gateway.client()
        self.memory(client, door)
        if hasattr(client, "broadcast_register") and "tcp" not in framing:
            self.answered(client, "broadcast_register", 90, 4711)
            wait_for("the broadcast", lambda: door.holding(90) == [4711])
        if "tcp" in framing:
            self.of_tcp(client)
        else:
            self.of_the_station(client, door)
        self.refused(client, 2, "holding", NOWHERE, 1)
        self.assertEqual(client.holding(90, 1), door.holding(90))  # and all goes on
        self.expect_row("client", framing)

    def memory(self, client, door):
        """The functions that read and write the PLC's memory, and what the door finds there."""
        for value in self.single_coil:
            door.write_coil(7, 1 - value)
            self.answered(client, "write_coil", 7, value)
            self.assertEqual(door.coils(7), [value])
        self.answered(client, "write_coils", 20, BITS)
        self.assertEqual(door.coils(20, 10), BITS)
        door.write_coils(40, BITS)
        self.assertEqual(self.answered(client, "coils", 40, 10), BITS)
        self.assertEqual(self.answered(client, "discrete", 40, 10), BITS)
        self.answered(client, "write_register", 10, 0xABCD)
        self.answered(client, "write_registers", 20, WORDS)
        self.assertEqual((door.holding(10), door.holding(20, 3)), ([0xABCD], WORDS))
        many = list(range(60000, 60123))
        door.write_registers(200, many)
        self.assertEqual(self.answered(client, "holding", 200, 123), many)
        self.assertEqual(self.answered(client, "input", 200, 123), many)
        if hasattr(client, "mask"):
            self.answered(client, "mask", 10, 0xF0FF, 0x0400)
            self.assertEqual(door.holding(10), [0xA4CD])
        if hasattr(client, "read_write"):
            self.assertEqual(self.answered(client, "read_write", 29, 4, 30, [5, 6]), [0, 5, 6, 0])
            self.assertEqual(door.holding(30, 2), [5, 6])

    def of_tcp(self, client):
        """The functions of serial lines do not exist over TCP, but device identification does."""
        for call in OF_SERIAL_LINES:
            if hasattr(client, call):
                self.refused(client, 1, call, *([0xA55A] if call == "diagnostics" else []))
        if hasattr(client, "identification"):
            self.assertEqual(self.answered(client, "identification")[:2], ["plc-gateway", "FX3U"])

    def of_the_station(self, client, door):
        if hasattr(client, "exception_status"):
            self.assertEqual(self.answered(client, "exception_status"), [0])
            door.write_coil(M8061, 1)
            self.assertEqual(self.answered(client, "exception_status"), [2])
            door.write_coil(M8061, 0)
        if hasattr(client, "diagnostics"):
            self.assertEqual(self.answered(client, "diagnostics", 0xA55A), [0xA55A])
        if hasattr(client, "event_counter"):
            before = self.answered(client, "event_counter")[-1]
            client.write_register(10, 1)
            self.assertEqual(self.answered(client, "event_counter")[-1], before + 1)
        if hasattr(client, "event_log"):
            count, _, *events = self.answered(client, "event_log")
            self.assertGreater(count, 0)
            self.assertEqual(events[:2], [0x80, 0x40])  # this request was received, the last answer was sent
        if hasattr(client, "server_id"):
            self.assertEqual(self.answered(client, "server_id")[:2], [0xF3, 0xFF])
        if hasattr(client, "identification"):
            self.refused(client, 1, "identification")

    # The gateway is the client.

    def server_row(self, framing, start, answers=None, refuses=None, beyond=("holding", NOWHERE, 1)):
        """The peer's server and the gateway's client: routes in both directions, and forwarded requests.

        answers: call -> what the peer answers; refuses: call -> the exception that it knows instead; beyond: what
        asks it for an address that it does not have.
        """
        line = {"name": "line", "protocol": f"modbus-{framing.split('-')[0]}", "response_timeout_ms": 5000}
        if "tcp" in framing:
            line.update(host="127.0.0.1", port=self.free_port())
            where = line["port"]
        else:
            self.start_bus(2)
            line.update(device=str(self.folder / "line"), **SERIAL[framing])
            where = self.folder / "line.1"
        peer = start(self, framing, where)
        broadcasts = "broadcast_register" in (answers or {})
        configuration = self.configuration(
            lines=[line], stations=[station("peer", 1), *([station("all", 0)] if broadcasts else [])],
            routes=[*READ_ROUTES, *WRITE_ROUTES, *([BROADCAST_ROUTE] if broadcasts else [])])
        configuration["modbus_tcp"][0]["units"].append({"unit": 11, "line": "line", "line_unit": 1})
        gateway = self.start_gateway(configuration)
        door, through = gateway.client(), peer_clients.Pymodbus(self, "tcp", 11, gateway.port)
        self.routes(peer, door)
        if broadcasts:
            door.write_register(230, 4711)
            wait_for("the broadcast", lambda: peer.wrote("holding", 90, [4711]))
            self.tried.add(FUNCTIONS["broadcast_register"])
        for call, wanted in (answers or {}).items():
            if call != "broadcast_register":
                self.forwarded(through, peer, call, wanted)
        for call, code in (refuses or {}).items():
            self.refused(through, code, call, *FORWARDED_WITH.get(call, ()))
        self.refused(through, 2, *beyond)
        self.assertEqual(through.input(5, 1), [65005])  # and all goes on
        self.expect_row("server", framing)

    def routes(self, peer, door):
        def arrives(call, first, values):
            wait_for(lambda: f"{call} {first}: {values}, not {getattr(door, call)(first, len(values))}",
                     lambda: getattr(door, call)(first, len(values)) == values)

        def begin(table, first, count):
            return [peer_servers.INITIAL[table](at) for at in range(first, first + count)]

        for table, first, where, function in (("holding", 10, 100, "03"), ("input", 20, 110, "04")):
            arrives("holding", where, begin(table, first, 3))
            self.tried.add(function)
        for table, first, where, function in (("coils", 0, 0, "01"), ("discrete", 1, 20, "02")):
            arrives("coils", where, begin(table, first, 10))
            self.tried.add(function)
        for call, at, value, where, function in WRITES:
            getattr(door, call)(at, value)
            table = "coils" if "coil" in call else "holding"
            values = value if isinstance(value, list) else [value]
            wait_for(lambda: f"function {function} writes {values}",  # pylint: disable=cell-var-from-loop
                     lambda: peer.wrote(table, where, values))  # pylint: disable=cell-var-from-loop
            self.tried.add(function)
        arrives("holding", 300, [*begin("holding", 49, 1), 4242, *begin("holding", 51, 9), *WORDS])
        arrives("coils", 200, [*begin("coils", 49, 1), 1, *begin("coils", 51, 9), *BITS])

    def forwarded(self, through, peer, call, wanted):
        answer = self.answered(through, call, *FORWARDED_WITH.get(call, ()))
        if wanted is not None:
            self.assertEqual(answer, wanted, call)
        if call == "mask":
            wait_for("the mask", lambda: peer.wrote("holding", 80, [MASKED]))
        if call == "read_write":
            wait_for("what was written", lambda: peer.wrote("holding", 81, [5, 6]))
