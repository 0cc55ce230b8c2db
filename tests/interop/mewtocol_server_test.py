"""The gateway as MEWTOCOL server on a serial line: recorded and computed frames as raw bytes, values on MODBUS TCP."""

import os
import select
import socket
import time
import tty

from pymodbus.client import ModbusSerialClient

from mewtocol_vectors import ALL, COM, SEVEN
from support import PATIENCE, Client, InteropTest, Refused, main, wait_for

SILENT = 0.15  # seconds without an answer that are enough to say that there is none
RT = "%01#RT01"
RT_ANSWER = "%01$RT000000010000000007"
RELAYS = 0x800  # coil of R0
RESET = 0x10    # coil of Y10, and discrete input of X10: COM.1


def frame(text):
    return text.encode() + b"\r"


def checked(text):
    """With its BCC."""
    bcc = 0
    for character in text.encode():
        bcc ^= character
    return f"{text}{bcc:02X}"


class RawLine:
    """The client's end of a pty whose other end the gateway opens as folder/line."""

    def __init__(self, test, name="line"):
        self.ours, theirs = os.openpty()
        tty.setraw(theirs)
        os.symlink(os.ttyname(theirs), test.folder / name)
        for fd in (self.ours, theirs):
            test.addCleanup(os.close, fd)

    def send(self, data):
        os.write(self.ours, data)

    def hear(self, patience=PATIENCE):
        """Up to the next CR, without it; "" when nothing comes."""
        heard = b""
        while not heard.endswith(b"\r"):
            if not select.select([self.ours], [], [], patience)[0]:
                return heard.decode()
            heard += os.read(self.ours, 1)
        return heard[:-1].decode()

    def ask(self, text, patience=PATIENCE):
        self.send(frame(text))
        return self.hear(patience)

    def until(self, answer):
        """All that is heard in front of this answer."""
        before = []
        while not before or before[-1] != answer:
            before.append(self.hear())
            if not before[-1]:
                raise AssertionError(f"{answer} did not come, but {before}")
        return before[:-1]


class SerialClient(Client):
    """pymodbus on a serial port."""

    def __init__(self, test, port, unit):  # pylint: disable=super-init-not-called
        self.unit = unit
        self.modbus = ModbusSerialClient(str(port), baudrate=19200, parity="N", timeout=2, retries=0)
        wait_for(f"{port} opens", self.modbus.connect)
        test.addCleanup(self.modbus.close)


