"""What the scripts here share: the built program, its answers, and JSON with comments."""
import json
import os
import pathlib
import re
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SHIPPED = sorted(path for path in (ROOT / "etc").glob("*.json") if not path.name.endswith(".schema.json"))
SCHEMA_FILE = ROOT / "etc" / "plc-gateway.schema.json"
PROGRAM = os.environ["PLC_GATEWAY"]

# "plant.json:12: warning: /lines/0/parity is ...": mistakes of the whole file have no pointer.
MISTAKE = re.compile(r"(?P<file>.*?):(?P<line>\d+): (?P<warning>warning: )?(?P<pointer>/\S*)?")


def gateway(*arguments, **options):
    command = [PROGRAM, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, check=False, **options)


def without_comments(text):
    """JSON from JSON with comments; the lines stay."""
    tokens = re.compile(r'"(?:\\.|[^"\\])*"|//[^\r\n]*|/\*.*?\*/', re.DOTALL)
    return tokens.sub(lambda m: m[0] if m[0].startswith('"') else "\n" * m[0].count("\n") + " ", text)


def read_jsonc(text):
    return json.loads(without_comments(text))


class Checked:
    """`plc-gateway check` of a text: its exit status, and a match of MISTAKE for each line about the file's content."""

    def __init__(self, text, files=None):
        with tempfile.TemporaryDirectory(prefix="plcgw-config-") as folder:
            path = pathlib.Path(folder) / "plant.json"
            path.write_text(text, encoding="utf-8")
            for name, content in (files or {}).items():
                (pathlib.Path(folder) / name).write_text(content, encoding="utf-8")
            answer = gateway("check", "--overload", "warn", path)  # any baud rate, any period
        self.status = answer.returncode
        self.output = answer.stdout
        self.lines = answer.stderr.splitlines()
        self.mistakes = [m for m in map(MISTAKE.match, self.lines) if m]

    @property
    def accepted(self):
        return self.status == 0

    @property
    def pointers(self):
        return [m["pointer"] or "" for m in self.mistakes]
