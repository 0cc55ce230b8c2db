"""plc-gateway plc, map and linktime: what they print, and their exit status."""

import json
import socket
import subprocess

from support import PATIENCE, InteropTest, binary, main, wait_for

D0 = M0 = 0


class CommandsTest(InteropTest):
    def command(self, *words):
        done = subprocess.run([binary("PLC_GATEWAY"), *map(str, words)], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=PATIENCE, check=False)
        return done.returncode, done.stdout, done.stderr

    def states(self, *words):
        status, out, err = self.plc_command(*words)
        self.assertEqual((status, err), (0, ""))
        return [line.split() for line in out.splitlines()]

    def test_plc(self):
        configuration = self.configuration(units=["main", "other"])
        configuration["plcs"][1]["model"] = "FX3G"
        gateway = self.start_gateway(configuration)
        main_runs, other_runs = ["main", "FX3U", "RUN"], ["other", "FX3G", "RUN"]
        self.assertEqual(self.states("list"), [main_runs, other_runs])
        self.assertEqual(self.states(), [main_runs, other_runs])
        self.assertEqual(self.states("list", "other"), [other_runs])
        self.assertEqual(self.states("stop", "other"), [["other", "FX3G", "STOP"]])
        self.assertEqual(self.states("list"), [main_runs, ["other", "FX3G", "STOP"]])
        self.assertEqual(self.states("run", "other"), [other_runs])
        client = gateway.client()
        client.write_register(D0, 7)
        client.write_coil(M0, 1)
        self.assertEqual(self.states("power-cycle", "main"), [main_runs])
        self.assertEqual(client.coils(M0), [0])

        for words, text in ((("stop", "pump"), 'there is no PLC "pump", but: main, other'),
                            (("stop",), 'there is no PLC ""'), (("halt", "main"), 'unknown action "halt"')):
            with self.subTest(words=words):
                status, out, err = self.plc_command(*words)
                self.assertEqual((status, out), (1, ""))
                self.assertIn(text, err)
        self.assertEqual(self.states("list"), [main_runs, other_runs])
        gateway.stop()
        self.assertFalse(self.control_socket.exists())

    def test_no_gateway(self):
        status, out, err = self.plc_command("list")
        self.assertEqual((status, out), (1, ""))
        self.assertRegex(err, r"no gateway answers on .*/control\.sock \(No such file or directory\)")

    def test_socket_that_a_killed_gateway_left(self):
        configuration = self.configuration()
        self.start_gateway(configuration).kill()
        status, _, err = self.plc_command("list")
        self.assertEqual(status, 1)
        self.assertIn("Connection refused", err)
        configuration["modbus_tcp"][0]["port"] = self.free_port()
        self.start_gateway(configuration)
        self.assertEqual(self.states("list"), [["main", "FX3U", "RUN"]])

    def test_nonsense_on_the_control_socket(self):
        gateway = self.start_gateway(self.configuration())
        wait_for("the control socket", self.control_socket.exists)
        with socket.socket(socket.AF_UNIX) as client:
            client.settimeout(PATIENCE)
            client.connect(str(self.control_socket))
            stream = client.makefile("rw")
            commands = ["plc", "scan", "pair", "read", "write", "send", "plc-link"]
            values = [7, None, ["x"], {"a": 1}, True, "x" * 300]
            lines = ["nonsense", "7", "[]", "{}", '{"command": 7}'] + [
                json.dumps({"command": command, "action": value, "name": value, "target": value, "values": value,
                            "line": value, "units": value, "text": value, "count": value})
                for command in commands for value in values]
            for line in lines:
                with self.subTest(line=line):
                    stream.write(line + "\n")
                    stream.flush()
                    self.assertIn("ok", json.loads(stream.readline()))
        self.assertEqual(self.states("list"), [["main", "FX3U", "RUN"]])
        gateway.stop()

    def test_map(self):
        def answer(*queries, model="FX3U"):
            status, out, err = self.command("map", "--model", model, *queries)
            return status, [" ".join(line.split()) for line in out.splitlines()], err

        self.assertEqual(answer("D100"), (0, ["D100 input register ir:100 (0x0064) 30101 / 300101",
                                              "D100 holding register hr:100 (0x0064) 40101 / 400101"], ""))
        self.assertEqual(answer("40101"), (0, ["holding register hr:100 (0x0064) 40101 / 400101 D100"], ""))
        self.assertEqual(answer("hr:0x64"), (0, ["holding register hr:100 (0x0064) 40101 / 400101 D100"], ""))
        self.assertIn("X17 discrete input di:13327 (0x340F) 113328", answer("X17")[1])
        self.assertIn("M8000 coil coil:7680 (0x1E00) 07681 / 007681", answer("M8000")[1])
        status, out, err = answer("D9000")
        self.assertEqual((status, out), (1, []))
        self.assertIn("D9000", err)
        status, out, err = answer("hr:65535")
        self.assertEqual((status, out), (1, []))
        self.assertIn("exception 02", err)
        self.assertEqual(answer("nonsense")[0], 1)
        self.assertEqual(answer("D0", model="FX9")[0], 1)
        self.assertEqual(answer("D0", "M0", model="FX3G")[0], 0)

    def test_map_of_fp7(self):
        def answer(*queries):
            status, out, err = self.command("map", "--model", "FP7", *queries)
            return status, [" ".join(line.split()) for line in out.splitlines()], err

        self.assertEqual(answer(), (0, ["FP7, default map",
                                        "coil 0-2047 0000-07FF Y0-Y127F",
                                        "coil 2048-34815 0800-87FF R0-R2047F",
                                        "discrete input 0-8191 0000-1FFF X0-X511F",
                                        "input register 0-1023 0000-03FF WL0-WL1023",
                                        "input register 1024-1999 0400-07CF -",
                                        "input register 2000-18383 07D0-47CF LD0-LD16383",
                                        "holding register 0-65535 0000-FFFF DT0-DT65535",
                                        "What leads nowhere (-) is answered with exception 02."], ""))
        self.assertEqual(answer("r1f", "WR3", "L5", "302001"),
                         (0, ["R1F coil coil:2079 (0x081F) 02080 / 002080",
                              "WR3 coil coil:2096 (0x0830) 02097 / 002097 and the next 15, bit 0 first",
                              "L5 input register ir:0 (0x0000) 30001 / 300001 bit 5",
                              "input register ir:2000 (0x07D0) 32001 / 302001 LD0"], ""))
        for wrong, why in (("R1G", "one hexadecimal digit for the bit: R1F"), ("D100", "such as DT100, R1F or WR3"),
                           ("DT65536", "but DT0-DT65535"), ("WX512", "but WX0-WX511"),
                           ("Y1280", "no MODBUS number leads to it"), ("ir:1024", "exception 02")):
            with self.subTest(wrong=wrong):
                status, out, err = answer(wrong)
                self.assertEqual((status, out), (1, []))
                self.assertIn(why, err)

    def test_map_of_a_configuration(self):
        path = self.write(self.configuration(units=["main", "other"]))
        status, out, _ = self.command("map", "-c", path, "-p", "other", "40001")
        self.assertEqual((status, " ".join(out.split())), (0, "holding register hr:0 (0x0000) 40001 / 400001 D0"))
        status, _, err = self.command("map", "-c", path, "-p", "pump", "40001")
        self.assertEqual(status, 1)
        self.assertIn('has no PLC "pump", but main, other', err)

    def test_link_time(self):
        def times(*options):
            status, out, err = self.command("linktime", *options)
            self.assertEqual((status, err), (0, ""))
            rows = [line.split() for line in out.splitlines() if line.startswith("  ")]
            return {row[0]: float(row[1]) for row in rows}

        # 8 and 7 bytes of 10 bits at 19200 bit/s and 1 ms; 3.5 characters are 1.8 ms.
        found = times("--baud", 19200, "--bits", "8N1", "--function", 3, "--count", 1, "--scan", 10)
        self.assertEqual({name: found[name] for name in ("T4", "T7", "T9", "Tm", "Ts")},
                         {"T4": 1.8, "T7": 5.2, "T9": 4.6, "Tm": 41.0, "Ts": 22.6})
        self.assertGreater(times("--baud", 9600)["Tm"], found["Tm"])
        self.assertEqual(times("--request", 8, "--response", 7), found)
        # The FP7 manual's sixth and third example: 10.584 ms, and 593.43 ms of parts that it rounds first.
        small = times("--plc-link", 2, "--relay-words", 1, "--register-words", 1, "--scan", 1)
        self.assertEqual(small, {"Tpc": 3.0, "Ts": 4.0, "Tlt": 1.6, "Tso": 1.0, "Tlk": 0.0, "T": 10.6})
        self.assertEqual(times("--plc-link", 16, "--absent", 1, "--scan", 5)["T"], 593.0)
        for wrong in (("--function", "3", "--count", "126"), ("--bits", "9N1"), ("--bits", "7E1"), ("--scan", "0"),
                      ("--plc-link", "17"), ("--plc-link", "1"), ("--plc-link", "2", "--absent", "2"),
                      ("--plc-link", "2", "--relay-words", "65"), ("--plc-link", "2", "--scan", "0")):
            with self.subTest(wrong=wrong):
                status, out, err = self.command("linktime", *wrong)
                self.assertEqual((status, out), (1, ""))
                self.assertNotEqual(err, "")


main()
