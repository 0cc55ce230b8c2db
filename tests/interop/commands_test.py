"""plc-gateway plc, map and linktime: what they print, and their exit status."""

import subprocess

from support import PATIENCE, InteropTest, binary, main

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
        for wrong in (("--function", "3", "--count", "126"), ("--bits", "9N1"), ("--bits", "7E1"), ("--scan", "0")):
            with self.subTest(wrong=wrong):
                status, out, err = self.command("linktime", *wrong)
                self.assertEqual((status, out), (1, ""))
                self.assertNotEqual(err, "")


main()
