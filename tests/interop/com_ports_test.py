"""The COM ports of an FP7 on which it sends and hears by itself: flags of 4.1, words of PMGET (10.3.2), channel reset.

A general-purpose line and a client line stand for them. All is seen by MODBUS TCP: X and Y as they are, PMGET's words
as copies in DT."""

from mewtocol_station import bcc
from support import InteropTest, holds, main, wait_for
from text_device import TextDevice

RELAYS = 0x800                                  # coil of R0
READY, TRIGGER = RELAYS + 0, RELAYS + 1         # R0, R1
WAITS, COPIED, GENERAL, MASTER, DONE = 0x0, 0x4, 0x8, 0xC, 0x10       # X of COM.1
FAILED, SENDING, ASKING, RESET = 0x0, 0x8, 0xC, 0x10                  # Y of COM.1
PARAMETERS, MONITOR = 100, 150                  # DT100, DT150: PMGET of COM.1
BUFFER_OVERRUN, BUFFERS_FULL, SEND_COUNT = 1 << 8, 1 << 9, 1 << 9


def lines(channel, line):
    return [{"name": "fp7", "model": "FP7", "channels": [{"channel": channel, "line": line}]}]


class ComPortsTest(InteropTest):
    def start(self, line, com=1, routes=(), **more):
        first = 100 * com  # UM100: PMGET of COM.1
        copies = [{"name": f"pmget.{first + behind}", "from": {"plc": "fp7", "device": f"UM{first + behind}"},
                   "count": count, "plc": "fp7", "device": f"DT{target}"}
                  for behind, count, target in ((0, 26, PARAMETERS), (50, 7, MONITOR))]
        self.device = TextDevice(self)
        self.gateway = self.start_gateway(self.configuration(
            units=("fp7",), plcs=lines(com, "line"),
            lines=[{"name": "line", "device": str(self.device.link), **line}], routes=[*copies, *routes],
            dds={"blocks": [{"plc": "fp7", "device": "WX0", "count": 1}]}, **more))
        self.door = self.gateway.client()
        wait_for("the line is open", lambda: "is open" in self.gateway.log)

    def start_general(self, content, com=1, **line):
        self.start({"protocol": "general-purpose", "parity": "even", "baud_rate": 300, **line,
                    "general_purpose": {"received": [{"name": "codes", "plc": "fp7", "device": "DT200", "count": 40,
                                                      "ready": "R0"}], **content}}, com)

    def inputs(self):
        """The numbers of X that are on."""
        return [number for number, on in enumerate(self.door.discrete(0, 0x20)) if on]

    def outputs(self):
        return [number for number, on in enumerate(self.door.coils(0, 0x20)) if on]

    def wait_inputs(self, *numbers):
        wait_for(lambda: f"X{numbers}, not {self.inputs()}", lambda: self.inputs() == list(numbers))

    def wait_outputs(self, *numbers):
        wait_for(lambda: f"Y{numbers}, not {self.outputs()}", lambda: self.outputs() == list(numbers))

    def wait_monitor(self, *words):
        """D+2 to D+5: receive errors, their count, setting errors, the wrong parameter."""
        def monitor():
            return self.door.holding(MONITOR + 2, 4)
        wait_for(lambda: f"{words}, not {monitor()}", lambda: monitor() == list(words))

    def test_parameters_of_a_general_purpose_port(self):
        self.start_general({"start_code": "stx", "end_code": "silence", "end_silence_us": 12_340, "send_wait_ms": 50},
                           com=2, stop_bits=2, data_bits=7, baud_rate=9600)
        self.wait_inputs(GENERAL + 1)
        # 10.3.2: mode 8, station 1, 9600 bit/s, 7 bits, even, 2 stop bits, no RS/CS, 50 ms, STX, silence, 12.34 ms.
        expected = [8, 1, 5, 0, 2, 1, 0, 5000, 1, 2, 1234] + [0] * 15
        wait_for(lambda: f"{expected}, not {self.door.holding(PARAMETERS, 26)}",
                 lambda: self.door.holding(PARAMETERS, 26) == expected)
        self.assertEqual(self.door.holding(MONITOR, 7), [8, 232, 0, 0, 0, 0, 0])

    def test_messages_come(self):
        self.start_general({})
        watch = self.gateway.watch().connected()
        self.wait_inputs(GENERAL)
        self.device.say(b"ONE\r")
        flags = 1 << WAITS | 1 << COPIED | 1 << GENERAL  # for what stands for a scan
        wait_for("X4 comes on", lambda: [flags] in [each["values"] for each in watch.of("fp7.WX0")])
        self.wait_inputs(GENERAL)  # copied, and nothing waits any more
        self.assertEqual(self.door.coils(READY), [1])
        self.device.say(b"TWO\r")  # R0 is on: the message stays in its buffer
        self.wait_inputs(WAITS, GENERAL)
        holds("it waits", lambda: self.inputs() == [WAITS, GENERAL], 0.2)
        self.door.write_coil(READY, 0)
        self.wait_inputs(GENERAL)
        self.assertEqual(self.door.holding(200, 2), [3, ord("T") | ord("W") << 8])
        self.wait_monitor(0, 0, 0, 0)

    def test_errors_and_the_channel_reset(self):
        self.start_general({})
        self.device.say(b"x" * 5000 + b"\r")
        self.wait_monitor(BUFFER_OVERRUN, 0, 0, 0)
        self.device.say(b"".join(b"%d\r" % i for i in range(10)))  # the first is copied, eight wait, one is lost
        self.wait_monitor(BUFFER_OVERRUN | BUFFERS_FULL, 0, 0, 0)
        self.wait_inputs(WAITS, GENERAL)

        self.door.write_coil(RESET, 1)
        self.wait_inputs(GENERAL, DONE)
        self.wait_monitor(0, 0, 0, 0)
        self.device.say(b"A")  # half a message
        self.door.write_coil(READY, 0)
        holds("the buffers are empty", lambda: self.door.coils(READY) == [0], 0.2)
        self.door.write_coil(RESET, 0)
        self.wait_inputs(GENERAL)
        self.door.write_coil(RESET, 1)  # 4.1: reception is ended
        self.wait_inputs(GENERAL, DONE)
        self.door.write_coil(RESET, 0)
        self.device.say(b"B\r")
        wait_for("B alone", lambda: self.door.holding(200, 2) == [1, ord("B")])
        self.wait_inputs(GENERAL)

    def test_messages_go(self):
        self.start_general({"sends": [{"name": "tell", "plc": "fp7", "device": "DT300", "count": 60,
                                       "trigger": "R1"}]})
        self.wait_outputs()
        self.door.write_register(300, 110)  # 4 s at 300 bit/s with parity
        self.door.write_registers(301, [0x4141] * 55)
        self.door.write_coil(TRIGGER, 1)
        self.wait_outputs(SENDING)
        self.assertEqual(self.device.hear(b"\r"), b"A" * 110 + b"\r")
        self.wait_outputs()
        self.wait_monitor(0, 0, 0, 0)

        for count in (0, 500):  # nothing, and more than the words hold
            self.door.write_coil(TRIGGER, 0)
            self.door.write_register(300, count)
            self.door.write_coil(TRIGGER, 1)
            self.wait_outputs(FAILED)
            self.wait_monitor(0, 0, SEND_COUNT, 0)
            self.door.write_coil(RESET, 1)
            self.wait_outputs(RESET)
            self.wait_monitor(0, 0, 0, 0)
            self.door.write_coil(RESET, 0)
            self.wait_outputs()

    def test_a_reset_ends_sending(self):
        self.start_general({"sends": [{"name": "ask", "text": "W" * 60, "plc": "fp7", "trigger": "R1",
                                       "answer": True}]}, response_timeout_ms=60_000)
        self.door.write_coil(TRIGGER, 1)
        self.wait_outputs(SENDING)
        self.door.write_coil(RESET, 1)
        self.assertEqual((self.outputs(), self.inputs()), ([RESET], [GENERAL, DONE]))
        self.device.say(b"LATE\r")  # nobody waits for it: a message as any other
        wait_for("it is received", lambda: self.door.holding(200) == [4])

    def test_a_port_without_a_device(self):
        self.start_general({})
        self.device.unplug()
        wait_for("the line is lost", lambda: "was lost" in self.gateway.log)
        self.assertEqual(self.inputs(), [GENERAL])
        self.door.write_coil(RESET, 1)
        self.wait_inputs(GENERAL, DONE)

    def test_a_master(self):
        """A MEWTOCOL-COM client line: 7.3.1, XC, YC and Y0."""
        self.start({"protocol": "mewtocol-com", "baud_rate": 9600, "parity": "odd", "retries": 0,
                    "response_timeout_ms": 5000},
                   stations=[{"name": "other", "line": "line", "unit": 7}],
                   routes=[{"name": "other.word", "station": "other", "source": "DT5", "plc": "fp7", "device": "DT400",
                            "period_ms": 100}])
        request = f"%07#RDD0000500005{bcc('%07#RDD0000500005')}\r".encode()
        answer = f"%07$RD3412{bcc('%07$RD3412')}\r".encode()
        refusal = f"%07!61{bcc('%07!61')}\r".encode()
        wait_for("the mode", lambda: self.door.holding(PARAMETERS, 6) == [0, 1, 5, 1, 1, 0])
        self.assertEqual(self.door.holding(MONITOR, 7), [0, 232, 0, 0, 0, 0, 0])
        self.assertEqual(self.inputs(), [MASTER])

        self.assertEqual(self.device.hear(b"\r"), request)
        holds("it waits for the answer", lambda: self.outputs() == [ASKING], 0.2)
        self.device.say(answer)
        wait_for("the value", lambda: self.door.holding(400) == [0x1234])
        self.assertNotIn(FAILED, self.outputs())
        self.assertEqual(self.device.hear(b"\r"), request)
        self.device.say(refusal)
        wait_for("an abnormal end", lambda: FAILED in self.outputs())
        self.device.hear(b"\r")
        self.wait_outputs(ASKING)  # the next one is under way

        self.door.write_coil(RESET, 1)
        self.assertEqual((self.outputs(), self.inputs()), ([RESET], [MASTER, DONE]))
        self.device.say(answer)  # too late: nobody takes it for that to the next question
        self.assertEqual(self.device.hear(b"\r"), request)
        self.door.write_coil(RESET, 0)
        self.wait_outputs(ASKING)
        self.wait_inputs(MASTER)
        self.device.say(answer)
        wait_for("it is asked again", lambda: self.device.hear(b"\r") == request)


if __name__ == "__main__":
    main()
