"""Every peer of docs/peers.md, in both roles and in every framing that it has.

usage: peers_test.py CLASS, one of those below. What was tried must be what the table says.
"""

import peer_clients
import peer_servers
from peer_scenarios import MASKED, NOWHERE, PeerTest
from peer_table import debian_version, npm_version
from support import main


class Pymodbus(PeerTest):
    peer = "pymodbus"
    answers = {"mask": None, "read_write": [MASKED, 5, 6], "exception_status": [0], "diagnostics": [0xA55A],
               "event_counter": [True, 0], "event_log": [0, 0], "server_id": [*b"Debian-pymodbus-3.0", 0xFF],
               "identification": ["Debian", "pymodbus", "3.0"]}

    def version(self):
        return debian_version("python3-pymodbus")

    def test_client_tcp(self):
        self.client_row("tcp", peer_clients.Pymodbus)

    def test_client_rtu(self):
        self.client_row("rtu", peer_clients.Pymodbus)

    def test_client_ascii(self):
        self.client_row("ascii", peer_clients.Pymodbus)

    def test_client_rtu_over_tcp(self):
        self.client_row("rtu-over-tcp", peer_clients.Pymodbus)

    def test_client_ascii_over_tcp(self):
        self.client_row("ascii-over-tcp", peer_clients.Pymodbus)

    def test_server_tcp(self):
        self.server_row("tcp", peer_servers.pymodbus, self.answers)

    def test_server_rtu(self):
        self.server_row("rtu", peer_servers.pymodbus, {**self.answers, "broadcast_register": None})

    def test_server_ascii(self):
        self.server_row("ascii", peer_servers.pymodbus, {**self.answers, "broadcast_register": None})

    def test_server_rtu_over_tcp(self):
        self.server_row("rtu-over-tcp", peer_servers.pymodbus, {**self.answers, "broadcast_register": None})

    def test_server_ascii_over_tcp(self):
        self.server_row("ascii-over-tcp", peer_servers.pymodbus, {**self.answers, "broadcast_register": None})


class Libmodbus(PeerTest):
    peer = "libmodbus"
    answers = {"mask": None, "read_write": [MASKED, 5, 6], "server_id": [180, 0xFF, *b"LMB3.1.6"]}
    refuses = {"event_counter": 1, "event_log": 1}

    def version(self):
        return debian_version("libmodbus5")

    def test_client_tcp(self):
        self.client_row("tcp", peer_clients.Libmodbus)

    def test_client_rtu(self):
        self.client_row("rtu", peer_clients.Libmodbus)

    def test_server_tcp(self):
        self.server_row("tcp", peer_servers.Libmodbus, self.answers, self.refuses)

    def test_server_rtu(self):
        self.server_row("rtu", peer_servers.Libmodbus, {**self.answers, "broadcast_register": None},
                        self.refuses)


class Mbpoll(PeerTest):
    peer = "mbpoll"

    def version(self):
        return debian_version("mbpoll")

    def test_client_tcp(self):
        self.client_row("tcp", peer_clients.Mbpoll)

    def test_client_rtu(self):
        self.client_row("rtu", peer_clients.Mbpoll)


class Jsmodbus(PeerTest):
    peer = "jsmodbus"

    def version(self):
        return npm_version(self.peer)

    def client(self, framing):
        self.client_row(framing, lambda test, *rest: peer_clients.Node(test, "jsmodbus", *rest))

    def server(self, framing):
        self.server_row(framing, peer_servers.node("jsmodbus"), beyond=("write_register", NOWHERE, 1))

    def test_client_tcp(self):
        self.client("tcp")

    def test_client_rtu(self):
        self.single_coil = (0,)  # for 1 it computes another CRC than that of the answer
        self.client("rtu")

    def test_client_rtu_over_tcp(self):
        self.single_coil = (0,)  # as on serial lines
        self.client("rtu-over-tcp")

    def test_server_tcp(self):
        self.server("tcp")

    def test_server_rtu(self):
        self.server("rtu")

    def test_server_rtu_over_tcp(self):
        self.server("rtu-over-tcp")


# What modbus-serial has, but not on all of its ports.
BESIDES_THE_EIGHT = ("mask", "read_write", "server_id", "identification")


class ModbusSerial(PeerTest):
    peer = "modbus-serial"

    def version(self):
        return npm_version(self.peer)

    def client(self, framing, without=()):
        self.client_row(framing, lambda test, *rest: peer_clients.Node(test, "modbus-serial", *rest, without))

    def server(self, framing):
        self.server_row(framing, peer_servers.node("modbus-serial"),
                        {"identification": ["npm", "modbus-serial", "8"]}, {"mask": 1, "read_write": 1})

    def test_client_tcp(self):
        self.client("tcp")

    def test_client_rtu(self):
        self.client("rtu", without=["mask", "read_write"])  # it takes no answer to them for one

    def test_client_ascii(self):
        self.client("ascii", without=BESIDES_THE_EIGHT)

    def test_client_rtu_over_tcp(self):
        self.client("rtu-over-tcp", without=BESIDES_THE_EIGHT)  # its "Telnet" port

    def test_server_tcp(self):
        self.server("tcp")

    def test_server_rtu(self):
        self.server("rtu")


main()
