"""Two gateways that stand in for each other, in front of a device that is reached by TCP."""

import json
import signal
import socket
import subprocess
import time

from recording_device import RecordingDevice
from support import PATIENCE, Gateway, InteropTest, Watch, binary, holds, main, route, station, wait_for

A, B = "127.0.0.1", "127.0.0.2"  # as which each member reaches the device
LEASE = 1


class PairTest(InteropTest):
    def setUp(self):
        self.device = RecordingDevice(self)
        self.ports = {A: self.free_port(), B: self.free_port()}
        self.members = {}
        self.starts = 0

    def start_member(self, address, hand_back=True, listen_ms=2000):
        self.starts += 1
        first = address == A
        configuration = self.configuration(
            lines=[{"name": "line", "protocol": "modbus-tcp", "host": address, "port": self.device.port,
                    "response_timeout_ms": 2000}],
            stations=[station("dev", 1)],
            routes=[route("dev.count", "holding", 0, "D0", 2, period_ms=100),
                    route("dev.set", "holding", 10, "D10", 2, direction="write")],
            dds={"member": "a" if first else "b", "blocks": [{"plc": "main", "device": "D50", "count": 2}]},
            standby={"priority": 100 if first else 50, "hand_back": hand_back, "hand_back_after_ms": 2000,
                     "listen_ms": listen_ms, "lease_ms": 1000 * LEASE})
        configuration["modbus_tcp"][0]["port"] = self.ports[address]
        configuration["control"]["socket"] = self.socket_of(address)
        (self.folder / str(self.starts)).mkdir()
        self.dds = configuration["dds"]
        member = MemberGateway(self, configuration, self.folder / str(self.starts) / "gateway.json")
        self.members[address] = member
        return member

    def socket_of(self, address):
        return str(self.folder / f"{address}.sock")

    def start_pair(self, **options):
        for address in (A, B):
            self.start_member(address, **options)
        self.wait_active(A)
        self.watch = PairWatch(self, self.dds)
        wait_for("a sample of the device", lambda: self.watch.latest("dev.count"))

    def pair(self, address, *words):
        done = subprocess.run([binary("PLC_GATEWAY"), "pair", *words, "--socket", self.socket_of(address)], text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              timeout=PATIENCE, check=False)
        return done.returncode, done.stdout

    def listens(self, address):
        with socket.socket() as probe:
            return probe.connect_ex(("127.0.0.1", self.ports[address])) == 0

    def wait_active(self, address):
        wait_for(f"{address} answers", lambda: self.listens(address))
        began = time.monotonic()
        wait_for(f"{address} asks the device", lambda: self.device.asked_by(address, began))

    def client(self, address):
        return self.members[address].client()

    def write_something(self, address):
        """To the device, and to nobody but the memory."""
        client = self.client(address)
        client.write_registers(10, [111, 222])
        client.write_registers(50, [333, 444])
        wait_for("the device has it", lambda: (10, [111, 222]) in self.device.writes())
        self.assertEqual(client.holding(50, 2), [333, 444])
        time.sleep(0.2)  # twice the time in which the other member hears of it

    def check_values(self, address):
        client = self.client(address)
        self.assertEqual(client.holding(10, 2), [111, 222])
        self.assertEqual(client.holding(50, 2), [333, 444])
        self.assertEqual(self.device.writes(), [(10, [111, 222])])
        client.write_registers(10, [112, 222])
        wait_for("the device has what the other member writes", lambda: (10, [112, 222]) in self.device.writes())
        self.assertEqual(self.device.writes(), [(10, [111, 222]), (10, [112, 222])])

    @staticmethod
    def answer_of(client):
        try:
            return client.modbus.socket.recv(100)
        except ConnectionResetError:
            return b""

    def check_samples(self):
        """Nobody saw an older value after a newer one."""
        samples = [each for each in self.watch.of("dev.count") if each["quality"] != "never read"]
        values = [each["values"][0] for each in samples]
        self.assertEqual(values, sorted(values))
        sources = [each["source_ns"] for each in samples]
        self.assertEqual(sources, sorted(sources))
        self.assertGreater(len({each["member"] for each in samples}), 1, "of both members")

    def test_the_standby_is_silent_and_says_so(self):
        self.start_pair()
        self.assertFalse(self.listens(B))
        holds("the standby asks nothing", lambda: not self.device.asked_by(B), 1)
        self.assertEqual(self.watch.roles(), {"a": "active", "b": "standby"})
        status, said = self.pair(B)
        self.assertEqual(status, 0, said)
        self.assertIn("b (here): standby, term 1, priority 50", said)
        self.assertIn("a (heard now): active, term 1, priority 100", said)

    def test_kill(self):
        self.start_pair(hand_back=False)
        self.write_something(A)
        killed = time.monotonic()  # its end takes time, too
        self.members[A].kill()
        self.wait_active(B)
        took = next(each[0] for each in self.device.asked_by(B)) - killed
        print(f"taken over {took * 1000:.0f} ms after SIGKILL")
        self.assertGreater(took, LEASE / 2)
        self.check_values(B)
        self.watch.expect("main.D50", values=[333, 444], member="b")
        self.start_member(A, hand_back=False)
        wait_for("the killed member is back", lambda: "standby, term" in self.pair(A)[1])
        holds("it stays standby", lambda: not self.listens(A), 4)
        self.check_samples()

    def test_handed_back(self):
        self.start_pair()
        self.write_something(A)
        self.members[A].kill()
        self.wait_active(B)
        self.check_values(B)
        began = time.monotonic()
        self.start_member(A)
        self.wait_active(A)
        first = self.device.asked_by(A, began)[0][0]
        wait_for("b does not listen any more", lambda: not self.listens(B))
        self.assertEqual([each for each in self.device.asked_by(B, first + 0.05) if each[0] > first + 0.05], [])
        self.assertEqual(self.client(A).holding(10, 2), [112, 222])
        self.assertEqual(self.client(A).holding(50, 2), [333, 444])
        self.assertEqual(len(self.device.writes()), 2)
        self.check_samples()

    def test_killed_and_started_again_at_once(self):
        self.start_pair(hand_back=False)
        self.write_something(A)
        self.members[A].kill()
        self.start_member(A, hand_back=False)
        self.wait_active(B)
        self.check_values(B)
        holds("the new one stays standby", lambda: not self.listens(A), 3)
        self.check_samples()

    def test_stopped_and_continued(self):
        self.stop_and_continue(1)

    def test_stopped_until_the_middleware_has_forgotten_it(self):
        self.stop_and_continue(8)

    def stop_and_continue(self, seconds):
        self.start_pair(hand_back=False)
        self.write_something(A)
        stuck = self.client(A)
        self.members[A].signal(signal.SIGSTOP)
        self.wait_active(B)
        self.check_values(B)
        time.sleep(seconds)
        # A request waits for it when it goes on.
        stuck.modbus.socket.sendall(bytes.fromhex("000100000006010300320002"))
        continued = time.monotonic()
        self.members[A].signal(signal.SIGCONT)
        holds("it asks nothing", lambda: not self.device.asked_by(A, continued), 3)
        self.assertEqual(self.answer_of(stuck), b"", "it does not answer either")
        wait_for("it is the standby", lambda: "a (here): standby" in self.pair(A)[1])
        self.assertFalse(self.listens(A))
        self.assertTrue(self.listens(B))
        self.check_samples()

    def test_ended_in_order(self):
        self.start_pair(hand_back=False)
        self.write_something(A)
        ended = time.monotonic()
        self.members[A].stop()
        self.wait_active(B)
        took = self.device.asked_by(B)[0][0] - ended
        print(f"taken over {took * 1000:.0f} ms after SIGTERM")
        self.check_values(B)
        self.assertIn("member a ends", self.members[B].log)

    def test_switched_by_command(self):
        self.start_pair()
        self.write_something(A)
        for asked, other in ((A, B), (A, A)):  # both ask the same member: active first, then standby
            status, said = self.pair(asked, "switch")
            self.assertEqual(status, 0, said)
            self.wait_active(other)
            wait_for("one of them listens", lambda: self.listens(other) and not self.listens(A if other == B else B))
            if other == B:
                holds("it is kept", lambda: not self.listens(A), 4)
        self.check_values(A)
        self.check_samples()
        self.members[B].kill()
        wait_for("b is missed", lambda: "not heard any more" in self.pair(A)[1])
        status, said = self.pair(A, "switch")
        self.assertEqual(status, 1)
        self.assertIn("nobody to hand over to", said)


class MemberGateway(Gateway):
    """One of two: each with a configuration file of its own."""

    def __init__(self, test, configuration, path):
        path.write_text(json.dumps(configuration, indent=2))
        written, test.write = test.write, lambda _: path
        try:
            super().__init__(test, configuration)
        finally:
            test.write = written


class PairWatch(Watch):
    """What subscribers get of both members."""

    def roles(self):
        wait_for("both members are heard", lambda: self.read() or len({e["member"] for e in self.statuses}) == 2)
        return {each["member"]: each["role"] for each in self.statuses}


if __name__ == "__main__":
    main()
