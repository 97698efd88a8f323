#!/usr/bin/env python3
"""Checks docs/conformance.md: what it names exists, and nothing is left without a test.

    tests/conformance.py

Prints a line `ok …` or `not ok …` for each table row, and for each test and example that the tables must not leave out.
"""

import glob
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
MANUAL = os.path.join(ROOT, "docs", "conformance.md")
NAMED = re.compile(r"`((?:tests|examples)/[\w/.]+\.\w+)`")
RULES = ["%d " % n for n in range(1, 13)]
SECTIONS = ["3.%d " % n for n in range(1, 9)]
ALL_OF = ["tests/order/*.pcg", "examples/lessons/*.pcg", "examples/figures/*.pcg"]


def rows_of(text):
    """The tables' rows as lists of cells; a row that begins with an empty cell goes on with the
    subject of the one before."""
    rows = []
    for line in text.splitlines():
        cells = [c.strip() for c in line.strip("|").split("|")] if line.startswith("| ") else []
        if cells and not cells[0].startswith("-"):
            rows.append([cells[0] or rows[-1][0]] + cells[1:])
    return rows


def report(holds, what):
    print(("ok " if holds else "not ok ") + what)
    return 0 if holds else 1


def check_named(rows):
    failed = 0
    for row in rows:
        named = NAMED.findall(" ".join(row))
        missing = [path for path in named if not os.path.exists(os.path.join(ROOT, path))]
        if named:
            failed += report(not missing, " ".join(["%s: all files are there" % row[0]] + missing))
    return failed


def check_subjects(rows):
    failed = 0
    for subject in RULES + SECTIONS:
        about = [" ".join(row) for row in rows if row[0].startswith(subject)]
        folders = {path.split("/")[0] for path in NAMED.findall(" ".join(about))}
        failed += report("tests" in folders, "%sis pinned by a test" % subject)
        failed += report("examples" in folders, "%sis shown by an example" % subject)
    return failed


def check_listed(text):
    paths = [os.path.relpath(path, ROOT) for pattern in ALL_OF
             for path in sorted(glob.glob(os.path.join(ROOT, pattern)))]
    return sum(report("`%s`" % path in text, "%s is in the table" % path) for path in paths)


def main():
    with open(MANUAL, encoding="utf-8") as manual:
        text = manual.read()
    rows = rows_of(text)
    failed = check_named(rows) + check_subjects(rows) + check_listed(text)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
