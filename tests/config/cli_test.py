#!/usr/bin/python3
"""`plc-gateway check` as its users see it: exit status, and what stands where."""
import os
import pathlib
import tempfile
import unittest

from support import MISTAKE, SHIPPED, Checked, gateway

SETTINGS = """{
  "plcs": [{ "name": "a", "program": ["LD M8411", "MOV K40000 D8409"] }],
  // the last mistake that is found stands first
  "lines": [
    { "name": "l", "device": "/dev/ttyS0", "baudrate": 9600,
      "parity": "mark" }
  ],
  "modbus_tcp": [{ "listen": "localhost", "other_units": "b" }],
  "log": { "level": 1 }
}
"""


class Check(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="plcgw-config-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def test_the_shipped_files_are_correct_without_a_warning(self):
        self.assertGreaterEqual(len(SHIPPED), 2)
        for path in SHIPPED:
            with self.subTest(path.name):
                answer = gateway("check", path)
                self.assertEqual((answer.returncode, answer.stderr), (0, ""))
                self.assertRegex(answer.stdout, r"^.+ is correct: \d+ PLCs?, \d+ lines?, .*\n")

    def test_an_empty_object_is_correct(self):
        path = self.write("a.json", "{}")
        answer = gateway("check", path)
        self.assertEqual((answer.returncode, answer.stderr), (0, ""))
        self.assertEqual(answer.stdout,
                         f"{path} is correct: 0 PLCs, 0 lines, 0 stations, 0 routes, 0 MODBUS TCP servers\n")

    def test_mistakes_go_to_stderr_with_file_line_and_pointer_in_the_order_of_lines(self):
        self.write("plant.json", SETTINGS)
        answer = gateway("check", "plant.json", cwd=self.folder)
        self.assertEqual(answer.returncode, 1)
        self.assertEqual(answer.stdout, "")
        *mistakes, total = answer.stderr.splitlines()
        self.assertEqual([MISTAKE.match(line)[0] for line in mistakes],
                         ["plant.json:2: warning: /plcs/0/program/1",
                          "plant.json:5: /lines/0/baudrate",
                          "plant.json:6: /lines/0/parity",
                          "plant.json:8: /modbus_tcp/0/listen",
                          "plant.json:8: /modbus_tcp/0/other_units",
                          "plant.json:9: /log/level"])
        self.assertEqual(mistakes[1], 'plant.json:5: /lines/0/baudrate is no known key: did you mean "baud_rate"?')
        self.assertRegex(total, r"^plant\.json: \d+ mistakes$")

    def test_a_fault_of_the_setup_program_is_a_warning(self):
        path = self.write("a.json", '{"plcs": [{"name": "a", "program": [\n'
                                    '"LD M8411",\n"MOV K7990 D8471",\n"MOV HC010 D8470"]}]}')
        answer = gateway("check", path)
        self.assertEqual(answer.returncode, 0)
        self.assertEqual(answer.stderr,
                         f"{path}:4: warning: /plcs/0/program/2 D7990-D8245 exceeds the range of this PLC, which ends "
                         "at D7999; the PLC runs without it and shows error 202 with detail 8470 in D8402 and D8403\n")
        self.assertIn("is correct: 1 PLC, ", answer.stdout)

    def test_program_file_is_relative_to_the_configuration_and_not_to_where_we_are(self):
        self.write("plant/setup.txt", "LD M8411\nMOV K0\n")
        self.write("setup.txt", "LD M8411\n")
        self.write("plant/a.json", '{"plcs": [{"name": "a", "program_file": "setup.txt"}]}')
        for where, name in ((self.folder, "plant/a.json"), (self.folder / "plant", "a.json"),
                            ("/", self.folder / "plant/a.json")):
            with self.subTest(str(name)):
                answer = gateway("check", name, cwd=where)
                self.assertEqual(answer.returncode, 1)
                self.assertEqual(answer.stderr.splitlines()[0],
                                 f"{name}:1: /plcs/0/program_file setup.txt line 2: MOV takes a constant and a device, "
                                 "for example MOV K10 D8411")

    def test_any_file_name(self):
        for name in ("with a blank.json", "Anlage Süd.json", "percent %s %n {}.json", "quote\".json"):
            with self.subTest(name):
                path = self.write(name, "{,}")
                answer = gateway("check", path)
                self.assertEqual(answer.returncode, 1)
                self.assertTrue(answer.stderr.startswith(f"{path}:1: is no JSON: "), answer.stderr)

    def test_files_that_cannot_be_read(self):
        locked = self.write("locked.json", "{}")
        locked.chmod(0)
        rows = [(self.folder / "absent.json", "No such file or directory"), ("", "No such file or directory"),
                (self.folder, "is a folder")]
        if os.geteuid() != 0:
            rows.append((locked, "Permission denied"))
        for path, why in rows:
            with self.subTest(str(path)):
                answer = gateway("check", path)
                self.assertEqual((answer.returncode, answer.stdout), (1, ""))
                self.assertEqual(answer.stderr.splitlines()[0], f"{path}: cannot be read: {why}")

    def test_usage(self):
        for arguments in (["check"], ["check", "a.json", "b.json"], ["check", "--quiet", "a.json"], ["chek", "a.json"],
                          []):
            with self.subTest(arguments):
                answer = gateway(*arguments)
                self.assertEqual(answer.returncode, 2)
                self.assertNotEqual(answer.stderr, "")
                self.assertEqual(answer.stdout, "")
        self.assertIn("file is required", gateway("check").stderr)
        answer = gateway("check", "--help")
        self.assertEqual((answer.returncode, answer.stderr), (0, ""))

    def test_run_and_watch_do_not_start_with_mistakes(self):
        path = self.write("plant.json", SETTINGS)
        for arguments in (["run", path], ["run", "--config", path], ["watch", "--config", path]):
            with self.subTest(arguments[:2]):
                answer = gateway(*arguments)
                self.assertEqual(answer.returncode, 1)
                for pointer in ("/lines/0/baudrate", "/lines/0/parity", "/modbus_tcp/0/listen", "/log/level"):
                    self.assertIn(f": {pointer} ", answer.stdout + answer.stderr)

    def test_much(self):
        route = '{"name": "r%d", "station": "s", "table": "input", "first": 0, "plc": "a", "device": "D%d"}'
        routes = ",\n".join(route % (i, i) for i in range(2000))
        text = '{"plcs": [{"name": "a"}], "lines": [{"name": "l", "device": "/dev/ttyS0"}],' \
               '"stations": [{"name": "s", "line": "l", "unit": 1}], "routes": [\n' + routes + "]}"
        self.assertEqual(Checked(text).lines, [])
        wrong = Checked(text.replace('"plc": "a"', '"plc": "b"'))
        self.assertEqual([int(m["line"]) for m in wrong.mistakes], list(range(2, 2002)))


if __name__ == "__main__":
    unittest.main()
