"""Wrong, damaged, cut and noisy answers, and a line that babbles: nothing of it reaches the memory."""

import random
import time

from faulty_device import FaultyDeviceTest, framed
from support import holds, main, wait_for

TIMEOUT_MS = 100


class LineFaultsTest(FaultyDeviceTest):
    def fails_and_recovers(self, misbehave, retries=0):
        """The fault is a communication error and leaves the values alone; the device recovers, and so do the routes."""
        self.start(response_timeout_ms=TIMEOUT_MS, retries=retries)
        self.device.misbehave = misbehave
        time.sleep(TIMEOUT_MS / 1000)  # good answers may be on their way
        self.device.offset = 500
        for name, first in (("pump.low", 0), ("pump.high", 1000)):
            self.watch.expect(name, quality="comm error", values=[first, first + 1])
        self.assertEqual((self.client.holding(100, 2), self.client.holding(110, 2)), ([0, 1], [1000, 1001]))
        self.device.misbehave = None
        self.expect_good(500)

    def test_silence(self):
        self.fails_and_recovers(lambda answer: [], retries=1)

    def test_short_outage_is_over_soon(self):
        self.start(period_ms=200, response_timeout_ms=TIMEOUT_MS, retries=1)
        self.device.misbehave = lambda answer: []
        time.sleep(3)
        self.device.misbehave = None
        self.device.offset = 500
        back = time.monotonic()
        for name, first in (("pump.low", 500), ("pump.high", 1500)):
            self.watch.expect(name, quality="good", values=[first, first + 1], seconds=8)
        print(f"both routes are good after {time.monotonic() - back:.1f} s")

    def test_answer_of_a_wrong_unit(self):
        self.fails_and_recovers(lambda answer: [(0, framed(b"\x02" + answer[1:-2]))])

    def test_answer_of_a_wrong_function(self):
        self.fails_and_recovers(lambda answer: [(0, framed(b"\x01\x04" + answer[2:-2]))])

    def test_answer_of_a_wrong_size(self):
        self.fails_and_recovers(lambda answer: [(0, framed(b"\x01\x03\x02" + answer[3:5]))])

    def test_bad_crc(self):
        self.fails_and_recovers(lambda answer: [(0, answer[:-1] + bytes([answer[-1] ^ 1]))], retries=1)

    def test_cut_answers(self):
        self.fails_and_recovers(lambda answer: [(0, answer[:random.randrange(1, len(answer))])])

    def test_echo_of_the_request_only(self):
        self.fails_and_recovers(lambda answer: [(0, framed(b"\x01\x03\x00\x00\x00\x02"))])

    def test_babbling_line(self):
        self.start(response_timeout_ms=TIMEOUT_MS, retries=0)
        for noise in (b"\x00" * 5, b"\xff" * 5, b"\x01\x03\x04\x00\x01", bytes(range(256))):
            with self.subTest(noise=noise[:5].hex(" ")):
                self.device.babble = noise
                for name in ("pump.low", "pump.high"):
                    self.watch.expect(name, quality="comm error")
                used = self.gateway.cpu_seconds()
                holds("the gateway serves", lambda: self.client.holding(100, 2) == [0, 1], seconds=0.5)
                self.assertLess(self.gateway.cpu_seconds() - used, 0.4)
                self.device.babble = None
                self.expect_good(0)

    def test_noise_before_and_after_a_good_answer_does_no_harm(self):
        self.start()
        noises = (b"\x00", b"\xff", b"\x00\xff\x00", b"\x01", b"\x01\x03", b"\x01\x03\x04\x00")
        for number, noise in enumerate(noises, 1):
            with self.subTest(noise=noise.hex(" ")):
                self.device.misbehave = lambda answer, n=noise: [(0, n), (0.002, answer)]
                self.device.offset = number
                self.expect_good(number)
                self.device.misbehave = lambda answer, n=noise: [(0, answer + n)]
                self.device.offset = 10 * number
                self.expect_good(10 * number)
        self.assertNotIn("does not answer", self.gateway.log)

    def test_answer_in_pieces(self):
        self.start()
        self.device.misbehave = lambda answer: [(0.004 * i, answer[i:i + 1]) for i in range(len(answer))]
        self.device.offset = 7
        self.expect_good(7)
        self.assertNotIn("does not answer", self.gateway.log)

    def silence_before_requests(self, baud_rate, least):
        # Requests are always due, and a slow test must not make a time-out of which the next request is a repetition.
        self.start(period_ms=10, response_timeout_ms=5000, baud_rate=baud_rate)
        wait_for("200 requests", lambda: len(self.device.silences) > 200)
        print(f"{baud_rate} bit/s: {min(self.device.silences) * 1000:.2f} ms of silence at least")
        self.assertGreaterEqual(min(self.device.silences), least)

    def test_silence_of_3_5_characters_between_frames(self):
        self.silence_before_requests(9600, 0.003645)

    def test_silence_of_1_75_ms_between_frames_above_19200(self):
        self.silence_before_requests(115200, 0.00175)


main()
