"""A device that answers after its response timeout.

RTU has no transaction ids: a late answer looks like the answer to the next question of the same form. It must never be
stored as one.
"""

import random
import time

from faulty_device import FaultyDeviceTest
from support import holds, main

TIMEOUT = 0.3  # seconds


class LateAnswersTest(FaultyDeviceTest):
    def own_values_stay(self, misbehave, retries):
        """Repeated when the machine stood still: then a device was later than any that is tried here."""
        for turn in range(6):
            try:
                return self.try_own_values(misbehave, retries)
            except AssertionError:
                if self.device.stood_still < 0.05 or turn == 5:
                    raise
                print(f"the machine stood still for {self.device.stood_still:.2f} s: once more", flush=True)
                self.doCleanups()
                self.setUp()

    def try_own_values(self, misbehave, retries, seconds=3):
        self.start(response_timeout_ms=int(TIMEOUT * 1000), retries=retries)
        asked = self.device.asked
        self.device.misbehave = misbehave
        holds(lambda: f"each route has the values of its own registers, but {self.others()}",
              lambda: not self.others(), seconds)
        self.assertGreater(self.device.asked, asked + 3)
        self.device.misbehave = None
        self.expect_good(0)

    def others(self):
        """Values that belong to other registers, in the memory and in the samples so far."""
        found = []
        for name, own, register in (("pump.low", [0, 1], 100), ("pump.high", [1000, 1001], 110)):
            seen = [each["values"] for each in self.watch.of(name) if each["quality"] != "never read"]
            found += [(name, values) for values in [self.client.holding(register, 2), *seen] if values != own]
        return found

    @staticmethod
    def late(answer):
        """Each answer as late as the others, whatever else is asked meanwhile."""
        return [(1.5 * TIMEOUT, answer)]

    def one_after_the_other(self):
        """A device that reads its next request when it has answered the one before."""
        free = 0

        def misbehave(answer):
            nonlocal free
            free = max(time.monotonic(), free) + 1.4 * TIMEOUT
            return [(free - time.monotonic(), answer)]
        return misbehave

    @staticmethod
    def by_chance(answer):
        return [(random.uniform(0.1, 1.6) * TIMEOUT, answer)]

    @staticmethod
    def sometimes(answer):
        """Mostly in time, as a device with a busy processor."""
        return [(1.5 * TIMEOUT if random.random() < 0.2 else 0.01, answer)]

    def test_late_without_retries(self):
        self.own_values_stay(self.late, retries=0)

    def test_late_with_retries(self):
        self.own_values_stay(self.late, retries=2)

    def test_one_after_the_other_without_retries(self):
        self.own_values_stay(self.one_after_the_other(), retries=0)

    def test_one_after_the_other_with_retries(self):
        self.own_values_stay(self.one_after_the_other(), retries=2)

    def test_by_chance_without_retries(self):
        self.own_values_stay(self.by_chance, retries=0)

    def test_by_chance_with_retries(self):
        self.own_values_stay(self.by_chance, retries=2)

    def test_sometimes_without_retries(self):
        self.own_values_stay(self.sometimes, retries=0)

    def test_sometimes_with_retries(self):
        self.own_values_stay(self.sometimes, retries=2)


main()
