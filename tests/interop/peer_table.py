"""The table of docs/peers.md, and the versions of the peers that are installed."""

import json
import os
import re
import subprocess
from pathlib import Path

from support import PATIENCE

TABLE = Path(__file__).resolve().parents[2] / "docs" / "peers.md"
FRAMINGS = {"tcp": "TCP", "rtu": "RTU", "ascii": "ASCII", "rtu-over-tcp": "RTU over TCP",
            "ascii-over-tcp": "ASCII over TCP"}


def rows():
    """The table: peer and version, role, framing, functions, exceptions, test."""
    cells = [[cell.strip(" `") for cell in line.strip().strip("|").split("|")]
             for line in TABLE.read_text().splitlines() if re.match(r"\|.*`interop\.peers_", line)]
    return [tuple(row[:6]) for row in cells]


def debian_version(package):
    """Without what Debian adds to it."""
    found = subprocess.run(["dpkg-query", "--show", "--showformat=${Version}", package], stdout=subprocess.PIPE,
                           text=True, timeout=PATIENCE, check=True).stdout
    return re.match(r"[\d.]+", found).group()


def npm_version(package):
    lock = json.loads((Path(os.environ["NPM_PEERS"]) / "package-lock.json").read_text())
    return lock["packages"][f"node_modules/{package}"]["version"]
