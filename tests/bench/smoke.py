"""A few seconds of the benchmark, for ctest: the silence is kept, and the emulator's figures fit together.

The machine may be busy and the gateway slow: how much of the wire it uses does not matter here.
"""

import bus
from support import Bench, CannotMeasure, Slice, wait_for

BAUD = 57600
SECONDS = 3


def run(options):
    with Bench() as bench:
        wires = bench.wires({"baud": BAUD, "stations": [{"unit": 1, "turnaround_us": options.turnaround_us}]})
        gateway = bus.gateway(bench, wires)
        wait_for("every block is read", lambda: wires.report()["lines"][0]["blocks"] == len(bus.BLOCKS))
        line = Slice(wires, gateway, SECONDS).lines[0]
    found = [what for what, wrong in {
        "silences are too short": line["short_silences"] != 0,
        "bytes collided, or requests were torn or damaged": line["collisions"] + line["torn_requests"]
                                                            + line["bad_requests"] != 0,
        "the least silence is below the rule": line["least_silence_us"] < line["rule_us"],
        "responses are missing": abs(line["requests"] - line["answered"]) > 1 or line["unanswered"] != 0,
        "requests took less than the wire allows": not 0 < line["ideal_us"] <= line["elapsed_us"],
        "the longest transaction is none of the configured blocks":
            abs(line["longest_us"] - bus.longest_us(BAUD, options.turnaround_us)) > 1,
    }.items() if wrong]
    if found:
        raise CannotMeasure(f"{'; '.join(found)}: {line}")
    print(f"smoke: {line['answered']} reads, least silence {line['least_silence_us']:.0f} us, "
          f"{line['ideal_us'] / line['elapsed_us']:.2%} of the wire used")
