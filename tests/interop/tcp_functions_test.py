"""pymodbus, libmodbus and mbpoll as clients of the MODBUS TCP server: functions and exceptions."""

import subprocess
import sys

from pymodbus.pdu import ModbusRequest

from support import PATIENCE, InteropTest, Refused, binary, main, mbpoll

COILS, DISCRETE_INPUTS, INPUT_REGISTERS, HOLDING_REGISTERS = 0, 1, 3, 4  # mbpoll's -t
LAST_D = 0x1F40 + 511   # D8511; R0 follows
LAST_HOLDING = 0xA7B7   # Y360-Y377, the end of the standard table
LAST_COIL = 0x33FF      # Y377


class AnyFunction(ModbusRequest):
    """A request with a function code that pymodbus has no class for."""

    function_code = 0

    def __init__(self, function, data, unit=1):
        super().__init__(unit)
        self.function_code = function
        self.data = data

    def encode(self):
        return self.data

    def get_response_pdu_size(self):
        return 0


class TcpFunctionsTest(InteropTest):
    def setUp(self):
        self.gateway = self.start_gateway(self.configuration(units=["main", "other"]))

    def refused(self, code, call, *arguments):
        with self.assertRaises(Refused) as raised:
            call(*arguments)
        self.assertEqual(raised.exception.code, code)

    def test_pymodbus_writes_and_reads_back(self):
        client = self.gateway.client()
        client.write_coil(7, 1)                                                                         # 05
        client.write_coils(0x3300, [1, 0, 1, 1, 0, 0, 0, 0, 1])                                         # 0F, Y0
        self.assertEqual(client.coils(0, 16), [0] * 7 + [1] + [0] * 8)                                  # 01
        self.assertEqual(client.coils(0x3300, 9), [1, 0, 1, 1, 0, 0, 0, 0, 1])
        self.assertEqual(client.discrete(0x3300, 9), [1, 0, 1, 1, 0, 0, 0, 0, 1])                       # 02
        client.write_register(10, 0xABCD)                                                               # 06
        client.write_registers(0x2140, list(range(1000, 1123)))                                         # 10, R0
        self.assertEqual(client.holding(9, 3), [0, 0xABCD, 0])                                          # 03
        self.assertEqual(client.holding(0x2140, 123), list(range(1000, 1123)))
        self.assertEqual(client.input(0x2140, 123), list(range(1000, 1123)))                            # 04
        client.do(client.modbus.mask_write_register(address=10, and_mask=0xF0FF, or_mask=0x0400, unit=1))  # 16
        self.assertEqual(client.holding(10), [0xA4CD])
        answer = client.do(client.modbus.readwrite_registers(read_address=19, read_count=4, write_address=20,
                                                             write_registers=[5, 6], unit=1))           # 17
        self.assertEqual(answer.registers, [0, 5, 6, 0])
        self.assertEqual(client.coils(0, 2000)[:16], [0] * 7 + [1] + [0] * 8)
        self.assertEqual(client.holding(0, 125)[10], 0xA4CD)

    def test_units_lead_to_their_plc(self):
        first, second = self.gateway.client(1), self.gateway.client(2)
        first.write_register(0, 1)
        second.write_register(0, 2)
        self.assertEqual((first.holding(0), second.holding(0)), ([1], [2]))
        for unit in (0, 3, 247, 255):
            with self.subTest(unit=unit):
                self.refused(0x0A, self.gateway.client(unit).holding, 0)

    def test_exception_01_for_unknown_functions(self):
        client = self.gateway.client()
        for function in (0x07, 0x08, 0x0B, 0x0C, 0x11, 0x14, 0x18, 0x2B, 0x41, 0x7F):
            with self.subTest(function=function):
                self.refused(1, client.do, client.modbus.execute(AnyFunction(function, b"")))

    def test_exception_02_for_addresses_that_do_not_exist(self):
        client = self.gateway.client()
        self.assertEqual(len(client.holding(LAST_HOLDING)), 1)
        self.assertEqual(len(client.coils(LAST_COIL)), 1)
        for call, *arguments in ((client.holding, LAST_HOLDING + 1), (client.holding, LAST_HOLDING, 2),
                                 (client.holding, 65535), (client.input, 65535), (client.discrete, 65535),
                                 (client.coils, LAST_COIL + 1), (client.coils, LAST_COIL, 2),
                                 (client.write_coil, LAST_COIL + 1, 1), (client.write_coils, LAST_COIL, [1, 1]),
                                 (client.write_register, LAST_HOLDING + 1, 1),
                                 (client.write_registers, LAST_HOLDING, [1, 2])):
            with self.subTest(call=call.__name__, arguments=arguments):
                self.refused(2, call, *arguments)
        # What was refused was not written in part either.
        self.assertEqual((client.holding(LAST_HOLDING), client.coils(LAST_COIL)), ([0], [0]))

    def test_exception_03_for_impossible_counts_and_values(self):
        client = self.gateway.client()
        for function, data in ((1, "0000 0000"), (1, "0000 07D1"), (2, "0000 07D1"), (3, "0000 0000"), (3, "0000 007E"),
                               (4, "0000 007E"), (5, "0000 1234"), (15, "0000 0000 00"), (15, "0000 0010 01 FF"),
                               (16, "0000 0000 00"), (16, "0000 0002 02 0001"), (16, "0000 007C 02 0000"),
                               (23, "0000 007E 0000 0001 02 0000"), (23, "0000 0001 0000 0000 00")):
            with self.subTest(function=function, data=data[:20]):
                self.refused(3, client.do, client.modbus.execute(AnyFunction(function, bytes.fromhex(data))))

    def test_a_row_of_the_map_continues_in_the_next(self):
        client = self.gateway.client()
        client.write_registers(LAST_D, [1, 2])
        self.assertEqual((client.holding(LAST_D), client.holding(0x2140)), ([1], [2]))

    def test_libmodbus(self):
        done = subprocess.run([binary("LIBMODBUS_CLIENT"), str(self.gateway.port)], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=PATIENCE, check=False)
        print(done.stdout, file=sys.stderr)
        self.assertEqual(done.returncode, 0)

    def test_mbpoll(self):
        def read(table, first, count):
            return mbpoll(self.gateway.port, table, first, count)

        mbpoll(self.gateway.port, COILS, 3, write=[1])                   # 05
        mbpoll(self.gateway.port, COILS, 20, write=[1, 0, 1])            # 0F
        mbpoll(self.gateway.port, HOLDING_REGISTERS, 5, write=[4711])    # 06
        mbpoll(self.gateway.port, HOLDING_REGISTERS, 6, write=[1, 65535, 3])  # 10
        self.assertEqual(read(COILS, 2, 3), [0, 1, 0])
        self.assertEqual(read(DISCRETE_INPUTS, 20, 3), [1, 0, 1])
        self.assertEqual(read(HOLDING_REGISTERS, 5, 4), [4711, 1, 65535, 3])
        self.assertEqual(read(INPUT_REGISTERS, 5, 4), [4711, 1, 65535, 3])
        for problem, call in (("Illegal data address", lambda: mbpoll(self.gateway.port, HOLDING_REGISTERS, 65535)),
                              ("gateway", lambda: mbpoll(self.gateway.port, HOLDING_REGISTERS, 0, unit=9))):
            with self.subTest(problem=problem), self.assertRaisesRegex(AssertionError, f"(?i){problem}"):
                call()


main()
