"""Writes of a foreign client, on Fast DDS, and what the built daemon answers."""

import time

from fastdds import (BITS, DENIED, DEVICE_ERROR, EXPIRED, INTEGER, NOT_FOUND, OK, REAL, REJECTED, SENT, TIMEOUT, Requests,
                     Subscriber)
from support import InteropTest, main, route, serial_line, station, wait_for
from text_device import TextDevice

ILLEGAL_ADDRESS = 2
BEYOND = 40000  # the device has no such register
POINTS = [{"name": "memory", "plc": "main", "device": "D500", "type": "uint16", "writable": True},
          {"name": "speed", "plc": "main", "device": "D200", "type": "int16", "scale": 0.5, "writable": True},
          {"name": "fixed", "plc": "main", "device": "D501", "type": "uint16"}]

class FastDdsWritesTest(InteropTest):
    def start(self, writes=True, timeout=2000):
        self.start_bus(2)
        self.device = self.start_device(1, 1, "--set", "hr:0=1")
        self.gateway = self.start_gateway(self.configuration(
            lines=[serial_line(self.folder / "line", response_timeout_ms=timeout, retries=0)],
            stations=[station("one", 1)], points=POINTS, dds={"writes": writes},
            routes=[route("one.set", "holding", 0, "D200", 4, direction="write"),
                    route("one.coils", "coil", 0, "M0", 20, direction="write"),
                    route("one.beyond", "holding", BEYOND, "D300", 1, direction="write"),
                    route("one.read", "holding", 100, "D400", 1, period_ms=200)]))
        self.client = self.gateway.client()
        self.requests = Requests(self, self.gateway.dds, "fast")

    def ask(self, first, words, route_name="one.set", **more):
        return self.requests.send("WriteRequest", route=route_name, area="holding", first=first, count=len(words),
                                  words=words, **more)

    def point(self, name, **value):
        return self.requests.send("PointWriteRequest", name=name, **value)

    def expect(self, reply, result, **wanted):
        self.assertIsNotNone(reply)
        self.assertEqual(reply["result"], result, reply)
        self.assertEqual([reply[key] for key in ("client", "request_id", "gateway")],
                         [self.requests.client, self.requests.last_id, "interop"])
        self.assertLess(abs(time.time() - reply["done_ns"] / 1e9), 20)
        self.assertLessEqual(wanted.items(), reply.items())
        self.assertEqual(bool(reply["member"]), True)

    def test_registers_and_bits_are_in_the_device_when_the_reply_comes(self):
        self.start()
        self.expect(self.ask(0, [11, 12, 13, 65535]), OK, device_code=0)
        self.assertEqual(self.device.door.holding(0, 4), [11, 12, 13, 65535])
        self.assertEqual(self.client.holding(200, 4), [11, 12, 13, 65535])
        self.expect(self.ask(2, [77]), OK)  # a part of the block
        self.assertEqual(self.device.door.holding(0, 4), [11, 12, 77, 65535])
        self.expect(self.requests.send("WriteRequest", route="one.coils", area="coil", first=0, format=BITS, count=20,
                                       words=[0b101, 0b1000]), OK)
        self.assertEqual(self.device.door.coils(0, 20), [int(i in (0, 2, 19)) for i in range(20)])

    def test_points(self):
        self.start()
        fast = Subscriber(self, self.gateway.dds)
        self.expect(self.point("memory", kind=INTEGER, integer=4711), OK)
        self.assertEqual(self.client.holding(500), [4711])
        fast.expect("Point", {"name": "memory"}, integer=4711)
        self.expect(self.point("speed", kind=REAL, real=-10.5), OK)
        self.assertEqual(self.device.door.holding(0), [65536 - 21])
        fast.expect("Point", {"name": "speed"}, real=-10.5)

    def test_a_repeated_request_is_answered_and_not_executed_again(self):
        self.start()
        first = self.ask(0, [21])
        self.expect(first, OK)
        self.device.door.write_register(0, 5)
        self.client.write_register(500, 6)
        self.expect(self.ask(0, [21], request_id=self.requests.last_id), OK, detail=first["detail"])
        self.assertEqual(self.device.door.holding(0), [5])
        # Another client's request of that number is another request.
        other = Requests(self, self.gateway.dds, "other").send("WriteRequest", route="one.set", area="holding", first=0,
                                                               count=1, words=[22])
        self.assertEqual([other["result"], self.device.door.holding(0)], [OK, [22]])

    def test_refusals_say_why_and_change_nothing(self):
        self.start()
        self.expect(self.ask(0, [9], "one.unknown"), NOT_FOUND)
        self.expect(self.point("unknown", kind=INTEGER, integer=1), NOT_FOUND)
        self.expect(self.ask(100, [9], "one.read"), REJECTED)
        self.expect(self.ask(3, [9, 9]), REJECTED)  # beyond the route
        self.expect(self.point("fixed", kind=INTEGER, integer=1), REJECTED)
        self.expect(self.point("memory", kind=INTEGER, integer=65536), REJECTED)
        late = {"timeout_ms": 1000, "source_ns": time.time_ns() - 60 * 10**9}
        self.expect(self.ask(0, [9], **late), EXPIRED)
        self.expect(self.point("memory", kind=INTEGER, integer=9, **late), EXPIRED)
        self.assertEqual([self.client.holding(500, 2), self.device.door.holding(0)], [[0, 0], [1]])

    def test_the_reply_is_the_devices(self):
        self.start(timeout=300)
        reply = self.ask(BEYOND, [9], "one.beyond")
        self.expect(reply, DEVICE_ERROR, device_code=ILLEGAL_ADDRESS)
        self.assertTrue(reply["detail"])
        self.device.kill()
        wait_for("the station is known to be down", lambda: "it is probed from now on" in self.gateway.log)
        self.expect(self.ask(0, [9]), TIMEOUT, device_code=0)

    def test_nothing_is_written_where_it_is_not_allowed(self):
        self.start(writes=False)
        self.expect(self.ask(0, [9]), DENIED)
        self.expect(self.point("memory", kind=INTEGER, integer=9), DENIED)
        self.assertEqual([self.client.holding(500), self.device.door.holding(0)], [[0], [1]])

    def test_requests_to_another_gateway_get_no_reply(self):
        self.start()
        self.assertIsNone(self.ask(0, [9], gateway="elsewhere", longest_ms=2000))
        self.expect(self.ask(0, [10]), OK)
        wait_for("only the second was written", lambda: self.device.door.holding(0) == [10])

    def test_messages_are_sent_on_a_serial_line(self):
        readers = {name: TextDevice(self, name) for name in ("open", "closed")}

        def line(name, device, **more):
            received = [{"name": name, "plc": "main", "device": device, "count": 20}]
            return {"name": name, "device": str(readers[name].link), "protocol": "general-purpose", "parity": "none",
                    "general_purpose": {"end_code": "cr-lf", "received": received, **more}}
        self.gateway = self.start_gateway(self.configuration(
            lines=[line("open", "D600", dds_sends=True), line("closed", "D650")], dds={"writes": True}))
        wait_for("both lines are open", lambda: self.gateway.log.count("is open") == 2)
        self.requests = Requests(self, self.gateway.dds, "fast")
        fast = Subscriber(self, self.gateway.dds).connected()
        spoken = list(b"PRINT 7")

        def send(line, content, **more):
            return self.requests.send("SerialSendRequest", line=line, content=content, **more)
        self.expect(send("open", spoken), OK)
        self.assertEqual(readers["open"].hear(b"\r\n"), b"PRINT 7\r\n")
        sent = wait_for("what was sent is published", lambda: fast.of("SerialMessage", line="open", way=SENT))
        self.assertEqual([each["content"] for each in sent], [spoken])
        self.expect(send("open", spoken, request_id=self.requests.last_id), OK)
        self.expect(send("closed", spoken), DENIED)
        self.expect(send("nowhere", spoken), NOT_FOUND)
        self.expect(send("open", list(b"2")), OK)
        self.assertEqual(readers["open"].hear(b"\r\n"), b"2\r\n")  # the repetition was not sent again


if __name__ == "__main__":
    main()
