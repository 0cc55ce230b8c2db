"""What a network engineer sees of our DDS traffic: tshark names topics and types, and reads keys and disposals."""

import hashlib
import struct

from fastdds import Publisher, Subscriber
from support import InteropTest, main, route, serial_line, station, wait_for
from wireshark import Capture, skip_unless_capturing

KEYS = {"RegisterBlock": ("gateway", "route", "area", "first"), "Point": ("gateway", "name"),
        "GatewayStatus": ("gateway", "member"), "PortStatus": ("gateway", "port"), "DeviceStatus": ("gateway", "device")}


def key_hash(*key):
    """Of strings and uint32s: their CDR in network order, by MD5 when it is longer than 16 bytes."""
    data = b""
    for each in key:
        data += bytes(-len(data) % 4)
        data += struct.pack(">I", each) if isinstance(each, int) else struct.pack(">I", len(each) + 1) + each.encode() + b"\0"
    return hashlib.md5(data).digest() if len(data) > 16 else data.ljust(16, b"\0")


class WiresharkTest(InteropTest):
    def finished(self, capture):
        """Ends the capture; nothing of it may be malformed."""
        capture.complete()
        self.assertEqual(capture.decoded("_ws.malformed or _ws.expert.severity == error", "text").decode(), "")
        return capture.samples()

    def test_samples_of_the_daemon(self):
        self.start_bus(2)
        self.start_device(1, 1, "--set", "hr:10=4660")
        configuration = self.configuration(
            lines=[serial_line(self.folder / "line")], stations=[station("one", 1)],
            routes=[route("one.registers", "holding", 10, "D200", 4, period_ms=100)],
            points=[{"name": "plant.integer", "plc": "main", "device": "D200", "type": "uint16"}])
        capture = Capture(self, configuration["dds"]["domain"])
        gateway = self.start_gateway(configuration)
        fast = Subscriber(self, gateway.dds)
        block = fast.expect("RegisterBlock", {"route": "one.registers"}, words=[4660, 0, 0, 0])
        fast.expect("Point", {"name": "plant.integer"}, integer=4660)
        fast.connected()
        wait_for("a sample of each topic", lambda: all(fast.of(name) for name in KEYS))
        gateway.stop()

        samples = [each for each in self.finished(capture) if each.data]
        self.assertLessEqual(set(KEYS), {each.name for each in samples})
        for each in samples:
            with self.subTest(topic=each.name):
                self.assertEqual(each.type, f"plcgw::v1::{each.name}")
                self.assertIn("CDR_LE (0x0001)", each.encapsulation)  # XCDR1, little-endian
                self.assertIsNone(each.status)  # no status info: alive
        for name in {each.name for each in samples} & set(KEYS):
            seen = {each.key_hash for each in samples if each.name == name}
            wait_for(f"Fast DDS has heard the same instances of {name}", lambda name=name, seen=seen: seen == {
                key_hash(*(sample[key] for key in KEYS[name])) for sample in fast.of(name)})
        words = struct.pack("<I4H", 4, *block["words"])
        self.assertTrue(any(each.data.rstrip(b"\0").endswith(words.rstrip(b"\0")) for each in samples
                            if each.name == "RegisterBlock"))

    def test_a_disposal_says_so_and_whose_it_is(self):
        dds = self.configuration()["dds"]
        capture = Capture(self, dds["domain"])
        publisher = Publisher(self, dds, "plant", 3)
        fast = Subscriber(self, dds)
        keys = [{"gateway": "plant", "route": f"peer.{i}", "area": "holding", "first": i} for i in range(3)]
        for key in keys:
            fast.expect("RegisterBlock", key, instance="alive")
        publisher.dispose_next()
        fast.expect("RegisterBlock", keys[0], instance="disposed")
        wait_for("the others stay", lambda: all(fast.latest("RegisterBlock", **key)["instance"] == "alive"
                                                for key in keys[1:]))
        publisher.orders.close()
        publisher.wait()

        ended = [each for each in self.finished(capture) if each.status is not None]
        disposals = [each for each in ended if each.says("Disposed: Set")]
        self.assertEqual({each.key_hash for each in disposals}, {key_hash(*keys[0].values())})
        self.assertEqual({(each.name, each.type) for each in disposals},
                         {("RegisterBlock", "plcgw::v1::RegisterBlock")})
        self.assertTrue(any(each.says("Unregistered: Set") for each in ended if each.key_hash == disposals[0].key_hash))


if __name__ == "__main__":
    skip_unless_capturing("wireshark_test")
    main()
