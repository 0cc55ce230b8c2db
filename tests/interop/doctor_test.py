"""plc-gateway doctor dds: a missing interface, nobody there, somebody there, a foreign partition, another reliability."""

import json
import subprocess

from support import InteropTest, binary, main, wait_for


class DoctorTest(InteropTest):
    def doctor(self, *options):
        """Its exit status and what it prints."""
        command = [binary("PLC_GATEWAY"), "doctor", "dds", *options]
        done = subprocess.run([str(each) for each in command], capture_output=True, text=True, timeout=60, check=False)
        return done.returncode, done.stdout + done.stderr

    def start(self, **dds):
        self.gateway = self.start_gateway(self.configuration(dds=dds))
        self.domain = self.gateway.dds["domain"]
        self.partition = self.gateway.dds["partition"]

    def until(self, expected, *options):
        """The doctor's words once they hold what is expected: who starts is heard after a moment."""
        def said():
            status, text = self.doctor("--domain", self.domain, "--wait", 2, *options)
            return (status, text) if all(each in text for each in expected) else None
        return wait_for(lambda: f"{expected} in {self.doctor('--domain', self.domain, *options)}", said)

    def test_missing_interface(self):
        status, text = self.doctor("--domain", 41, "--interface", "nosuch0", "--wait", 1)
        self.assertEqual(status, 1, text)
        self.assertIn("WRONG  interface nosuch0 does not exist", text)
        self.assertRegex(text, r"-> this host has: .*\blo\b")
        self.assertIn("cannot create DDS domain", text)

    def test_nobody_is_there(self):
        status, text = self.doctor("--domain", 42, "--wait", 1)
        self.assertEqual(status, 1, text)
        self.assertIn("ok     interface lo is up with 127.0.0.1", text)
        self.assertIn("WRONG  nobody else was seen on domain 42 within 1 s", text)
        self.assertIn("UDP ports 17900 to 17973", text)  # 7400 + 250 * 42
        self.assertIn('"lo" is this host only', text)

    def test_a_gateway_is_there(self):
        self.start()
        status, text = self.until(["writes", "PortStatus"], "--partition", self.partition)
        self.assertEqual(status, 0, text)
        self.assertIn(f"plc-gateway (process {self.gateway.pid})", text)
        self.assertIn("127.0.0.1", text)
        self.assertIn("nothing is wrong", text)
        status, text = self.until(["nothing is wrong"], "--config", self.folder / "gateway.json")
        self.assertEqual(status, 0, text)
        status, text = self.until(["nothing is wrong"], "--partition", self.partition[:9] + "*")
        self.assertEqual(status, 0, text)

    def test_a_foreign_partition(self):
        self.start()
        status, text = self.until(["RegisterBlock in partition"], "--partition", "elsewhere")
        self.assertEqual(status, 1, text)
        self.assertIn(f'in partition "{self.partition}", these settings have partition "elsewhere"', text)
        self.assertIn("-> give both the same dds.partition", text)

    def test_another_reliability(self):
        self.start(topics={"device_status": {"reliability": "best-effort"}})
        status, text = self.until(["DeviceStatus with another reliability"], "--partition", self.partition)
        self.assertEqual(status, 1, text)
        self.assertNotIn("PortStatus with another", text)

    def test_peers_and_a_cyclone_file(self):
        status, text = self.doctor("--domain", 43, "--wait", 1, "--peer", "127.0.0.1", "--peer", "plc1")
        self.assertEqual(status, 1, text)
        self.assertIn("peer 127.0.0.1 is there, but nobody listens", text)
        self.assertIn("WRONG  peer plc1 is no IPv4 address", text)

        file = self.folder / "cyclone.xml"
        file.write_text('<?xml version="1.0"?><CycloneDDS><Domain id="any"><General><Interfaces>'
                        '<NetworkInterface name="lo"/></Interfaces></General></Domain></CycloneDDS>')
        configuration = self.configuration(dds={"cyclone_config": "cyclone.xml"})
        path = self.folder / "with-file.json"
        path.write_text(json.dumps(configuration))
        status, text = self.doctor("--config", path, "--wait", 1)
        self.assertEqual(status, 1, text)
        self.assertIn("does not switch key hashes on", text)
        self.assertIn("DDS starts on domain", text)
        file.write_text("no XML")
        status, text = self.doctor("--config", path, "--wait", 1)
        self.assertIn("is no XML", text)

    def test_a_configuration_with_mistakes(self):
        path = self.folder / "wrong.json"
        path.write_text(json.dumps(self.configuration(dds={"partition": "plant*", "cyclone_config": "nowhere.xml"})))
        status, text = self.doctor("--config", path)
        self.assertEqual(status, 1)
        self.assertIn("a pattern is for readers", text)
        self.assertIn("which cannot be found", text)
        status, text = self.doctor("--domain", 999)
        self.assertEqual(status, 2)


main()
