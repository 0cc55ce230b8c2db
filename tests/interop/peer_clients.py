"""Other people's MODBUS clients, each with the calls that it has, under common names.

A call returns numbers or texts, raises Refused for an exception response, and AssertionError for everything else. What
is no method here, the peer does not have.
"""

import ctypes
import errno
import json
import os
import re
import select
import subprocess
from pathlib import Path

from pymodbus.client import ModbusSerialClient, ModbusTcpClient
from pymodbus.framer.ascii_framer import ModbusAsciiFramer
from pymodbus.framer.rtu_framer import ModbusRtuFramer
from pymodbus.framer.socket_framer import ModbusSocketFramer
from pymodbus.mei_message import ReadDeviceInformationRequest
from pymodbus.other_message import (GetCommEventCounterRequest, GetCommEventLogRequest, ReadExceptionStatusRequest,
                                    ReportSlaveIdRequest)

from support import LIBC, PATIENCE, PR_SET_PDEATHSIG, Client, Refused, mbpoll_values, wait_for

BAUD_RATE = 19200
HERE = Path(__file__).resolve().parent


class Pymodbus(Client):
    """pymodbus: every framing, every function."""

    framers = {"tcp": ModbusSocketFramer, "rtu": ModbusRtuFramer, "ascii": ModbusAsciiFramer,
               "rtu-over-tcp": ModbusRtuFramer, "ascii-over-tcp": ModbusAsciiFramer}

    def __init__(self, test, framing, unit, where):  # pylint: disable=super-init-not-called
        self.unit = unit
        options = {"framer": self.framers[framing], "timeout": PATIENCE, "retries": 0, "broadcast_enable": True}
        if "tcp" in framing:
            self.modbus = ModbusTcpClient("127.0.0.1", where, **options)
        else:
            self.modbus = ModbusSerialClient(str(where), baudrate=BAUD_RATE, parity="N", **options)
        wait_for(f"{where} opens", self.modbus.connect)
        test.addCleanup(self.modbus.close)

    def execute(self, request):
        request.unit_id = self.unit
        return self.do(self.modbus.execute(request))

    def mask(self, at, and_mask, or_mask):
        self.do(self.modbus.mask_write_register(address=at, and_mask=and_mask, or_mask=or_mask, unit=self.unit))

    def read_write(self, first, count, at, values):
        return self.do(self.modbus.readwrite_registers(read_address=first, read_count=count, write_address=at,
                                                       write_registers=values, unit=self.unit)).registers

    def exception_status(self):
        return [self.execute(ReadExceptionStatusRequest()).status]

    def diagnostics(self, word):
        """Sub-function 00: the word comes back."""
        message = self.do(self.modbus.diag_query_data(word, self.unit)).message
        return list(message) if isinstance(message, (list, tuple)) else [message]

    def event_counter(self):
        answer = self.execute(GetCommEventCounterRequest())
        return [answer.status, answer.count]

    def event_log(self):
        answer = self.execute(GetCommEventLogRequest())
        return [answer.event_count, answer.message_count, *answer.events]

    def server_id(self):
        return list(self.execute(ReportSlaveIdRequest()).identifier)  # it counts the run indicator as part of it

    def identification(self):
        answer = self.execute(ReadDeviceInformationRequest(read_code=1, object_id=0))
        return [answer.information[i].decode() for i in range(3)]

    def broadcast_register(self, at, value):
        self.modbus.write_register(at, value, 0)


class Libmodbus:
    """libmodbus, by its C functions."""

    first_exception = 112345678  # MODBUS_ENOBASE, of modbus.h

    def __init__(self, test, framing, unit, where):
        self.library = ctypes.CDLL("libmodbus.so.5", use_errno=True)
        self.library.modbus_new_tcp.restype = self.library.modbus_new_rtu.restype = ctypes.c_void_p
        if framing == "tcp":
            context = self.library.modbus_new_tcp(b"127.0.0.1", where)
        else:
            context = self.library.modbus_new_rtu(str(where).encode(), BAUD_RATE, ctypes.c_char(b"N"), 8, 1)
        self.context = ctypes.c_void_p(context)
        self.unit = unit
        self.call("set_slave", unit)
        self.call("set_response_timeout", PATIENCE, 0)
        self.call("connect")
        test.addCleanup(self.library.modbus_free, self.context)
        test.addCleanup(self.library.modbus_close, self.context)

    def call(self, function, *arguments):
        done = getattr(self.library, f"modbus_{function}")(self.context, *arguments)
        if done >= 0:
            return done
        number = ctypes.get_errno()
        if self.first_exception < number < self.first_exception + 12:
            raise Refused(number - self.first_exception)
        raise AssertionError(f"libmodbus {function}: {errno.errorcode.get(number, number)}")

    def read(self, function, kind, first, count):
        values = (kind * count)()
        if self.call(function, first, count, values) != count:
            raise AssertionError(f"libmodbus {function} read something else than {count} values")
        return list(values)

    def coils(self, first, count):
        return self.read("read_bits", ctypes.c_uint8, first, count)

    def discrete(self, first, count):
        return self.read("read_input_bits", ctypes.c_uint8, first, count)

    def holding(self, first, count):
        return self.read("read_registers", ctypes.c_uint16, first, count)

    def input(self, first, count):
        return self.read("read_input_registers", ctypes.c_uint16, first, count)

    def write_coil(self, at, value):
        self.call("write_bit", at, value)

    def write_register(self, at, value):
        self.call("write_register", at, value)

    def write_coils(self, first, values):
        self.call("write_bits", first, len(values), (ctypes.c_uint8 * len(values))(*values))

    def write_registers(self, first, values):
        self.call("write_registers", first, len(values), (ctypes.c_uint16 * len(values))(*values))

    def mask(self, at, and_mask, or_mask):
        self.call("mask_write_register", at, ctypes.c_uint16(and_mask), ctypes.c_uint16(or_mask))

    def read_write(self, first, count, at, values):
        answer = (ctypes.c_uint16 * count)()
        self.call("write_and_read_registers", at, len(values), (ctypes.c_uint16 * len(values))(*values), first, count,
                  answer)
        return list(answer)

    def server_id(self):
        answer = (ctypes.c_uint8 * 250)()
        size = self.call("report_slave_id", 250, answer)
        return list(answer)[:size]

    def broadcast_register(self, at, value):
        """It waits for an answer even to a broadcast."""
        self.call("set_slave", 0)
        self.call("set_response_timeout", 0, 300_000)
        try:
            self.call("write_register", at, value)
            raise AssertionError("a broadcast was answered")
        except AssertionError as error:
            if "ETIMEDOUT" not in str(error):
                raise
        finally:
            self.call("set_slave", self.unit)
            self.call("set_response_timeout", PATIENCE, 0)


