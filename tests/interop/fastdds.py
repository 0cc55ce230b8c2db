"""A foreign DDS participant: Debian's Fast DDS, on the types that its own generator makes of our IDL (tests/fastdds)."""

import json
import os
import subprocess

from support import PATIENCE, Program, binary, wait_for

QUALITY = {"never read": 0, "device error": 12, "comm error": 24, "stale": 68, "substituted": 72, "good": 192}
BITS = 1  # RegisterBlock.format
BOOLEAN, INTEGER, REAL, TEXT = 1, 2, 3, 4  # Point.kind
RECEIVED, SENT = 0, 1  # SerialMessage.way
STATE = {"unknown": 0, "disabled": 1, "down": 2, "starting": 3, "up": 4, "degraded": 5}
INFO, WARNING, ERROR = 0, 1, 2  # Event.severity
OK, REJECTED, NOT_FOUND, EXPIRED, DEVICE_ERROR, TIMEOUT, BUSY, STANDBY, DENIED = range(9)  # WriteReply.result


def options(dds):
    return ["--domain", str(dds["domain"]), "--partition", dds["partition"]]


class Subscriber(Program):
    """Subscribes to all topics, or to these."""

    def __init__(self, test, dds, *topics):
        self.samples_file = test.folder / f"{len(test.programs)}-fast-dds.json"
        self.read_until = 0
        self.samples = []  # in the order of their arrival
        self.writers = {}  # of each topic, how many there are
        with open(self.samples_file, "wb") as output:
            super().__init__(test, "fast-dds-peer", [binary("FAST_DDS_PEER"), *options(dds), "subscribe", *topics], output)

    def read(self):
        with open(self.samples_file, "rb") as output:
            output.seek(self.read_until)
            for line in output:
                if not line.endswith(b"\n"):
                    break
                self.read_until += len(line)
                sample = json.loads(line)
                if "writers" in sample:
                    self.writers[sample["topic"]] = sample["writers"]
                else:
                    self.samples.append(sample)

    def of(self, topic, **wanted):
        """All samples of a topic so far that have these fields."""
        self.read()
        return [each for each in self.samples
                if each["topic"] == topic and all(each.get(key) == value for key, value in wanted.items())]

    def latest(self, topic, **key):
        samples = self.of(topic, **key)
        return samples[-1] if samples else {}

    def expect(self, topic, key, seconds=PATIENCE, **wanted):
        """Waits until the latest sample with this key has these fields, and returns it."""
        def fitting():
            latest = self.latest(topic, **key)
            return latest if latest and all(latest.get(name) == value for name, value in wanted.items()) else None
        return wait_for(lambda: f"{topic} {key} with {wanted}, the latest is {self.latest(topic, **key)}", fitting, seconds)

    def expect_writers(self, topic, count):
        wait_for(lambda: f"{count} writers of {topic}, not {self.writers}",
                 lambda: self.read() or self.writers.get(topic, 0) == count)

    def connected(self):
        """Waits until it hears the gateway, and so every event from then on."""
        wait_for("the gateway is heard by Fast DDS", lambda: self.of("GatewayStatus"))
        return self


class Publisher(Program):
    """dds_peer publish: our publisher without a daemon, with routes peer.0, peer.1 ... that it can dispose of."""

    def __init__(self, test, dds, gateway, routes):
        here, there = os.pipe()
        self.orders = os.fdopen(there, "wb", buffering=0)
        test.addCleanup(self.orders.close)
        with os.fdopen(here, "rb") as orders:
            super().__init__(test, "dds_peer", [binary("DDS_PEER"), "publish", f"{dds['domain']}/{dds['partition']}",
                                                gateway, routes], stdin=orders)
        self.ready()

    def dispose_next(self):
        self.orders.write(b"\n")


class Requests:
    """A client whose requests are repeated until the reply comes, as registers.idl says."""

    def __init__(self, test, dds, client):
        self.dds, self.client, self.last_id = dds, f"{client}.{test.id()}"[:64], 0

    def send(self, topic, request_id=None, longest_ms=1000 * PATIENCE, **content):
        """The reply; None when there is none in time. Without an id it is a new request."""
        self.last_id = request_id or self.last_id + 1
        content = {"client": self.client, "request_id": self.last_id, "gateway": "interop", **content}
        done = subprocess.run([binary("FAST_DDS_PEER"), *options(self.dds), "request", topic, json.dumps(content),
                               "--longest-ms", str(longest_ms)], text=True, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=2 * PATIENCE, check=False)
        if done.returncode not in (0, 1):
            raise AssertionError(f"fast-dds-peer: {done.stderr}")
        return json.loads(done.stdout) if done.returncode == 0 else None
