"""General-purpose lines: a scale, a bar-code reader and a device that only answers, each a text device on a pty."""

import select
import socket

from support import PATIENCE, holds, main, wait_for
from text_device import (BUFFERS_FULL, ERROR, LOST, RECEIVED, REFUSED, SENT, STATUS, UNANSWERED, WAITING, Answering,
                         GeneralPurpose)

SCALE = {"name": "weighing", "pattern": "{state:text(2)},GS,{weight:+#####.#}kg", "plc": "main",
         "fields": [{"name": "weight", "device": "D200", "type": "int32", "decimals": 1},
                    {"name": "state", "device": "D202", "type": "text", "characters": 2}]}


class GeneralPurposeTest(GeneralPurpose):
    def test_a_scale(self):
        self.start({"end_code": "cr-lf", "messages": [SCALE]})
        watch = self.gateway.watch()
        watch.expect("weighing.weight", quality="never read")

        self.device.say(b"ST,GS,+00123.4kg\r\n")
        watch.expect("weighing.weight", quality="good", area="D", first=200, values=[1234, 0])
        watch.expect("weighing.state", quality="good", values=[ord("S") | ord("T") << 8])
        self.assertEqual(self.client.holding(200, 3), [1234, 0, 0x5453])
        self.assertEqual([each["text"] for each in watch.messages("text", name="weighing")], ["ST,GS,+00123.4kg"])

        self.device.say(b"US,GS,-00000.2k")
        self.device.say(b"g\r\n")
        watch.expect("weighing.weight", values=[0xFFFE, 0xFFFF])

        # What does not fit is counted and shown, and changes nothing.
        for refused in (b"OL,GS,+-----.-kg\r\n", b"ST,GS,+00123.4lb\r\n"):
            self.device.say(refused)
        self.wait_number(REFUSED, 2)
        self.assertEqual(self.client.holding(200, 2), [0xFFFE, 0xFFFF])
        shown = wait_for("two refused messages", lambda: [m for m in watch.messages("text") if m["refused"]][1:])
        self.assertEqual(shown[0]["text"], "ST,GS,+00123.4lb")
        wait_for("the log shows it", lambda: "no pattern takes the message OL,GS,+-----.-kg: weighing: "
                 in self.gateway.log)
        self.assertEqual(self.gateway.log.count("no pattern takes"), 1)  # not for each

        self.device.unplug()
        watch.expect("weighing.weight", quality="comm error", values=[0xFFFE, 0xFFFF])

    def test_a_scale_that_falls_silent(self):
        self.start({"messages": [{**SCALE, "longest_silence_ms": 300}]})
        watch = self.gateway.watch().connected()

        def qualities():  # a good value lasts for 0.3 s: a slow machine sees it when it is stale already
            return [each["quality"] for each in watch.of("weighing.weight") if each["values"] == [10, 0]]
        for times in (1, 2):
            self.device.say(b"ST,GS,+00001.0kg\r")
            wait_for(lambda: f"good, then stale: {qualities()}",
                     lambda times=times: qualities() == ["good", "stale"] * times)

    def test_a_reader_that_is_too_slow(self):
        self.start({"received": [{"name": "codes", "plc": "main", "device": "D100", "count": 20, "ready": "M0"}]})
        codes = [b"%013d" % (4006381333931 + i) for i in range(11)]
        self.device.say(b"".join(code + b"\r" for code in codes[:9]))
        self.wait_number(RECEIVED, 9)
        self.assertEqual(self.client.coils(0), [1])
        self.assertEqual(self.words(100, 20), codes[0])
        self.assertEqual(self.number(WAITING), 8)
        self.assertEqual(self.number(ERROR), 0)

        self.device.say(codes[9] + b"\r")  # one too many
        self.wait_number(LOST, 1)
        self.assertEqual(self.number(ERROR), BUFFERS_FULL)
        self.assertIn("received codes: all eight buffers are full", self.gateway.log)

        for code in codes[1:9]:
            self.client.write_coil(0, False)
            wait_for(f"{code}", lambda code=code: self.words(100, 20) == code and self.client.coils(0) == [1])
        self.client.write_coil(0, False)
        self.device.say(codes[10] + b"\r")
        wait_for("the next one", lambda: self.words(100, 20) == codes[10])
        self.assertEqual(self.number(LOST), 1)
        self.assertEqual(self.number(ERROR), BUFFERS_FULL)  # until the channel is reset
        self.client.write_coil(90, True)
        self.wait_number(ERROR, 0)

    def test_stopped_as_the_plc_until_the_channel_is_reset(self):
        self.start({"received": [{"name": "codes", "plc": "main", "device": "D100", "count": 20, "ready": "M0",
                                  "when_full": "stop"}]})
        self.device.say(b"".join(b"%d\r" % i for i in range(10)))
        self.wait_number(LOST, 1)
        for i in range(1, 9):
            self.client.write_coil(0, False)
            wait_for(f"{i}", lambda i=i: self.words(100, 20) == b"%d" % i)
        self.client.write_coil(0, False)
        self.device.say(b"lost\r")
        self.wait_number(LOST, 2)
        self.client.write_coil(90, True)
        self.wait_number(ERROR, 0)
        self.device.say(b"heard\r")
        wait_for("reception goes on", lambda: self.words(100, 20) == b"heard")

    def test_every_byte_comes_through(self):
        """Damaged characters are marked with FF by the driver: a whole FF must not look like one."""
        self.start({"end_code": "etx", "start_code": "stx",
                    "received": [{"name": "raw", "plc": "main", "device": "D100", "count": 140}]})
        data = bytes(b for b in range(256) if b not in (2, 3)) + b"\xff\x00A\xff\xff"
        self.device.say(b"\x02" + data + b"\x03")
        wait_for(lambda: f"{data!r}, not {self.words(100, 140)!r}", lambda: self.words(100, 140) == data)
        self.assertEqual(self.number(ERROR), 0)

    def test_a_device_that_only_answers(self):
        self.start({"messages": [{"name": "first", "pattern": "{value:number}", "plc": "main", "answer_to": "ask.1",
                                  "fields": [{"name": "value", "device": "D200", "decimals": 2}]},
                                 {"name": "second", "pattern": "{value:number}", "plc": "main", "answer_to": "ask.2",
                                  "fields": [{"name": "value", "device": "D202", "type": "float32"}]}],
                    "sends": [{"name": f"ask.{i}", "text": f"R{i}", "period_ms": 100, "answer": True}
                              for i in (1, 2)]}, response_timeout_ms=300, retries=0)
        watch = self.gateway.watch()
        device = Answering(self.device, {b"R1": b"1.25\r", b"R2": b"-2.5\r"})
        device.start()
        self.addCleanup(device.end)
        watch.expect("first.value", quality="good", values=[125, 0])
        watch.expect("second.value", quality="good", values=[0, 0xC020])
        wait_for("both are asked again", lambda: min(device.asked.count(b"R1"), device.asked.count(b"R2")) > 3)
        self.assertEqual(self.number(REFUSED), 0)

        device.silent = True
        watch.expect("first.value", quality="comm error", values=[125, 0])
        wait_for("that is counted", lambda: self.number(UNANSWERED) > 1)
        self.assertIn("send ask.1 fails: ", self.gateway.log)
        device.silent = False
        watch.expect("first.value", quality="good")
        watch.expect("second.value", quality="good")

    def test_sent_when_a_bit_comes_on(self):
        self.start({"start_code": "stx", "end_code": "etx", "sends": [
            {"name": "words", "plc": "main", "device": "D400", "count": 10, "trigger": "M20"},
            {"name": "zero", "plc": "main", "text": "Z\\x05<CR>", "trigger": "M21"}]})
        watch = self.gateway.watch().connected()
        self.client.write_registers(400, [5, *(a | b << 8 for a, b in (b"HE", b"LL", b"O\0"))])
        self.client.write_coil(20, True)
        self.assertEqual(self.device.hear(b"\x03"), b"\x02HELLO\x03")
        wait_for("it is on DDS", lambda: watch.messages("text", way="sent", name="words", text="HELLO"))
        self.client.write_coil(21, True)
        self.assertEqual(self.device.hear(b"\x03"), b"\x02Z\x05\r\x03")
        holds("nothing more is sent", lambda: not select.select([self.device.ours], [], [], 0)[0], 0.3)
        self.wait_number(SENT, 2)

        self.client.write_register(400, 0x10000 - 3)  # negative: without an end code
        self.client.write_coil(20, False)
        self.client.write_coil(20, True)
        self.assertEqual(self.device.hear(b"HEL"), b"\x02HEL")
        self.client.write_register(400, 100)  # more than the words hold
        self.client.write_coil(20, False)
        self.client.write_coil(20, True)
        self.wait_number(UNANSWERED, 1)
        self.assertIn("send words fails: ", self.gateway.log)

    def test_silence_ends_a_message(self):
        self.start({"end_code": "silence", "end_silence_us": 50_000,
                    "received": [{"name": "raw", "plc": "main", "device": "D100", "count": 10, "ready": "M0"}]})
        for message in (b"one\r\n", b"two\xff\x00"):
            self.device.say(message)
            wait_for(f"{message}", lambda message=message: self.words(100, 10) == message)
            self.client.write_coil(0, False)
        self.assertEqual(self.number(RECEIVED), 2)

    def test_behind_a_device_server(self):
        server = socket.create_server(("127.0.0.1", 0))
        self.addCleanup(server.close)
        server.settimeout(PATIENCE)
        gateway = self.start_gateway(self.configuration(lines=[
            {"name": "text", "host": "127.0.0.1", "port": server.getsockname()[1], "protocol": "general-purpose",
             "general_purpose": {"end_code": "cr-lf", "messages": [SCALE],
                                 "sends": [{"name": "ask", "text": "W", "period_ms": 200, "answer": True}]}}]))
        watch = gateway.watch()
        connection, _ = server.accept()
        self.addCleanup(connection.close)
        connection.settimeout(PATIENCE)
        for turn, weight in ((b"+00123.4", 1234), (b"-00000.1", 0xFFFF)):
            self.assertEqual(connection.recv(3), b"W\r\n")
            connection.sendall(b"ST,GS," + turn + b"kg\r\n")
            wait_for(f"{weight}", lambda weight=weight: watch.latest("weighing.weight").get("values", [0])[0] == weight)
        connection.close()
        watch.expect("weighing.weight", quality="comm error")

    def test_local_echo_is_no_message(self):
        self.start({"received": [{"name": "raw", "plc": "main", "device": "D100", "count": 10}],
                    "sends": [{"name": "tell", "text": "T", "plc": "main", "trigger": "M20"}]}, local_echo="on")
        self.client.write_coil(20, True)
        self.assertEqual(self.device.hear(b"\r"), b"T\r")
        self.device.say(b"T\r" + b"T\r")  # its echo, then a device that says the same
        self.wait_number(RECEIVED, 1)
        holds("nothing more comes", lambda: self.number(RECEIVED) == 1, 0.3)


if __name__ == "__main__":
    main()