class Mbpoll:
    """mbpoll, a run for each call."""

    def __init__(self, _test, framing, unit, where):
        mode = ["-m", "tcp", "-p", where] if framing == "tcp" else ["-m", "rtu", "-b", BAUD_RATE, "-P", "none"]
        self.command = ["mbpoll", *mode, "-a", unit, "-1", "-o", 10]
        self.where = "127.0.0.1" if framing == "tcp" else where
        if framing == "rtu":
            self.server_id = self.report  # over TCP it refuses to ask

    def values(self, table, first, count=None, write=()):
        try:
            return mbpoll_values([*self.command, "-0", "-t", table, "-r", first, *(["-c", count] if count else []),
                                  self.where, *write])
        except AssertionError as error:
            if "Illegal data address" in str(error):
                raise Refused(2) from error
            raise

    def coils(self, first, count):
        return self.values(0, first, count)

    def discrete(self, first, count):
        return self.values(1, first, count)

    def input(self, first, count):
        return self.values(3, first, count)

    def holding(self, first, count):
        return self.values(4, first, count)

    def report(self):
        done = subprocess.run([str(word) for word in (*self.command, "-u", self.where)], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=PATIENCE, check=False).stdout
        found = re.search(r"Id *: (0x\w+)\s+Status: (\w+)", done)
        if not found:
            raise AssertionError(f"mbpoll: {done}")
        return [int(found[1], 16), 0xFF if found[2] == "On" else 0x00]

    def write_coil(self, at, value):
        self.values(0, at, write=[value])

    def write_coils(self, first, values):
        self.values(0, first, write=values)

    def write_register(self, at, value):
        self.values(4, at, write=[value])

    def write_registers(self, first, values):
        self.values(4, first, write=values)


class Node:
    """A package of npm, in npm/client.js."""

    def __init__(self, test, package, framing, unit, where, without=()):
        environment = {**os.environ, "NODE_PATH": str(Path(os.environ["NPM_PEERS"]) / "node_modules")}
        command = ["node", HERE / "npm" / "client.js", package, framing, unit, where]
        # pylint: disable-next=consider-using-with
        self.process = subprocess.Popen([str(word) for word in command], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        text=True, env=environment,
                                        preexec_fn=lambda: LIBC.prctl(PR_SET_PDEATHSIG, 9))
        test.addCleanup(self.close)
        self.name = package
        for call in self.line("the connection")["ready"]:
            if call not in without:
                setattr(self, call, lambda *arguments, call=call: self.ask(call, arguments))

    def close(self):
        self.process.kill()  # it would wait for an answer that does not come
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()

    def line(self, asked):
        # It says by itself that an answer does not come, within PATIENCE.
        if not select.select([self.process.stdout], [], [], 2 * PATIENCE)[0]:
            raise AssertionError(f"{self.name} has no answer to {asked}, and knows no deadline")
        line = self.process.stdout.readline()
        if not line:
            raise AssertionError(f"{self.name} ended with status {self.process.wait(PATIENCE)}")
        return json.loads(line)

    def ask(self, call, arguments):
        self.process.stdin.write(json.dumps({"call": call, "with": arguments}) + "\n")
        self.process.stdin.flush()
        answer = self.line(f"{call}{arguments}")
        if "exception" in answer:
            raise Refused(answer["exception"])
        if "failed" in answer:
            raise AssertionError(f"{self.name} {call}{arguments}: {answer['failed']}")
        return answer["values"]


