"""Other people's MODBUS servers: unit 1 with 100 items in each table, which hold INITIAL.

Each has `wrote(table, first, values)`: whether the peer's own memory was given these values.
"""

import os
from pathlib import Path

from support import Device, Program, wait_for

SIZE = 100
INITIAL = {"coils": lambda at: int(at % 3 == 0), "discrete": lambda at: int(at % 2 == 0),
           "holding": lambda at: 1000 + at, "input": lambda at: 65000 + at}
HERE = Path(__file__).resolve().parent


class Printing(Program):
    """A server that prints what is written."""

    def __init__(self, test, name, command, **environment):
        super().__init__(test, name, command, **environment)
        wait_for(f"{name} is ready", lambda: "ready" in self.log.splitlines() or not self.running())
        test.assertTrue(self.running(), f"{name} ended")

    def wrote(self, table, first, values):
        lines = self.log.splitlines()
        return all(f"wrote {table} {at} {value}" in lines for at, value in enumerate(values, first))


def pymodbus(test, framing, where):
    return Printing(test, "pymodbus-server", ["/usr/bin/python3", "-B", HERE / "pymodbus_server.py", framing, where])


def node(package):
    def start(test, framing, where):
        return Printing(test, f"{package}-server", ["node", HERE / "npm" / "server.js", package, framing, where],
                        NODE_PATH=f"{os.environ['NPM_PEERS']}/node_modules")
    return start


class Libmodbus(Device):
    """A simulated field device is libmodbus's server: on its line, and its side door over TCP."""

    def __init__(self, test, framing, where):
        tables = {"coils": "co", "discrete": "di", "holding": "hr", "input": "ir"}
        values = [f"{tables[table]}:{at}={INITIAL[table](at)}" for table in tables for at in range(SIZE)]
        options = [word for value in values for word in ("--set", value)]
        port = where
        if framing == "tcp":
            test.start_bus(2)
            port = test.folder / "line.1"
            test = Ports(test, where)
        super().__init__(test, port, 1, *options)

    def wrote(self, table, first, values):
        return getattr(self.door, table)(first, len(values)) == values


class Ports:
    """The test, but with a port of ours for the side door."""

    def __init__(self, test, port):
        self.test = test
        self.port = port

    def __getattr__(self, name):
        return (lambda: self.port) if name == "free_port" else getattr(self.test, name)
