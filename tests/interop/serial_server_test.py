"""The gateway as RTU server on a serial line: mbpoll, pymodbus and raw frames as the client."""

import time

from pymodbus.client import ModbusSerialClient

from faulty_device import framed
from raw_client import RawClient
from support import Client, InteropTest, Refused, main, mbpoll_values, wait_for

SILENT = 0.25        # seconds without an answer that are enough to say that there is none
M8404 = 0x1E00 + 404  # listen-only mode of channel 1
D8402 = 8402  # error code of channel 1


class SerialClient(Client):
    """pymodbus on a serial port."""

    def __init__(self, test, port, unit):  # pylint: disable=super-init-not-called
        self.unit = unit
        self.modbus = ModbusSerialClient(str(port), baudrate=19200, parity="N", timeout=2, retries=0)
        wait_for(f"{port} opens", self.modbus.connect)
        test.addCleanup(self.modbus.close)


def data(text):
    return bytes.fromhex(text)


class SerialServerTest(InteropTest):
    def start_server(self, models=("FX3U",), **line):
        """Unit 5 is PLC "main", unit 6 "other"."""
        names = ("main", "other")[:len(models)]
        units = [{"unit": 5 + i, "plc": name, "channel": 1} for i, name in enumerate(names)]
        configuration = self.configuration(units=names, lines=[
            {"name": "bus", "device": str(self.folder / "line"), "parity": "none", "role": "server", "units": units,
             **line}])
        for plc, model in zip(configuration["plcs"], models):
            plc["model"] = model
        self.gateway = self.start_gateway(configuration)
        wait_for("the line is open", lambda: "line bus: " in self.gateway.log and "is open" in self.gateway.log)

    def start_raw(self, *models, **line):
        self.raw = RawClient(self)
        self.start_server(models or ("FX3U",), **line)
        time.sleep(0.1)  # a silence, from which the gateway knows where a frame begins

    def expect(self, unit, request, answer):
        with self.subTest(request=request):
            self.assertEqual(self.raw.ask(unit, data(request)).hex(" "), data(answer).hex(" "))

    def silent(self, frame):
        self.raw.send(frame)
        self.assertEqual(self.raw.hear(SILENT), b"")

    def test_pymodbus(self):
        self.start_bus(2)
        self.start_server()
        client = SerialClient(self, self.folder / "line.1", 5)
        door = self.gateway.client()
        client.write_coil(7, 1)                                                                         # 05
        client.write_coils(0x3300, [1, 0, 1, 1, 0, 0, 0, 0, 1])                                         # 0F, Y0
        self.assertEqual(client.coils(0, 16), [0] * 7 + [1] + [0] * 8)                                  # 01
        self.assertEqual(client.discrete(0x3300, 9), [1, 0, 1, 1, 0, 0, 0, 0, 1])                       # 02
        client.write_register(10, 0xABCD)                                                               # 06
        client.write_registers(0x2140, list(range(1000, 1123)))                                         # 10, R0
        self.assertEqual(client.holding(9, 3), [0, 0xABCD, 0])                                          # 03
        self.assertEqual(client.holding(0x2140, 123), list(range(1000, 1123)))
        self.assertEqual(client.input(0x2140, 123), list(range(1000, 1123)))                            # 04
        client.do(client.modbus.mask_write_register(address=10, and_mask=0xF0FF, or_mask=0x0400, unit=5))  # 16
        answer = client.do(client.modbus.readwrite_registers(read_address=19, read_count=4, write_address=20,
                                                             write_registers=[5, 6], unit=5))           # 17
        self.assertEqual(answer.registers, [0, 5, 6, 0])
        self.assertEqual((client.holding(10), door.holding(10)), ([0xA4CD], [0xA4CD]))
        self.assertEqual(door.holding(0x2140, 123), list(range(1000, 1123)))
        self.assertEqual(len(client.coils(0, 2000)), 2000)
        self.assertEqual(len(client.holding(0, 125)), 125)
        with self.assertRaises(Refused) as raised:
            client.holding(65535)
        self.assertEqual(raised.exception.code, 2)

    def test_mbpoll(self):
        self.start_bus(2)
        self.start_server()

        def poll(table, first, count=1, write=()):
            command = ["mbpoll", "-m", "rtu", "-b", 19200, "-P", "none", "-a", 5, "-t", table, "-0", "-r", first,
                       *([] if write else ["-c", count]), "-1", "-o", "5", self.folder / "line.1", *write]
            return mbpoll_values(command)

        poll(0, 3, write=[1])
        poll(0, 20, write=[1, 0, 1])
        poll(4, 5, write=[4711])
        poll(4, 6, write=[1, 65535, 3])
        self.assertEqual(poll(0, 2, 3), [0, 1, 0])
        self.assertEqual(poll(1, 20, 3), [1, 0, 1])
        self.assertEqual(poll(4, 5, 4), [4711, 1, 65535, 3])
        self.assertEqual(poll(3, 5, 4), [4711, 1, 65535, 3])
        self.assertEqual(self.gateway.client().holding(5, 4), [4711, 1, 65535, 3])
        with self.assertRaisesRegex(AssertionError, "(?i)illegal data address"):
            poll(4, 65535)

    def test_functions_of_memory(self):
        self.start_raw()
        self.expect(5, "06 0064 1234", "06 0064 1234")
        self.expect(5, "10 0065 0002 04 0001 0002", "10 0065 0002")
        self.expect(5, "03 0064 0003", "03 06 1234 0001 0002")
        self.expect(5, "04 0064 0001", "04 02 1234")
        self.expect(5, "05 0003 FF00", "05 0003 FF00")
        self.expect(5, "0F 0008 0003 01 05", "0F 0008 0003")
        self.expect(5, "01 0000 000B", "01 02 08 05")
        self.expect(5, "02 0000 000B", "02 02 08 05")
        self.expect(5, "16 0064 00F2 0025", "16 0064 00F2 0025")
        self.expect(5, "17 0064 0002 0066 0001 02 BEEF", "17 04 0035 0001")
        self.assertEqual(self.gateway.client().holding(100, 3), [0x35, 1, 0xBEEF])

    def test_functions_of_the_station(self):
        self.start_raw()
        self.expect(5, "07", "07 00")
        self.expect(5, "08 0000 A55A", "08 0000 A55A")
        self.expect(5, "08 0002 0000", "08 0002 0000")
        self.expect(5, "08 000A 0000", "08 000A 0000")
        self.expect(5, "08 0001 FF00", "08 0001 FF00")  # restart, and clear the log
        self.expect(5, "03 0000 0001", "03 02 0000")
        self.expect(5, "0B", "0B 0000 0001")
        self.assertRegex(self.raw.ask(5, data("0C")).hex(" "), "^0c 0c 00 00 00 01 00 03 80 40 80 40 80 00$")
        self.expect(5, "11", "11 02 F3 FF")
        self.assertEqual(self.plc_command("stop", "main")[0], 0)
        self.expect(5, "11", "11 02 F3 00")
        self.assertEqual(self.plc_command("run", "main")[0], 0)
        self.expect(5, "11", "11 02 F3 FF")

    def test_exceptions(self):
        self.start_raw()
        self.expect(5, "41", "C1 01")
        self.expect(5, "41 00 01 02", "C1 01")
        self.expect(5, "2B 0E 01 00", "AB 01")
        self.expect(5, "03 FFFF 0001", "83 02")
        self.expect(5, "03 0000 007E", "83 03")
        self.expect(5, "05 0000 1234", "85 03")

    def test_broadcasts_are_carried_out_and_not_answered(self):
        self.start_raw("FX3U", "FX3U")
        self.silent(framed(data("00 05 0003 FF00")))
        self.silent(framed(data("00 06 0064 1234")))
        self.silent(framed(data("00 10 0065 0002 04 0001 0002")))
        self.silent(framed(data("00 03 0064 0001")))  # no broadcast, but not answered either
        for unit in (1, 2):
            door = self.gateway.client(unit)
            self.assertEqual((door.holding(100, 3), door.coils(3)), ([0x1234, 1, 2], [1]))
        self.expect(5, "03 0064 0001", "03 02 1234")
        self.assertEqual(self.raw.number(5, 0x0F), 4)  # without response

    def test_the_same_again_and_again_is_no_echo(self):
        self.start_raw()
        for words in ("06 0064 0001", "08 0000 1234"):  # their responses are their requests
            for _ in range(7):
                self.expect(5, words, words)
                time.sleep(0.25)

    def test_other_units_and_damaged_frames(self):
        self.start_raw()
        good = framed(data("05 06 0064 0001"))
        self.silent(framed(data("07 06 0064 0002")))
        self.silent(good[:-1] + bytes([good[-1] ^ 1]))
        self.silent(good[:-3])
        self.assertEqual(self.gateway.client().holding(100), [0])
        self.expect(5, "06 0064 0003", "06 0064 0003")
        # In pieces, as USB adapters deliver.
        for byte in framed(data("05 03 0064 0001")):
            self.raw.send(bytes([byte]))
            time.sleep(0.002)
        self.assertEqual(self.raw.hear(), framed(data("05 03 02 0003")))
        # An answer of a neighbour, then a request to us.
        self.raw.send(framed(data("07 03 0064 0001")))
        time.sleep(0.005)
        self.raw.send(framed(data("07 03 02 0005")))
        time.sleep(0.005)
        self.expect(5, "03 0064 0001", "03 02 0003")

    def test_two_stations_of_two_plcs(self):
        self.start_raw("FX3U", "FX3G")
        self.expect(5, "06 0064 0005", "06 0064 0005")
        self.expect(6, "06 0064 0006", "06 0064 0006")
        self.expect(5, "03 0064 0001", "03 02 0005")
        self.expect(6, "03 0064 0001", "03 02 0006")
        self.assertEqual([self.gateway.client(unit).holding(100) for unit in (1, 2)], [[5], [6]])
        self.expect(5, "07", "07 00")
        self.expect(6, "07", "87 01")  # an FX3G has the eight basic functions

    def test_counters(self):
        self.start_raw()
        self.expect(5, "08 000A 0000", "08 000A 0000")
        for _ in range(3):
            self.expect(5, "03 0064 0001", "03 02 0000")
        bad = framed(data("05 03 0064 0001"))
        self.silent(bad[:-1] + bytes([bad[-1] ^ 1]))
        self.expect(5, "03 FFFF 0001", "83 02")
        self.silent(framed(data("00 06 0064 0001")))
        self.silent(framed(data("07 03 0000 0001")))
        self.assertEqual(self.raw.number(5, 0x0B), 7)  # whole frames, with this one
        self.assertEqual(self.raw.number(5, 0x0C), 1)  # damaged
        self.assertEqual(self.raw.number(5, 0x0D), 1)  # exceptions
        self.assertEqual(self.raw.number(5, 0x0E), 9)  # to this station
        self.assertEqual(self.raw.number(5, 0x0F), 1)  # without response
        self.assertEqual([self.raw.number(5, sub) for sub in (0x10, 0x11, 0x12)], [0, 0, 0])
        self.assertNotEqual(self.gateway.client().holding(D8402), [0])

    def test_listen_only_mode(self):
        self.start_raw()
        door = self.gateway.client()
        self.silent(framed(data("05 08 0004 0000")))
        self.assertEqual(door.coils(M8404), [1])
        self.silent(framed(data("05 06 0064 0001")))
        self.assertEqual(door.holding(100), [0])
        self.silent(framed(data("05 08 0001 0000")))  # restart
        self.assertEqual(door.coils(M8404), [0])
        self.expect(5, "03 0064 0001", "03 02 0000")

    def silence_before_answers(self, baud_rate, least):
        self.start_raw(baud_rate=baud_rate)
        for _ in range(60):
            self.assertEqual(self.raw.ask(5, data("03 0064 0001")), data("03 02 0000"))
        print(f"{baud_rate} bit/s: {min(self.raw.delays) * 1000:.2f} ms of silence at least")
        self.assertGreaterEqual(min(self.raw.delays), least)

    def test_silence_of_3_5_characters_before_answers(self):
        self.silence_before_answers(9600, 0.003645)

    def test_silence_of_1_75_ms_before_answers_above_19200(self):
        self.silence_before_answers(115200, 0.00175)

    def test_settings_show_in_the_plc(self):
        self.start_raw()
        door = self.gateway.client()
        self.assertEqual((door.holding(8400, 2), door.holding(8405), door.holding(8414), door.holding(8419)),
                         ([0x0091, 0x11], [0x0091], [5], [9]))
        self.assertEqual(self.plc_command("power-cycle", "main")[0], 0)
        self.assertEqual((door.holding(8400, 2), door.holding(8414)), ([0x0091, 0x11], [5]))

    def test_port_that_comes_later(self):
        self.start_gateway(self.configuration(lines=[
            {"name": "bus", "device": str(self.folder / "line"), "parity": "none", "role": "server",
             "units": [{"unit": 5, "plc": "main", "channel": 1}]}]))
        door = self.programs[0].client()
        wait_for("error 201 of channel 1", lambda: door.holding(D8402, 2) == [201, 1])
        raw = self.raw = RawClient(self)
        wait_for("the line is open", lambda: "is open" in self.programs[0].log)
        time.sleep(0.1)
        self.assertEqual(raw.ask(5, data("06 0000 0001")), data("06 0000 0001"))


main()
