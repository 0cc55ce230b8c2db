"""What a service manager sees of the daemon, without systemd: signals, notifications, exit statuses, messages."""

import os
import signal
import socket
import subprocess
import time
import tty

from support import PATIENCE, InteropTest, binary, main, route, serial_line, station, wait_for


class ServiceBasicsTest(InteropTest):
    def run_gateway(self, *arguments):
        """Runs it to its end. Returns the exit status and what it printed."""
        done = subprocess.run([binary("PLC_GATEWAY"), *map(str, arguments)], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=PATIENCE,
                              cwd=self.folder, check=False)
        return done.returncode, done.stdout

    def dead_line(self):
        """A configuration with a device that never answers."""
        ours, theirs = os.openpty()
        tty.setraw(theirs)
        self.addCleanup(os.close, ours)
        self.addCleanup(os.close, theirs)
        return self.configuration(
            lines=[serial_line(os.ttyname(theirs), response_timeout_ms=30000)], stations=[station("pump", 1)],
            routes=[route("pump.values", "holding", 0, "D100"),
                    route("pump.setpoint", "holding", 1, "D0", direction="write")])

    def ends_quickly(self, number):
        gateway = self.start_gateway(self.dead_line())
        clients = [gateway.client() for _ in range(5)]
        for client in clients:
            client.write_register(0, 1)
        half = socket.create_connection(("127.0.0.1", gateway.port))
        self.addCleanup(half.close)
        half.sendall(b"\x00\x01\x00")  # in the middle of a frame
        gateway.watch().expect("pump.values", quality="never read")

        signalled = time.monotonic()
        gateway.signal(number)
        self.assertEqual(gateway.wait(), 0)
        took = time.monotonic() - signalled
        print(f"ended after {took * 1000:.0f} ms")
        self.assertLess(took, 1)

    def test_sigterm_ends_it_with_clients_connected_and_a_dead_line(self):
        self.ends_quickly(signal.SIGTERM)

    def test_sigint_does_the_same(self):
        self.ends_quickly(signal.SIGINT)

    def test_restart_listens_on_the_same_port_at_once(self):
        configuration = self.configuration(dds={"enabled": False})
        for _ in range(3):
            gateway = self.start_gateway(configuration)
            gateway.client().holding(0)
            self.assertEqual(gateway.stop(), 0)  # while the client is connected: our side is in TIME_WAIT

    def notified(self, watchdog_pid):
        """A gateway and its service manager's socket. A shell becomes the gateway, so that $$ is its process id."""
        manager = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.addCleanup(manager.close)
        manager.bind(str(self.folder / "notify"))
        manager.settimeout(PATIENCE)
        wrapper = self.folder / "started-by-manager"
        wrapper.write_text(f'#!/bin/sh\nexport WATCHDOG_PID={watchdog_pid}\nexec "{binary("PLC_GATEWAY")}" "$@"\n')
        wrapper.chmod(0o755)
        gateway = self.start_gateway(self.configuration(dds={"enabled": False}), program=wrapper,
                                     NOTIFY_SOCKET=str(self.folder / "notify"), WATCHDOG_USEC="400000")
        return gateway, manager

    def test_notifications_to_the_service_manager(self):
        gateway, manager = self.notified("$$")
        heard = []  # (time, message)

        def hear_until(wanted):
            while not any(wanted in message for _, message in heard):
                heard.extend((time.monotonic(), line) for line in manager.recv(4096).decode().splitlines())
            return heard

        hear_until("READY=1")
        gateway.client().holding(0)  # ready means that it listens
        listening_until = time.monotonic() + 2
        while time.monotonic() < listening_until:
            heard.extend((time.monotonic(), line) for line in manager.recv(4096).decode().splitlines())
        fed = [at for at, message in heard if message == "WATCHDOG=1"]
        self.assertGreaterEqual(len(fed), 8)
        self.assertLess(max(b - a for a, b in zip(fed, fed[1:])), 0.4)
        gateway.signal(signal.SIGTERM)
        hear_until("STOPPING=1")
        self.assertEqual(gateway.wait(), 0)
        self.assertEqual([message for _, message in heard].count("READY=1"), 1)
        self.assertIn("STATUS=0 of 0 routes up", [message for _, message in heard])

    def test_watchdog_of_another_process_is_not_fed(self):
        gateway, manager = self.notified("1")
        time.sleep(0.6)
        gateway.stop()
        manager.settimeout(0)
        heard = []
        try:
            while True:
                heard += manager.recv(4096).decode().splitlines()
        except BlockingIOError:
            pass
        self.assertIn("READY=1", heard)
        self.assertNotIn("WATCHDOG=1", heard)

    def test_port_in_use_is_status_3_and_says_where(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            configuration = self.configuration(dds={"enabled": False})
            configuration["modbus_tcp"][0]["port"] = port = taken.getsockname()[1]
            status, said = self.run_gateway("run", self.write(configuration))
        self.assertEqual(status, 3)
        self.assertRegex(said, f"error .*cannot listen on 127.0.0.1:{port}: Address already in use")

    def test_broken_configuration_is_status_1_with_every_mistake(self):
        configuration = self.dead_line()
        configuration["plcs"][0]["model"] = "FX9"
        configuration["lines"][0]["baudrate"] = 9600
        configuration["stations"][0]["unit"] = 300
        configuration["routes"][0]["device"] = "Q7"
        configuration["routes"][1]["table"] = "input"
        configuration["modbus_tcp"][0]["units"][0]["plc"] = "mian"
        configuration["dds"]["domain"] = "zero"
        path = self.write(configuration)
        for command in ("run", "check"):
            with self.subTest(command=command):
                status, said = self.run_gateway(command, path)
                self.assertEqual(status, 1)
                for pointer in ("/plcs/0/model", "/lines/0/baudrate", "/stations/0/unit", "/routes/0/device",
                                "/routes/1/table", "/modbus_tcp/0/units/0/plc", "/dds/domain"):
                    self.assertRegex(said, rf"gateway.json:\d+:? .*{pointer}")
                self.assertIn("baud_rate", said)
                self.assertIn('"main"', said)

    def test_what_is_no_configuration_is_status_1(self):
        for text in ("", "{", "[]", '{"plcs": [}'):
            with self.subTest(text=text):
                status, said = self.run_gateway("run", self.write(text))
                self.assertEqual(status, 1)
                self.assertIn("gateway.json", said)
        status, said = self.run_gateway("run", self.folder / "absent.json")
        self.assertEqual(status, 1)
        self.assertIn("absent.json", said)

    def test_correct_configuration_is_status_0_of_check(self):
        status, said = self.run_gateway("check", self.write(self.dead_line()))
        self.assertEqual((status, "is correct" in said), (0, True), said)

    def test_usage_is_status_2(self):
        for arguments in ((), ("fly",), ("run", "--fast"), ("check",), ("check", "a.json", "b.json")):
            with self.subTest(arguments=arguments):
                status, said = self.run_gateway(*arguments)
                self.assertEqual(status, 2)
                self.assertTrue(said)

    def test_dds_interface_that_does_not_exist(self):
        gateway = self.start_gateway(self.configuration(dds={"interface": "nowhere0"}))
        client = gateway.client()
        client.write_register(0, 5)
        self.assertEqual(client.holding(0), [5])
        wait_for("the log says so", lambda: "warning DDS: " in gateway.log and "nowhere0" in gateway.log)
        time.sleep(2.5)
        self.assertTrue(gateway.running())
        self.assertEqual(client.holding(0), [5])
        self.assertLess(gateway.log.count("nowhere0"), 4, "said once, not at each try")


main()
