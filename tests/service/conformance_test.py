"""The tables under docs/conformance: every rule is held by tests that exist, or says why there is nothing to hold.

usage: conformance_test.py DOCS_FOLDER UNIT_TESTS BUILD_FOLDER
"""

import pathlib
import re
import subprocess
import sys


def lines_of(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()


def test_names(unit_tests, build):
    cases = {line.strip() for line in lines_of(unit_tests, "--list-test-cases", "--no-colors")}
    entries = (re.match(r" *Test +#\d+: (\S+)", line) for line in lines_of("ctest", "--test-dir", build, "-N"))
    return cases | {entry[1] for entry in entries if entry}


def rows_of(page):
    """Number and cells of each line of a table, without heads and the dashes below them."""
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        if not line.startswith("|"):
            continue
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))]
        if cells[0] != "rule" and not set(cells[0]) <= set("-: "):
            yield number, cells


def mistakes_of(rule, cells, names, seen):
    if len(cells) != 3:
        return [f"has {len(cells)} columns, not 3: rule, what the manual says, held by"]
    found = []
    if not re.fullmatch(r"\d+\.\d+(\.\d+)?-\d\d", rule):
        found.append(f'"{rule}" is no rule id such as 6.1-03')
    if rule in seen:
        found.append(f"{rule} stands at {seen[rule]} already")
    if not cells[1]:
        found.append(f"{rule} does not say what the manual says")
    held = re.findall(r"`([^`]+)`", cells[2])
    if not held and not re.match(r"not applicable: \w.*", cells[2]):
        found.append(f'{rule} is held by nothing: give a test in backticks, or "not applicable: why"')
    found.extend(f'{rule}: there is no test "{name}"' for name in held if name not in names)
    return found


def main():
    folder, unit_tests, build = sys.argv[1:]
    names = test_names(unit_tests, build)
    pages = sorted(pathlib.Path(folder).glob("chapter-*.md"))
    mistakes, seen = [], {}
    for page in pages:
        count = len(seen)
        for number, cells in rows_of(page):
            place = f"{page.name}:{number}"
            mistakes.extend(f"{place}: {each}" for each in mistakes_of(cells[0], cells, names, seen))
            seen.setdefault(cells[0], place)
        if len(seen) == count:
            mistakes.append(f"{page.name}: no rules")
        if page.name not in (page.parent / "README.md").read_text(encoding="utf-8"):
            mistakes.append(f"README.md does not name {page.name}")
    if not pages:
        mistakes.append(f"no chapters in {folder}")
    for each in mistakes:
        print(each)
    print(f"{len(seen)} rules in {len(pages)} chapters, {len(mistakes)} mistakes")
    return 1 if mistakes else 0


sys.exit(main())
