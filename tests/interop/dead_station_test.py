"""A device dies: the two others on its line keep their pace, and it comes back by itself."""

import time

from support import InteropTest, main, route, serial_line, station, wait_for

PERIOD = 0.2
ROUTES = {"one": 3, "two": 2, "three": 2}  # per device
MEASURED = 15  # seconds
TRIES = 3


class DeadStationTest(InteropTest):
    def test_others_keep_their_pace(self):
        for attempt in range(1, TRIES + 1):
            self.start()
            before = self.measure("before")
            # A machine that is too busy for the nominal pace cannot measure a change of it either.
            if all(abs(period - PERIOD) <= 0.05 * PERIOD for period in before):
                break
            print(f"try {attempt} of {TRIES}: the nominal period of {PERIOD * 1000:.0f} ms was not there to begin with")
            if attempt < TRIES:
                self.doCleanups()

        mine = self.watch.expect("three.first", values=[333], quality="good")
        self.three.kill()
        after = self.measure("after the death of device three")
        for name, was, now in zip(("one", "two"), before, after):
            self.assertLessEqual(abs(now - was), 0.1 * was, f"period of device {name}: {was * 1000:.1f} ms before, "
                                                            f"{now * 1000:.1f} ms after")
        self.dead_one_is_marked_and_keeps_its_values(mine)
        self.dead_one_comes_back()
        self.assertTrue(self.gateway.running())

    def start(self):
        self.start_bus(3)
        self.one = self.start_device(1, 1)
        self.two = self.start_device(2, 2)
        self.three = self.start_device(3, 3, "--set", "hr:0=333", "hr:1=334")
        devices = {"one": "D100", "two": "D110", "three": "D120"}
        routes = [route(f"{name}.{place}", "holding", i, f"D{int(devices[name][1:]) + i}", period_ms=int(PERIOD * 1000))
                  for name, count in ROUTES.items() for i, place in enumerate(("first", "second", "third")[:count])]
        self.gateway = self.start_gateway(self.configuration(
            lines=[serial_line(self.folder / "line", response_timeout_ms=300, retries=1)],
            # One request for each route: the devices count requests.
            stations=[station(name, unit, merge="off") for name, unit in (("one", 1), ("two", 2), ("three", 3))],
            routes=routes))
        self.watch = self.gateway.watch()
        for each in routes:
            self.watch.expect(each["name"], quality="good")

    def measure(self, when):
        """Achieved periods of the devices one and two, from the requests that they themselves count."""
        def look():
            return [(time.monotonic(), device.answers()) for device in (self.one, self.two)]

        began = look()
        time.sleep(MEASURED)
        periods = [(t1 - t0) / (n1 - n0) * routes for (t0, n0), (t1, n1), routes
                   in zip(began, look(), (ROUTES["one"], ROUTES["two"]))]
        print(f"{when}: " + ", ".join(f"{period * 1000:.1f} ms" for period in periods), flush=True)
        return periods

    def dead_one_is_marked_and_keeps_its_values(self, good):
        for name, value in (("three.first", 333), ("three.second", 334)):
            self.watch.expect(name, quality="comm error", values=[value])
        marked = self.watch.latest("three.first")
        self.assertGreaterEqual(marked["source_ns"], good["source_ns"])
        self.assertLess(marked["source_ns"] / 1e9, time.time() - MEASURED + 1, "its source time stood still")
        self.assertEqual(self.gateway.client().holding(120, 2), [333, 334])
        for name in ("one.first", "one.third", "two.second"):
            self.assertEqual(self.watch.latest(name)["quality"], "good")

    def dead_one_comes_back(self):
        back = time.monotonic()
        three = self.start_device(3, 3, "--set", "hr:0=444", "hr:1=445")
        self.watch.expect("three.first", quality="good", values=[444], seconds=40)
        print(f"back after {time.monotonic() - back:.1f} s")
        self.watch.expect("three.second", quality="good", values=[445])
        self.assertEqual(self.gateway.client().holding(120, 2), [444, 445])
        then = three.answers()
        wait_for("its old pace", lambda: three.answers() >= then + 10, seconds=3)


main()