class MewtocolServerTest(InteropTest):
    def start_server(self, stations=(1,), protocol="mewtocol-com", **line):
        """Station 1 is "fp7", which is unit 1 of MODBUS TCP; a second one "other", unit 2."""
        names = ("fp7", "other")[:len(stations)]
        configuration = self.configuration(units=names, lines=[
            {"name": "bus", "protocol": protocol, "role": "server", "parity": "odd", "baud_rate": 9600,
             **({} if "host" in line else {"device": str(self.folder / "line")}),
             "units": [{"unit": number, "plc": name} for number, name in zip(stations, names)], **line}],
            dds={"blocks": [{"plc": "fp7", "device": "UM100", "count": 26},
                            {"plc": "fp7", "device": "UM150", "count": 7}]})
        for plc in configuration["plcs"]:
            plc["model"] = "FP7"
        self.gateway = self.start_gateway(configuration)
        self.door = self.gateway.client()

    def start_raw(self, *arguments, **line):
        self.raw = RawLine(self)
        self.start_server(*arguments, **line)
        wait_for("the line is open", lambda: "is open" in self.gateway.log)
        return self.raw

    def hold(self, memory):
        """The memory holds these devices and zeros: DT and R by MODBUS, WY by MEWTOCOL."""
        self.door.write_registers(0, [0] * 100)
        self.door.write_coils(RELAYS, [0] * 400)
        self.door.write_coils(0, [0] * 64)
        for device, values in memory.items():
            if device.startswith("DT"):
                self.door.write_registers(int(device[2:]), values)
            elif device.startswith("WY"):
                first = int(device[2:])
                words = "".join(value.to_bytes(2, "little").hex().upper() for value in values)
                self.raw.ask(f"%01#WCCY{first:04}{first + len(values) - 1:04}{words}**")
            else:
                self.door.write_coils(RELAYS + int(device[1:]), values)

    def exchange(self, rows):
        for number, memory, exchanges in rows:
            self.hold(memory)
            for request, answer in exchanges:
                with self.subTest(vector=number, request=request):
                    if answer == "":  # whoever is silent answers the next one
                        self.raw.send(frame(request))
                        self.assertEqual(self.raw.ask(RT), RT_ANSWER)
                    elif answer is None:
                        self.assertNotEqual(self.raw.ask(request), "")
                    else:
                        self.assertEqual(self.raw.ask(request), answer)

    def test_vectors(self):
        self.start_raw()
        self.exchange(COM)

    def test_vectors_of_the_whole_family(self):
        self.start_raw(mewtocol={"commands": "all"})
        self.exchange(ALL)

    def test_vectors_of_mewtocol7(self):
        self.start_raw(protocol="mewtocol7-com")
        self.exchange(SEVEN)

    def test_mewtocol7_with_another_reading_of_its_fields(self):
        self.start_raw((100,), protocol="mewtocol7-com", mewtocol={"dialect": {
            "scope": "", "address_digits": 6, "count_digits": 4, "base": "hexadecimal", "words": "high-byte-first",
            "dt": "D"}})
        self.assertEqual(self.raw.ask(">@10000#00MMWTD001D00000A00021234ABCD****")[:14], ">@10000$00MMWT")
        self.assertEqual(self.door.holding(10, 2), [0x1234, 0xABCD])
        self.assertEqual(self.raw.ask(">@10001#00MMRDD001D00000A0001****")[:18], ">@10001$00MMRD1234")
        self.assertEqual(self.raw.ask(RT, SILENT), "")

    def test_values_on_modbus_tcp(self):
        self.start_raw()
        self.raw.ask("%01#WDD000000000234120100FFFF**")
        self.assertEqual(self.door.holding(0, 4), [0x1234, 1, 0xFFFF, 0])
        self.raw.ask("%01#WDD6553565535CDAB**")
        self.assertEqual(self.door.holding(65535), [0xABCD])
        self.raw.ask("%01#WCSR00121**")
        self.assertEqual(self.door.coils(RELAYS + 0x10, 4), [0, 0, 1, 0])
        self.raw.ask("%01#WCCL000000012301EFBE**")
        self.assertEqual(self.door.input(0, 2), [0x0123, 0xBEEF])
        self.raw.ask("%01#WDL0001000010EFBE**")
        self.assertEqual(self.door.input(0x7D0 + 10), [0xBEEF])
        self.assertEqual(self.raw.ask("%01#RDL00010000105D"), "%01$RDEFBE12")  # V22
        self.door.write_register(500, 0xBEEF)
        self.assertEqual(self.raw.ask("%01#RDD0050000500**"), "%01$RDEFBE12")

    def test_several_stations(self):
        self.start_raw((1, 2))
        self.assertEqual(self.raw.ask("%01#WDD00000000000100**"), "%01$WD13")
        self.assertEqual(self.raw.ask("%02#WDD00000000000200**"), checked("%02$WD"))
        self.assertEqual((self.door.holding(0), self.gateway.client(2).holding(0)), ([1], [2]))
        self.assertEqual(self.raw.ask("%EE#RDD0000000000**"), checked("%EE$RD0100"))  # the first one, and only it
        self.assertEqual(self.raw.ask(RT), RT_ANSWER)
        self.raw.send(frame("%FF#WDD0000000000341255"))
        self.assertEqual(self.raw.ask(RT), RT_ANSWER)
        self.assertEqual((self.door.holding(0), self.gateway.client(2).holding(0)), ([0x1234], [0x1234]))
        # What MC registered belongs to one of them.
        self.assertEqual(self.raw.ask("%01#MCR0000**"), "%01$MC0E")
        self.assertEqual(self.raw.ask("%02#MG**"), checked("%02!62"))

    def test_damaged_frames_change_nothing(self):
        self.start_raw()
        good = frame("%FF#WDD0000000000341255")
        for at in range(len(good)):
            for bit in range(8):
                self.raw.send(good[:at] + bytes([good[at] ^ 1 << bit]) + good[at + 1:])
            self.raw.send(good[:at])
        self.raw.send(frame(RT))
        self.raw.until(RT_ANSWER)
        self.assertEqual(self.door.holding(0), [0])

    def test_damaged_frames_with_a_station(self):
        self.start_raw()
        good = frame("%01#WDD0000000000341256")
        self.assertEqual(self.raw.ask(good[:-1].decode()), "%01!4001")
        good = frame(checked("%01#WDD00000000003412"))
        for at in range(len(good) - 1):
            for bit in range(8):
                self.raw.send(good[:at] + bytes([good[at] ^ 1 << bit]) + good[at + 1:])
                self.raw.send(frame(RT))
                said = self.raw.until(RT_ANSWER)
                self.assertNotIn("%01$WD13", said, (at, bit))
        self.assertEqual(self.door.holding(0), [0])
        self.raw.send(good + good)
        self.assertEqual((self.raw.hear(), self.raw.hear()), ("%01$WD13", "%01$WD13"))

    def test_frames_in_pieces(self):
        self.start_raw()
        for byte in frame("%01#WDD00000000003412**"):
            self.raw.send(bytes([byte]))
            time.sleep(0.003)
        self.assertEqual(self.raw.hear(), "%01$WD13")

    def test_local_echo(self):
        self.start_raw(local_echo="on")
        self.door.write_registers(0, list(range(60)))
        for request in ("%01#RDD000000005959", "%0124&", "%0124&", RT, "%01#XY06"):
            self.raw.send(frame(request))
            answer = self.raw.hear()
            self.assertNotEqual(answer, "")
            self.raw.send(frame(answer))
        self.assertEqual(self.raw.ask(RT), RT_ANSWER)

    def test_behind_a_device_server(self):
        listener = socket.create_server(("127.0.0.1", 0))
        self.addCleanup(listener.close)
        self.start_server(host="127.0.0.1", port=listener.getsockname()[1])
        listener.settimeout(PATIENCE)
        line, _ = listener.accept()
        self.addCleanup(line.close)
        line.settimeout(PATIENCE)
        for part in (b"%01#WDD0000000", b"0003412**", b"\r"):
            line.sendall(part)
            time.sleep(0.02)
        self.assertEqual(line.recv(100), b"%01$WD13\r")
        self.assertEqual(self.door.holding(0), [0x1234])

    def test_status_words(self):
        self.start_raw((7,))
        watch = self.gateway.watch()
        # MEWTOCOL-COM, station 7, 9600 bit/s, 8 bits, odd, 1 stop bit.
        words = watch.expect("fp7.UM100")["values"]
        self.assertEqual(words[:6], [0, 7, 5, 1, 1, 0])
        self.assertEqual(watch.expect("fp7.UM150")["values"][:2], [0, 232])
        self.assertEqual(self.door.discrete(0, 0x20), [0] * 0xC + [1] + [0] * 0x13)  # XC: can ask
        self.assertEqual(self.plc_command("stop", "fp7")[0], 0)
        self.assertEqual(self.door.discrete(0xC), [0])
        self.assertEqual(self.plc_command("run", "fp7")[0], 0)
        self.assertEqual(self.door.discrete(0xC), [1])
        self.assertEqual(self.plc_command("power-cycle", "fp7")[0], 0)
        self.assertEqual(self.door.discrete(0xC), [1])

    def test_channel_reset(self):
        self.start_raw()
        self.raw.ask("%01#MCR0000**")
        self.assertTrue(self.raw.ask("%01#RDD000000005959").endswith("&"))
        self.raw.send(b"%01#WDD0000000000")  # half a frame
        time.sleep(0.1)
        self.door.write_coil(RESET, 1)
        self.assertEqual(self.door.discrete(RESET), [1])
        self.raw.send(b"3412**\r")
        self.assertEqual(self.raw.ask("%0124&"), "%01!4302")
        self.assertEqual(self.raw.ask("%01#MG0D"), "%01!6201")
        self.assertEqual(self.door.holding(0), [0])
        self.door.write_coil(RESET, 0)
        self.assertEqual(self.door.discrete(RESET), [0])
        self.assertEqual(self.raw.ask(RT), RT_ANSWER)

    def test_modbus_rtu_on_an_fp7(self):
        """Table 8.2 and the functions that it marks."""
        self.start_bus(2)
        self.start_server((5,), protocol="modbus-rtu", parity="none", baud_rate=19200)
        client = SerialClient(self, self.folder / "line.1", 5)
        client.write_coil(0x20, 1)                                             # Y20
        client.write_coils(RELAYS + 0x7FF0, [1, 0, 1] + [0] * 13)              # to R2047F
        client.write_register(65535, 7)                                        # DT65535
        client.write_registers(100, [1, 2, 3])
        self.assertEqual(client.coils(0x20, 2), [1, 0])
        self.assertEqual(client.coils(RELAYS + 0x7FF0, 3), [1, 0, 1])
        self.assertEqual(client.holding(65535), [7])
        self.assertEqual(self.door.holding(100, 3), [1, 2, 3])
        self.assertEqual(client.discrete(0, 0x20), [0] * 0xC + [1] + [0] * 0x13)
        self.assertEqual(client.input(0, 125), [0] * 125)                      # WL
        self.assertEqual(client.input(0x7D0 + 16383), [0])                     # LD16383
        for first, read in ((0x7D0 + 16384, client.input), (1024, client.input), (8192, client.discrete),
                            (RELAYS + 32768, client.coils)):
            with self.assertRaises(Refused) as raised:
                read(first)
            self.assertEqual(raised.exception.code, 2)
        with self.assertRaises(Refused) as raised:
            client.do(client.modbus.mask_write_register(address=10, and_mask=0xF0FF, or_mask=0x0400, unit=5))
        self.assertEqual(raised.exception.code, 1)
        words = self.gateway.watch().expect("fp7.UM100")["values"]
        self.assertEqual(words[:6], [2, 5, 6, 1, 0, 0])
        client.write_coil(RESET, 1)
        self.assertEqual(client.discrete(RESET), [1])


main()
