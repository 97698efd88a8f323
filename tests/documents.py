#!/usr/bin/env python3
"""Follows a manual as a reader would, and holds what it prints against what the manual says.

    tests/documents.py [--rewrite] FILE.md...

In a manual, in this order and in one empty folder a file:

- a block that begins with ```pcg NAME.pcg or ```c NAME.c (any language and file name) is that file, as a whole;
- a block ```console holds commands, `$ …`, each with what it prints to either stream below it. A line `…` stands for
  any number of lines, and `…` within a line for anything. A command that may fail says so: `$ … ; echo $?`;
- a block ```pcg without a name that holds a graph, and no `…`, must pass `pcgc check`.

`pcgc` is the compiler under test, and ~/pcgc the project's folder. With --rewrite, what commands print is
written into the manual instead (lines with `…` stay as they are where they fit).
"""

import os
import re
import subprocess
import sys
import tempfile

FENCE = re.compile(r"^```(\w*)[ ]?(.*)$")


class Block:
    def __init__(self, language, name, line):
        self.language, self.name, self.line, self.lines = language, name, line, []


def blocks_of(text):
    """The fenced blocks of a manual that are not indented; line numbers are those of their first lines."""
    found, block = [], None
    for number, line in enumerate(text.splitlines(), 1):
        fence = FENCE.match(line)
        if block and line == "```":
            found.append(block)
            block = None
        elif block:
            block.lines.append(line)
        elif fence:
            block = Block(fence[1], fence[2].strip(), number + 1)
    return found


class Command:
    """A command of a console block and the lines that it is said to print."""

    def __init__(self, text, line):
        self.text, self.line, self.expected = text, line, []


def commands_of(block):
    commands = []
    for number, line in enumerate(block.lines, block.line):
        if line.startswith("$ "):
            commands.append(Command(line[2:], number))
        elif commands:
            commands[-1].expected.append(line)
    return commands


def fits_line(expected, found):
    pattern = ".*".join(re.escape(part) for part in expected.split("…"))
    return re.fullmatch(pattern, found) is not None


def fits(expected, found):
    """Whether the lines are as expected; `…` alone on a line stands for any number of them."""
    if not expected:
        return not found
    if expected[0] == "…":
        return any(fits(expected[1:], found[i:]) for i in range(len(found) + 1))
    return bool(found) and fits_line(expected[0], found[0]) and fits(expected[1:], found[1:])


def was_left_out(found):
    """Whether a command says that it needs what `make check` knows that configure has left out."""
    return bool(os.environ.get("LEFT_OUT", "").strip()) and \
        any("was left out when this program was built" in line for line in found)


def sanitized_python(path):
    """A Python that can load sanitized libraries; its own leaks are not ours."""
    with open(path, "w", encoding="utf-8") as f:
        f.write('#!/bin/sh\nLD_PRELOAD=$ASAN_LIBRARY ASAN_OPTIONS=detect_leaks=0 exec %s "$@"\n'
                % sys.executable)
    os.chmod(path, 0o755)


class Reader:
    """Someone who follows a manual, in a folder of their own."""

    def __init__(self, folder, root, pcgc):
        self.folder = os.path.join(folder, "work")
        os.mkdir(self.folder)
        os.symlink(root, os.path.join(folder, "pcgc"))
        tools = os.path.join(folder, "bin")
        os.mkdir(tools)
        os.symlink(pcgc, os.path.join(tools, "pcgc"))
        if os.environ.get("ASAN_LIBRARY"):
            sanitized_python(os.path.join(tools, "python3"))
        self.env = dict(os.environ, HOME=folder, PATH=tools + ":" + os.environ["PATH"], NO_COLOR="1")
        self.failed = 0

    def run(self, command):
        done = subprocess.run(["sh", "-c", command], cwd=self.folder, env=self.env, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)
        return done.returncode, done.stdout.decode("utf-8", "replace").splitlines()

    def report(self, holds, what, details=()):
        print(("ok " if holds else "not ok ") + what)
        self.failed += not holds
        for line in () if holds else details:
            print("    " + line)

    def write(self, block):
        path = os.path.join(self.folder, block.name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as out:
            out.write("\n".join(block.lines) + "\n")

    def follow(self, manual, command):
        code, found = self.run(command.text)
        holds = code == 0 and fits(command.expected, found) or was_left_out(found)
        self.report(holds, "%s:%d: %s" % (manual, command.line, command.text),
                    ["exit code %d, found:" % code] + found[:40] + ["expected:"] + command.expected)
        return found

    def check(self, manual, block):
        """A graph that stands in the text, by itself."""
        path = os.path.join(self.folder, ".block.pcg")
        with open(path, "w", encoding="utf-8") as out:
            out.write("\n".join(block.lines) + "\n")
        code, found = self.run("pcgc check .block.pcg")
        os.remove(path)
        self.report(code == 0, "%s:%d: the graph in the text" % (manual, block.line), found[:40])


def is_graph(block):
    return block.language == "pcg" and any(line.startswith("graph ") for line in block.lines) \
        and not any("…" in line for line in block.lines)


def read_manual(reader, manual, text):
    """Follows it; what its commands printed, by the number of the command's line."""
    printed = {}
    for block in blocks_of(text):
        if block.language == "console":
            for command in commands_of(block):
                printed[command.line] = (command, reader.follow(manual, command))
        elif block.name:
            reader.write(block)
        elif is_graph(block):
            reader.check(manual, block)
    return printed


def rewrite(path, text, printed):
    lines = text.split("\n")
    for number in sorted(printed, reverse=True):
        command, found = printed[number]
        if not fits(command.expected, found):
            lines[number:number + len(command.expected)] = found
    with open(path, "w", encoding="utf-8") as out:
        out.write("\n".join(lines))


def main():
    arguments = sys.argv[1:]
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    pcgc = os.environ.get("PCGC", os.path.join(root, "build", "pcgc"))
    failed = 0
    for path in [a for a in arguments if a != "--rewrite"]:
        with open(path, encoding="utf-8") as manual:
            text = manual.read()
        with tempfile.TemporaryDirectory(prefix="pcgc-manual-") as folder:
            reader = Reader(folder, root, os.path.abspath(pcgc))
            printed = read_manual(reader, os.path.relpath(path, root), text)
            failed += reader.failed
        if "--rewrite" in arguments:
            rewrite(path, text, printed)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
