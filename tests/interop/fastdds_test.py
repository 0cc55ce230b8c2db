"""What a foreign subscriber, on Fast DDS, gets of the built daemon; compared with what MODBUS TCP reads of it."""

import struct
import time

from fastdds import BITS, BOOLEAN, INTEGER, QUALITY, REAL, RECEIVED, TEXT, Publisher, Subscriber
from support import InteropTest, holds, main, route, serial_line, station, wait_for
from text_device import TextDevice

REGISTERS = [1234, 65535, 0, 32768]
BLOCK = {"gateway": "interop", "route": "one.registers", "area": "holding", "first": 10}
COILS = {"gateway": "interop", "route": "one.coils", "area": "coil", "first": 3}
POINTS = [{"name": "plant.integer", "plc": "main", "device": "D200", "type": "uint16"},
          {"name": "plant.scaled", "plc": "main", "device": "D201", "type": "int16", "scale": 0.5, "unit": "Cel"},
          {"name": "plant.text", "plc": "main", "device": "D300", "type": "text", "characters": 8},
          {"name": "plant.float", "plc": "main", "device": "D310", "type": "float"},
          {"name": "plant.switch", "plc": "main", "device": "M0", "type": "bool"}]
SCALE = {"name": "weighing", "pattern": "GS,{weight:+#####.#}kg", "plc": "main",
         "fields": [{"name": "weight", "device": "D400", "type": "int32", "decimals": 1}]}


class InstancesTest(InteropTest):
    """What becomes of instances: without key hashes Fast DDS would take it for the one that it heard last."""

    def setUp(self):
        self.dds = self.configuration()["dds"]
        self.publisher = Publisher(self, self.dds, "plant", 20)
        self.fast = Subscriber(self, self.dds)
        for i in range(20):
            self.fast.expect("RegisterBlock", self.key(i), instance="alive", words=[i, 7])

    @staticmethod
    def key(i):
        return {"gateway": "plant", "route": f"peer.{i}", "area": "holding", "first": i}

    def test_a_route_that_goes_away_is_disposed(self):
        for i in range(3):
            self.publisher.dispose_next()
            self.fast.expect("RegisterBlock", self.key(i), instance="disposed")
            for other in range(20):
                self.assertEqual(self.fast.latest("RegisterBlock", **self.key(other))["instance"],
                                 "disposed" if other <= i else "alive")
        late = Subscriber(self, self.dds)
        late.expect("RegisterBlock", self.key(19), instance="alive")
        self.assertEqual(late.of("RegisterBlock", **self.key(0)), [])

    def test_the_end_of_a_gateway_is_seen(self):
        for end in (self.publisher.orders.close, lambda: self.again.kill()):  # by itself; killed, its lease is 5 s
            self.fast.expect_writers("RegisterBlock", 1)
            end()
            for topic in ("RegisterBlock", "Point", "GatewayStatus", "SerialMessage"):
                self.fast.expect_writers(topic, 0)
            self.again = Publisher(self, self.dds, "plant", 20)


