"""General-purpose lines at 230400 bit/s, messages back to back: none is lost, and a reader that is too slow is told."""

import os
import signal
import threading
import time

from support import main, wait_for
from text_device import BUFFERS_FULL, ERROR, ERRORS, LOST, RECEIVED, REFUSED, STATUS, GeneralPurpose


class GeneralPurposeSpeedTest(GeneralPurpose):
    def start_fast(self, **received):
        """230400 bit/s; the number of each message goes to D200, its text to D100 and to DDS."""
        self.start({"messages": [{"name": "count", "pattern": "N{n:number}", "plc": "main",
                                  "fields": [{"name": "n", "device": "D200"}]}],
                    "received": [{"name": "raw", "plc": "main", "device": "D100", "count": 10, **received}]},
                   baud_rate=230400)

    def say_paced(self, messages, packet_s=0.002):
        """One behind the other as fast as 230400 bit/s carry them, in packets as a port delivers them."""
        data = b"".join(messages)
        started = time.monotonic()
        sent = 0
        while sent < len(data):
            due = min(len(data), int((time.monotonic() - started) * 230400 / 10))
            self.device.say(data[sent:due])
            sent = due
            time.sleep(packet_s)

    def test_back_to_back_none_is_lost(self):
        """In bursts that no DDS reader is too slow for: each message is looked at there."""
        self.start_fast()
        watch = self.gateway.watch().connected()
        burst, most = 200, 5000
        texts = [f"N{i:05d}" for i in range(1, most + 1)]
        took = 0
        for first in range(0, most, burst):
            started = time.monotonic()
            self.say_paced(text.encode() + b"\r" for text in texts[first:first + burst])
            took += time.monotonic() - started
            wait_for("the burst is on DDS", lambda last=texts[first + burst - 1]: watch.messages("text", text=last))
        print(f"{most} messages in {took:.2f} s, {10 * 7 * most / took:.0f} bit/s", flush=True)
        heard = watch.messages("text")
        self.assertEqual([each["text"] for each in heard], texts)
        self.assertEqual([each["seq"] - heard[0]["seq"] for each in heard], list(range(most)))
        self.assertEqual(self.client.holding(200, 2), [most, 0])
        self.assertEqual(self.words(100, 10), texts[-1].encode())
        self.assertEqual(self.client.holding(STATUS, 8), [0, 0, 0, most, 0, 0, 0, 0])

    def test_without_a_pause_none_is_lost(self):
        self.start_fast()
        most = 5000
        self.say_paced(b"N%05d\r" % i for i in range(1, most + 1))
        self.wait_number(RECEIVED, most)
        self.assertEqual(self.client.holding(200, 2), [most, 0])
        self.assertEqual(self.client.holding(STATUS, 8), [0, 0, 0, most, 0, 0, 0, 0])

    def test_all_at_once_none_is_lost(self):
        """Faster than any line: what the driver holds is one read."""
        self.start_fast()
        most = 2000
        self.device.say(b"".join(b"N%05d\r" % i for i in range(1, most + 1)))
        self.wait_number(RECEIVED, most)
        self.assertEqual(self.client.holding(200, 2), [most, 0])
        self.assertEqual(self.client.holding(STATUS, 8), [0, 0, 0, most, 0, 0, 0, 0])

    def test_back_to_back_to_a_plc_program_that_is_too_slow(self):
        """It resets `ready` as fast as a client can: what it misses is counted and said, what it gets is whole."""
        self.start_fast(ready="M0")
        most = 3000
        texts = [b"N%05d" % i for i in range(1, most + 1)]
        speaker = threading.Thread(target=self.say_paced, args=([text + b"\r" for text in texts],), daemon=True)
        speaker.start()
        taken = []
        while speaker.is_alive() or self.client.coils(0) == [1]:
            if self.client.coils(0) == [1]:
                taken.append(self.words(100, 5))
                self.client.write_coil(0, False)
                time.sleep(0.01)
        self.wait_number(RECEIVED, most)
        lost = self.number(LOST)
        print(f"{len(taken)} of {most} taken, {lost} lost", flush=True)
        self.assertEqual(len(taken) + lost, most)
        self.assertGreater(lost, 0)
        self.assertEqual(taken, sorted(set(taken)))
        self.assertTrue(set(taken) <= set(texts))
        self.assertEqual((self.number(ERROR), self.number(ERRORS), self.number(REFUSED)), (BUFFERS_FULL, 0, 0))
        self.assertIn("received raw: all eight buffers are full", self.gateway.log)
        self.assertEqual(self.client.holding(200, 2), [most, 0])  # patterns do not wait for `ready`

    def test_a_dds_reader_that_is_too_slow_sees_the_gap(self):
        self.start_fast()
        watch = self.gateway.watch().connected()
        self.device.say(b"N00001\r")
        wait_for("the first one", lambda: watch.messages("text"))
        os.kill(watch.pid, signal.SIGSTOP)
        try:
            most = 3000
            self.say_paced(b"N%05d\r" % i for i in range(2, most + 1))
            self.wait_number(RECEIVED, most)
        finally:
            os.kill(watch.pid, signal.SIGCONT)
        wait_for("it goes on", lambda: watch.messages("text", text=f"N{most:05d}"))
        heard = watch.messages("text")
        self.assertLess(len(heard), most)
        first = heard[0]["seq"]
        self.assertEqual([each["seq"] - first for each in heard], [int(each["text"][1:]) - 1 for each in heard])
        self.assertEqual(self.number(LOST), 0)  # the gateway lost nothing


if __name__ == "__main__":
    main()
