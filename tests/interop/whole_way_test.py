"""From the registers of libmodbus field devices to MODBUS TCP and DDS, and back."""

import time

from support import InteropTest, main, mbpoll, route, serial_line, station, wait_for

# Holding register 100 is D200, 264 is R40; coil n is M n, coil 64 + n is X n.
PROGRAM = ["LD M8411",
           "MOV H0004 D8470", "MOV K0 D8471",
           "MOV H5001 D8472", "MOV K0 D8473",
           "MOV HC010 D8474", "MOV K100 D8475",
           "MOV HD004 D8476", "MOV K32 D8477"]
COILS, DISCRETE_INPUTS, INPUT_REGISTERS, HOLDING_REGISTERS = 0, 1, 3, 4  # mbpoll's -t


class WholeWayTest(InteropTest):
    def setUp(self):
        self.start_bus(3)
        self.one = self.start_device(1, 1, "--set", "ir:20=2020", "ir:21=0", "ir:22=65535")
        self.two = self.start_device(2, 2, "--set", "di:0=1", "di:3=1", "di:11=1")
        self.three = self.start_device(3, 3)

    def start(self, *routes):
        self.gateway = self.start_gateway(self.configuration(
            PROGRAM, lines=[serial_line(self.folder / "line")],
            stations=[station("one", 1), station("two", 2), station("three", 3)],
            routes=[{"period_ms": 100, **each} for each in routes]))
        self.watch = self.gateway.watch()

    def read(self, table, first, count):
        return mbpoll(self.gateway.port, table, first, count)

    def expect(self, table, first, values):
        wait_for(lambda: f"{values} at {first}, mbpoll reads {self.read(table, first, len(values))}",
                 lambda: self.read(table, first, len(values)) == values)

    def test_register_of_a_device_is_at_the_allocated_register_and_in_dds(self):
        self.start(route("one.values", "holding", 10, "D200", 4), route("two.values", "holding", 10, "D210", 4),
                   route("three.values", "holding", 10, "D220", 4))
        for change in (0, 7):
            for number, device in enumerate((self.one, self.two, self.three)):
                values = [1000 * number + 1 + change, 65535 - number, 0, 32768 + change]
                with self.subTest(device=device.name, values=values):
                    mbpoll(device.tcp_port, HOLDING_REGISTERS, 10, write=values)
                    self.expect(HOLDING_REGISTERS, 100 + 10 * number, values)
                    name = f"{['one', 'two', 'three'][number]}.values"
                    sample = self.watch.expect(name, values=values, quality="good")
                    self.assertEqual(device.door.holding(10, 4), values)
                    self.assertEqual([sample[key] for key in ("gateway", "area", "first", "count", "format")],
                                     ["interop", "holding", 10, 4, "words"])
                    self.assertLess(abs(time.time() - sample["source_ns"] / 1e9), 10)

    def test_every_table_of_a_device_to_d_r_m_and_x(self):
        self.start(route("one.holding", "holding", 0, "D200", 2), route("one.input", "input", 20, "R40", 3),
                   route("two.coils", "coil", 5, "M8", 10), route("two.discrete", "discrete", 0, "X0", 12))
        mbpoll(self.one.tcp_port, HOLDING_REGISTERS, 0, write=[11, 22])
        mbpoll(self.two.tcp_port, COILS, 5, write=[1, 0, 1, 1, 0, 0, 0, 1, 0, 1])
        self.expect(HOLDING_REGISTERS, 100, [11, 22])
        self.expect(HOLDING_REGISTERS, 264, [2020, 0, 65535])
        self.expect(COILS, 8, [1, 0, 1, 1, 0, 0, 0, 1, 0, 1])
        self.expect(COILS, 64, [1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1])
        self.watch.expect("one.input", values=[2020, 0, 65535], area="input")
        self.watch.expect("two.coils", values=[1, 0, 1, 1, 0, 0, 0, 1, 0, 1], area="coil", format="bits")
        self.watch.expect("two.discrete", values=[1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1], area="discrete")
        # X stays where the standard map has it for function 02.
        self.assertEqual(self.read(DISCRETE_INPUTS, 0x3400, 12), [1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1])

    def test_write_of_a_tcp_client_reaches_the_device(self):
        self.start(route("one.register", "holding", 100, "D110", direction="write"),
                   route("one.registers", "holding", 110, "D120", 3, direction="write"),
                   route("two.coil", "coil", 50, "M32", direction="write"),
                   route("two.coils", "coil", 60, "M40", 5, direction="write"))
        client = self.gateway.client()
        for value in (1, 0, 1):
            client.write_coil(32, value)                                          # 05
            wait_for("the coil in the device", lambda v=value: self.two.door.coils(50) == [v])
        client.write_register(10, 4711)                                           # 06
        wait_for("the register in the device", lambda: self.one.door.holding(100) == [4711])
        client.write_coils(40, [1, 0, 1, 1, 0])                                   # 0F
        wait_for("the coils in the device", lambda: self.two.door.coils(60, 5) == [1, 0, 1, 1, 0])
        client.write_registers(20, [1, 65535, 3])                                 # 10
        wait_for("the registers in the device", lambda: self.one.door.holding(110, 3) == [1, 65535, 3])
        self.watch.expect("one.registers", values=[1, 65535, 3], quality="good")
        self.watch.expect("two.coils", values=[1, 0, 1, 1, 0], quality="good")
        # Not a bit beside them.
        self.assertEqual(self.one.door.holding(109, 5), [0, 1, 65535, 3, 0])
        self.assertEqual(self.two.door.coils(58, 9), [0, 0, 1, 0, 1, 1, 0, 0, 0])

    def test_refused_address_is_a_device_error_of_that_route_only(self):
        self.start(route("three.values", "holding", 0, "D200"), route("three.beyond", "holding", 5000, "D210"),
                   route("three.refused", "holding", 5000, "D220", direction="write"))
        self.gateway.client().write_register(120, 1)
        self.watch.expect("three.beyond", quality="device error")
        self.watch.expect("three.refused", quality="device error")
        self.assertIn("exception 02", self.gateway.log)
        mbpoll(self.three.tcp_port, HOLDING_REGISTERS, 0, write=[99])
        self.watch.expect("three.values", values=[99], quality="good")

    def test_late_subscriber_has_every_route_at_once(self):
        self.start(route("one.values", "holding", 0, "D200"), route("one.input", "input", 20, "R40", 3),
                   route("two.discrete", "discrete", 0, "X0", 4))
        last = {"one.values": [0], "one.input": [2020, 0, 65535], "two.discrete": [1, 0, 0, 1]}
        for name, values in last.items():
            self.watch.expect(name, values=values, quality="good")
        self.two.kill()
        self.watch.expect("two.discrete", quality="comm error")
        late = self.gateway.watch()
        for name, values in last.items():
            late.expect(name, values=values, quality="comm error" if name == "two.discrete" else "good", seconds=5)

    def test_slow_route_is_read_soon_after_the_start(self):
        self.start(route("one.values", "holding", 0, "D200"),
                   route("one.input", "input", 20, "R40", 3, period_ms=3600000))
        self.watch.expect("one.input", values=[2020, 0, 65535], quality="good", seconds=5)


main()