class FastDdsTest(InteropTest):
    def setUp(self):
        self.start_bus(2)
        self.device = self.start_device(1, 1, *(word for i, value in enumerate(REGISTERS)
                                                for word in ("--set", f"hr:{10 + i}={value}")),
                                        "--set", "co:3=1", "co:5=1", "co:19=1")

    def start(self, routes=None, **more):
        self.gateway = self.start_gateway(self.configuration(
            lines=[serial_line(self.folder / "line", response_timeout_ms=300, retries=0), *more.pop("lines", [])],
            stations=[station("one", 1)],
            routes=routes or [route("one.registers", "holding", 10, "D200", 4, period_ms=100),
                              route("one.coils", "coil", 3, "M0", 20, period_ms=100)], **more))
        self.client = self.gateway.client()
        return self.subscriber()

    def subscriber(self):
        return Subscriber(self, self.gateway.dds)

    def test_blocks_hold_what_modbus_tcp_reads(self):
        fast = self.start()
        for registers in (REGISTERS, [7, 8, 9, 10]):
            self.device.door.write_registers(10, registers)
            sample = fast.expect("RegisterBlock", BLOCK, words=registers, quality=QUALITY["good"], format=0, count=4)
            wait_for("MODBUS TCP reads them, too", lambda: self.client.holding(200, 4) == registers)
            self.assertEqual([sample["instance"], bool(sample["member"])], ["alive", True])
            self.assertLess(abs(time.time() - sample["source_ns"] / 1e9), 10)
        bits = [int(i in (0, 2, 16)) for i in range(20)]
        fast.expect("RegisterBlock", COILS, words=[0b101, 1], quality=QUALITY["good"], format=BITS, count=20)
        self.assertEqual(self.client.coils(0, 20), bits)
        for key in (BLOCK, COILS):
            numbers = [each["seq"] for each in fast.of("RegisterBlock", **key)]
            self.assertEqual(numbers, sorted(set(numbers)))

    def test_points_of_every_kind(self):
        fast = self.start(points=POINTS)
        high, low = struct.unpack(">HH", struct.pack(">f", 21.5))
        text = [ord("a") << 8 | ord("b"), ord("c") << 8, 0, 0]
        self.client.write_registers(300, text)
        self.client.write_registers(310, [high, low])

        def expect(name, **wanted):
            return fast.expect("Point", {"gateway": "interop", "name": name}, quality=QUALITY["good"], **wanted)
        expect("plant.integer", kind=INTEGER, integer=REGISTERS[0], real=REGISTERS[0], unit="")
        expect("plant.scaled", kind=REAL, real=-0.5, unit="Cel")
        expect("plant.text", kind=TEXT, text="abc")
        expect("plant.float", kind=REAL, real=21.5, integer=21)
        expect("plant.switch", kind=BOOLEAN, integer=1, real=1)

    def test_a_late_joiner_gets_the_latest_of_every_instance(self):
        first = self.start(points=POINTS)
        first.expect("RegisterBlock", BLOCK, words=REGISTERS)
        self.device.door.write_registers(10, [1, 2, 3, 4])
        first.expect("RegisterBlock", BLOCK, words=[1, 2, 3, 4])
        first.expect("Point", {"name": "plant.integer"}, integer=1)

        late = self.subscriber().connected()
        late.expect("RegisterBlock", BLOCK, words=[1, 2, 3, 4], quality=QUALITY["good"])
        late.expect("RegisterBlock", COILS, words=[0b101, 1])
        for point in POINTS:
            late.expect("Point", {"name": point["name"]}, quality=QUALITY["good"])
        late.expect("Point", {"name": "plant.integer"}, integer=1)
        samples = late.of("RegisterBlock", **BLOCK)
        self.assertEqual(samples[0]["words"], [1, 2, 3, 4])  # nothing older before it
        self.assertEqual(len({each["seq"] for each in samples}), len(samples))

    def test_quality_turns_when_the_device_dies_and_back(self):
        fast = self.start(points=POINTS[:1])
        fast.expect("RegisterBlock", BLOCK, words=REGISTERS, quality=QUALITY["good"])
        up = {"gateway": "interop", "routes_up": 2, "routes_total": 2}
        fast.expect("GatewayStatus", {"gateway": "interop"}, **up)
        before = fast.latest("RegisterBlock", **BLOCK)["source_ns"]
        self.device.kill()
        lost = fast.expect("RegisterBlock", BLOCK, words=REGISTERS, quality=QUALITY["comm error"])
        self.assertGreaterEqual(lost["source_ns"], before)
        fast.expect("Point", {"name": "plant.integer"}, quality=QUALITY["comm error"], integer=REGISTERS[0])
        fast.expect("GatewayStatus", {"gateway": "interop"}, routes_up=0)
        self.device = self.start_device(1, 1, "--set", "hr:10=5")
        back = fast.expect("RegisterBlock", BLOCK, words=[5, 0, 0, 0], quality=QUALITY["good"])
        self.assertGreater(back["source_ns"], lost["source_ns"])
        fast.expect("GatewayStatus", {"gateway": "interop"}, **up)

    def test_messages_of_a_serial_line(self):
        fast = self.start(lines=[{"name": "text", "device": str(self.folder / "scale"), "protocol": "general-purpose",
                                  "parity": "none", "general_purpose": {"end_code": "cr-lf", "messages": [SCALE]}}])
        fast.connected()
        scale = TextDevice(self, "scale")
        wait_for("the line is open", lambda: "text: " in self.gateway.log and self.gateway.log.count("is open") == 2)
        for spoken, name in ((b"GS,+00123.4kg", "weighing"), (b"OL,-----.-kg", "")):
            scale.say(spoken + b"\r\n")
            sample = wait_for(f"{spoken}", lambda spoken=spoken: fast.of("SerialMessage", content=list(spoken)))[0]
            self.assertEqual([sample["gateway"], sample["line"], sample["way"], sample["name"]],
                             ["interop", "text", RECEIVED, name])
            self.assertEqual(bool(sample["reason"]), not name)
        self.assertEqual([each["seq"] for each in fast.of("SerialMessage")], [1, 2])
        wait_for("MODBUS TCP reads the weight", lambda: self.client.holding(400, 2) == [1234, 0])
        fast.expect("RegisterBlock", {"route": "weighing.weight"}, words=[1234, 0], quality=QUALITY["good"])

    def test_only_the_partition_is_heard(self):
        heard = self.start()
        other = Subscriber(self, {**self.gateway.dds, "partition": "elsewhere"})
        heard.expect("RegisterBlock", BLOCK, words=REGISTERS)
        pattern = Subscriber(self, {**self.gateway.dds, "partition": "interop.*"})
        pattern.expect("RegisterBlock", BLOCK, words=REGISTERS)
        holds("nothing crosses a partition", lambda: other.read() or not other.samples, 1)

    def test_more_instances_than_fast_dds_keeps_by_itself(self):
        routes = [route(f"one.r{i}", "holding", i, f"D{i}", 1, period_ms=500) for i in range(60)]
        fast = self.start(routes)
        for i in range(60):
            fast.expect("RegisterBlock", {"route": f"one.r{i}"}, quality=QUALITY["good"],
                        words=[REGISTERS[i - 10] if 10 <= i < 14 else 0])


if __name__ == "__main__":
    main()
