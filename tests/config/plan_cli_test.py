#!/usr/bin/python3
"""`plc-gateway check` and `plc-gateway plan` about bus time: what lines need, which requests there are and why."""
import json
import pathlib
import tempfile
import unittest

from support import gateway


def route(name, first, count=1, period_ms=1000, station="pump", **more):
    return {"name": name, "station": station, "table": "holding", "first": first, "count": count, "plc": "a",
            "device": f"D{first}", "period_ms": period_ms, **more}


class BusTime(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="plcgw-plan-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, routes, station=None, **line):
        """A line at 9600 8N1: one character takes 1.04 ms."""
        path = self.folder / "plant.json"
        path.write_text(json.dumps({
            "plcs": [{"name": "a"}],
            "lines": [{"name": "line1", "device": "/dev/ttyS0", "baud_rate": 9600, "parity": "none", **line}],
            "stations": [{"name": "pump", "line": "line1", "unit": 1, **(station or {})}],
            "routes": routes, "state": {"folder": str(self.folder / "state")}}), encoding="utf-8")
        return path

    def plan(self, routes, *arguments, **options):
        answer = gateway("plan", self.write(routes, **options), *arguments)
        self.assertEqual((answer.returncode, answer.stderr), (0, ""))
        return answer.stdout

    def learn(self, *limits):
        (self.folder / "state").mkdir()
        (self.folder / "state" / "learned.json").write_text(json.dumps({"version": 1, "stations": [
            {"line": "line1", "unit": 1, "turnaround_us": 12500, "limits": {"holding": list(limits)}}]}))

    def test_check_says_what_each_route_needs(self):
        answer = gateway("check", self.write([route("speed", 0, 3), route("hours", 3, 1)]))
        self.assertEqual((answer.returncode, answer.stderr), (0, ""))
        correct, line, *rows = answer.stdout.splitlines()
        self.assertIn(" is correct: 1 PLC, 1 line, ", correct)
        # 8 + 13 characters, 3.5 between them and 5 ms
        self.assertEqual(line, "line1: 30.5 ms/s, 3.1 %")
        self.assertRegex(rows[0], r"^  speed +22\.9 ms/s +2\.3 %$")
        self.assertRegex(rows[1], r"^  hours +7\.6 ms/s +0\.8 %$")
        self.assertEqual(len(rows), 2)

    def test_a_line_that_needs_more_than_its_time_is_an_error_or_if_asked_a_warning(self):
        path = self.write([route("speed", 0, 10, 20), route("hours", 1000, 10, 100)])
        said = (r"line1 needs \d+ %: these periods are reachable: \d+ ms instead of 20 ms, \d+ ms instead of 100 ms\n$")
        answer = gateway("check", path)
        self.assertEqual(answer.returncode, 1)
        self.assertRegex(answer.stderr, rf"^{path}: {said}")
        answer = gateway("check", "--overload", "warn", path)
        self.assertEqual(answer.returncode, 0)
        self.assertRegex(answer.stderr, rf"^{path}: warning: {said}")
        self.assertIn(" is correct: ", answer.stdout)
        self.assertEqual(gateway("check", "--overload", "never", path).returncode, 2)

    def test_the_periods_that_are_reachable_are_reached(self):
        answer = gateway("check", self.write([route("speed", 0, 10, 20)]))
        reachable = int(answer.stderr.split("reachable: ")[1].split()[0])
        self.assertEqual(gateway("check", self.write([route("speed", 0, 10, reachable)])).returncode, 0)
        self.assertEqual(gateway("check", self.write([route("speed", 0, 10, reachable - 1)])).returncode, 1)

    def test_requests_are_shown_with_their_routes(self):
        self.assertEqual(self.plan([route("speed", 0, 3), route("hours", 5, 1)]).splitlines(),
                         ["line1: 34.7 ms/s, 3.5 %",
                          "  pump (unit 1), turnaround 5.0 ms assumed",
                          "    holding 0-5 every 1000 ms, 34.7 ms, 34.7 ms/s: speed hours"])

    def test_why_each_split_is_where_it_is(self):
        rows = [
            ([route("a", 0), route("b", 50)], {}, "a gap of 49 is dearer than a request: together they cost"),
            ([route("a", 0, 100), route("b", 100, 100)], {}, "together 200, more than the largest block"),
            ([route("a", 0, 4), route("b", 4, 4)], {"max_registers": 6}, "together 8, more than the largest block"),
            ([route("a", 0), route("b", 1)], {"merge": "off"}, "merge is off"),
            ([route("a", 0), route("b", 2)], {"merge": "adjacent"}, "a gap of 1, and merge is adjacent"),
            ([route("a", 0, 1, 100), route("b", 1, 20, 5000)], {},
             "another period: together they cost 65.9 ms every 100 ms"),
        ]
        for routes, keys, why in rows:
            with self.subTest(why):
                self.assertIn(f"      split: {why}", self.plan(routes, station=keys))

    def test_what_a_station_refused_and_its_measured_turnaround(self):
        self.learn({"what": "gap", "first": 4, "end": 6, "request_first": 0, "request_end": 10,
                    "reason": "exception 02 (illegal data address)", "since_ns": 1700000000 * 10**9})
        shown = self.plan([route("a", 0, 4), route("b", 6, 4)])
        self.assertIn("turnaround 12.5 ms measured", shown)
        limit = "holding 4-5, wanted by no route, is left out"
        self.assertIn("    holding 0-3 every 1000 ms", shown)
        self.assertIn(f"      split: refused by the station on 2023-11-14 22:13 (exception 02 (illegal data address)): "
                      f"{limit}\n", shown)
        self.assertIn(f"    learned on 2023-11-14 22:13: {limit} (exception 02 (illegal data address))\n", shown)

    def test_a_damaged_state_file_is_reported_and_ignored(self):
        (self.folder / "state").mkdir()
        for text in ("", "{", "[]", '{"version": 2, "stations": []}', '{"version": 1, "stations": [{"line": 1}]}',
                     '{"version": 1, "stations": [{"line": "line1", "unit": 1, "limits": {"holding": [{}]}}]}'):
            (self.folder / "state" / "learned.json").write_text(text)
            with self.subTest(text):
                answer = gateway("plan", self.write([route("a", 0)]))
                self.assertEqual(answer.returncode, 0)
                self.assertIn("learned.json is damaged and ignored: ", answer.stderr)
                self.assertIn("holding 0 every 1000 ms", answer.stdout)

    def test_a_single_line_and_names_that_are_none(self):
        self.assertIn("line1: ", self.plan([route("a", 0)], "line1"))
        answer = gateway("plan", self.write([route("a", 0)]), "line2")
        self.assertEqual((answer.returncode, answer.stderr), (1, "line2 is no line that polls stations\n"))
        path = self.write([route("a", 0)], parity="mark")
        answer = gateway("plan", path)
        self.assertEqual((answer.returncode, answer.stdout), (1, ""))
        self.assertIn("/lines/0/parity", answer.stderr)


if __name__ == "__main__":
    unittest.main()
