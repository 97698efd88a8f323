#!/usr/bin/env python3
"""Runs the project's tests; tests/README.md says what a test file looks like.

    tests/run.py [--build FOLDER] [-k WORD] [-j N] [-v] [--list]

Prints what failed and ends with the line `N passed, N failed`, which counts expectations.
"""

import argparse
import concurrent.futures
import glob
import itertools
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
TIMEOUT = 300  # seconds, of one process
PASSES = ("parse", "check", "order")
RUNS = ("run", "limits", "regress")
CRASH = re.compile(r"AddressSanitizer|LeakSanitizer|runtime error:|UndefinedBehaviorSanitizer")


class Failure(Exception):
    """An expectation that does not hold: one message, maybe of several lines."""


class Report:
    """What came of the expectations of one test."""

    def __init__(self):
        self.passed = self.failed = 0
        self.messages = []

    def fail(self, message, count=1):
        self.failed += count
        self.messages.append(message)

    def check(self, holds, message):
        """Counts one expectation. `message` is a string, or makes one when called."""
        if holds:
            self.passed += 1
        else:
            self.fail(message() if callable(message) else message)
        return holds


class Process:
    """A finished process: code, out, err (bytes)."""

    def __init__(self, command, stdin=b"", cwd=ROOT, env=None):
        self.command = command
        try:
            done = subprocess.run(command, input=stdin, cwd=cwd, env=env, timeout=TIMEOUT,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
            self.code, self.out, self.err = done.returncode, done.stdout, done.stderr
        except subprocess.TimeoutExpired as e:
            self.code, self.out = "timeout", e.stdout or b""
            self.err = (e.stderr or b"") + b"\n(stopped after %d s)" % TIMEOUT
        except OSError as e:
            self.code, self.out, self.err = "none", b"", str(e).encode()

    def describe(self):
        return "%s\nexit code %s\n%s" % (shlex.join(self.command), self.code, indent(self.err))

    def crashed(self):
        return (not isinstance(self.code, int) or self.code < 0 or self.code == 70
                or CRASH.search(text_of(self.err)) is not None)


def text_of(data):
    return data.decode("utf-8", "replace")


def indent(data, limit=40):
    lines = text_of(data).splitlines() if isinstance(data, bytes) else data.splitlines()
    if len(lines) > limit:
        lines = lines[:limit] + ["… %d more lines" % (len(lines) - limit)]
    return "\n".join("    " + line for line in lines)


# ---- expectations in a file ----------------------------------------------------------------------

PLACE = re.compile(r"^(?:(?P<file>\S+\.pcg):)?(?P<line>\d+):(?P<column>\d+)\s+")
DIAGNOSTIC = re.compile(r"^(?P<severity>error|warning|note)\s+(?P<code>[A-Z]\d{4})"
                        r"(?::\s*(?P<text>.*))?$")


class Section:
    """One run of a file: its options and what it must give."""

    def __init__(self, options, line):
        self.options, self.line = options, line
        self.exit_code = None
        self.messages = []
        self.values = []

    def empty(self):
        return not (self.options or self.messages or self.values) and self.exit_code is None


class TestFile:
    """A .pcg with what it expects."""

    def __init__(self, path):
        self.path = path
        self.diagnostics = []  # dictionaries: file, line, column, severity, code, text
        self.dump = []
        self.sections = [Section([], 1)]
        with open(os.path.join(ROOT, path), "rb") as f:
            lines = text_of(f.read()).split("\n")
        for number, line in enumerate(lines, 1):
            self.read_line(number, line.rstrip("\r"))

    def read_line(self, number, line):
        if line.startswith("//= ") or line == "//=":
            self.dump.append(line[4:])
        elif line.startswith("//?"):
            self.read_run(number, line[3:].strip())
        elif "//~" in line:
            for part in line.split("//~")[1:]:
                self.read_diagnostic(number, part.strip())

    def read_diagnostic(self, number, part):
        if part.strip().startswith("help: ") and self.diagnostics:
            self.diagnostics[-1]["help"] = part.strip()[len("help: "):]
            return
        place = PLACE.match(part)
        found = DIAGNOSTIC.match(part[place.end():] if place else part)
        if not found:
            raise Failure("%s:%d: not an expectation: '//~ %s'" % (self.path, number, part))
        expected = found.groupdict()
        expected["file"] = place["file"] if place else None
        expected["line"] = int(place["line"]) if place else number
        expected["column"] = int(place["column"]) if place else None
        self.diagnostics.append(expected)

    def read_run(self, number, text):
        word, _, rest = text.partition(" ")
        section = self.sections[-1]
        if word == "run":
            if not section.empty():
                section = Section([], number)
                self.sections.append(section)
            section.options = shlex.split(rest)
        elif word == "exit" and rest.strip().isdigit():
            section.exit_code = int(rest)
        elif word == "message":
            section.messages.append((number, rest.strip()))
        else:
            value = re.match(r"^(.*?)\s*([=~])\s*(.*)$", text)
            if not value:
                raise Failure("%s:%d: not an expectation: '//? %s'" % (self.path, number, text))
            section.values.append((number, value[1], value[2], value[3]))

    def expects_errors(self):
        return any(d["severity"] == "error" for d in self.diagnostics)


# ---- diagnostics ---------------------------------------------------------------------------------

def read_messages(err):
    """The messages of --message-format=json, and the lines that are none."""
    messages, others = [], []
    for line in text_of(err).splitlines():
        try:
            message = json.loads(line)
            messages.append(message if isinstance(message, dict) else {"message": line})
        except ValueError:
            others.append(line)
    return messages, others


def show_message(m):
    place = "%s:%s:%s: " % (m.get("file"), m.get("line"), m.get("column")) if m.get("file") else ""
    return "%s%s %s: %s" % (place, m.get("severity", ""), m.get("code", ""), m.get("message", ""))


def show_expected(path, d):
    column = ":%d" % d["column"] if d["column"] else ""
    advice = "; help: " + d["help"] if "help" in d else ""
    return "%s:%d%s: %s %s: %s%s" % (d["file"] or path, d["line"], column, d["severity"], d["code"],
                                     d["text"] if d["text"] is not None else "(any text)", advice)


def fits(path, expected, m):
    file = m.get("file") or ""
    same_file = (file.endswith("/" + expected["file"]) if expected["file"]
                 else os.path.normpath(file) == os.path.normpath(path))
    return (same_file and m.get("line") == expected["line"]
            and (expected["column"] is None or m.get("column") == expected["column"])
            and m.get("severity") == expected["severity"] and m.get("code") == expected["code"]
            and (expected["text"] is None or m.get("message") == expected["text"])
            and expected.get("help", m.get("help")) in (m.get("help"), m.get("label")))


def check_diagnostics(report, test, messages):
    """Each expected one must be there once; returns those that nobody expected."""
    left = [m for m in messages if m.get("severity") in ("error", "warning")]
    for expected in test.diagnostics:
        found = next((m for m in left if fits(test.path, expected, m)), None)
        if found:
            left.remove(found)
        near = [show_message(m) + "; help: %s" % (m.get("help") or m.get("label")) for m in messages if m.get("line") == expected["line"]]
        report.check(found, lambda e=expected, n=near: "expected %s%s" % (
            show_expected(test.path, e), "".join("\n  found %s" % x for x in n)))
    return left


# ---- passes --------------------------------------------------------------------------------------

def test_pass(context, path):
    """parse/, check/, order/: diagnostics, and the dump behind the pass."""
    report = Report()
    test = TestFile(path)
    name = path.split("/")[1]
    done = Process([context.pcgc, "--dump=" + name, "--message-format=json", path])
    if done.crashed():
        report.fail(done.describe())
        return report
    messages, others = read_messages(done.err)
    left = check_diagnostics(report, test, messages)
    code = 1 if test.expects_errors() else 0
    report.check(not left and not others and done.code == code,
                 lambda: "unexpected: exit code %s, expected %s\n%s" % (
                     done.code, code, "\n".join([show_message(m) for m in left] + others)))
    if test.dump:
        found = text_of(done.out).rstrip("\n").split("\n")
        for i, line in enumerate(test.dump):
            there = found[i] if i < len(found) else "(nothing)"
            report.check(line == there, "dump, line %d\n  expected %s\n  found    %s" % (
                i + 1, line, there))
        report.check(len(found) <= len(test.dump),
                     lambda: "dump: more lines than expected, from\n    %s" % found[len(test.dump)])
    return report


# ---- runs ----------------------------------------------------------------------------------------

TOKEN = re.compile(r"\.?([A-Za-z_][A-Za-z_0-9]*)|\[(-?\d+)\]")


def walk(value, path):
    """The part of a JSON value that `entities[0].attributes.floor` names."""
    at = 0
    while at < len(path):
        token = TOKEN.match(path, at)
        if not token:
            raise Failure("cannot read '%s'" % path)
        try:
            value = value[token[1]] if token[1] else value[int(token[2])]
        except (KeyError, IndexError, TypeError):
            raise Failure("there is no '%s'" % path) from None
        at = token.end()
    return value


def find_value(result, path):
    """By output and field; without an output the sum over all."""
    outputs = result.get("outputs", [])
    ports = sorted((o["port"] for o in outputs), key=len, reverse=True)
    for port in ports:
        if path.startswith(port + "."):
            return walk(next(o for o in outputs if o["port"] == port), path[len(port) + 1:])
    ends = [o for o in outputs if path.startswith(o["port"].rpartition(".")[2] + ".")]
    if len(ends) == 1:  # `yes.count` of the only port that is called so
        return walk(ends[0], path.partition(".")[2])
    if not re.match(r"^[A-Za-z_]+$", path):
        raise Failure("no output fits '%s'; there are: %s" % (path, ", ".join(ports) or "none"))
    values = [o[path] for o in outputs if path in o]
    if outputs and not values:
        raise Failure("no output has a field '%s'" % path)
    return sum(values)


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def same_value(found, expected, near):
    if isinstance(found, list) and isinstance(expected, list):
        return len(found) == len(expected) and all(
            same_value(f, e, near) for f, e in zip(found, expected))
    if near and is_number(found) and is_number(expected):
        return abs(found - expected) <= max(1e-9, 1e-6 * max(abs(found), abs(expected)))
    return type(found) is type(expected) and found == expected or (
        is_number(found) and is_number(expected) and found == expected)


def check_values(report, test, section, result):
    for line, path, comparison, text in section.values:
        try:
            expected = json.loads(text)
        except ValueError:
            expected = text
        try:
            found = find_value(result, path)
            report.check(same_value(found, expected, comparison == "~"),
                         "%s:%d: expected %s %s %s, found %s" % (
                             test.path, line, path, comparison, text, json.dumps(found)))
        except Failure as e:
            report.fail("%s:%d: %s" % (test.path, line, e))


def message_fits(expected, m):
    """`W0501 text`, or text alone: of one message, or of a line that is none."""
    if isinstance(m, str):
        return expected in m
    code, _, rest = expected.partition(" ")
    if re.match(r"^[A-Z]\d{4}$", code):
        return m.get("code") == code and rest in m.get("message", "")
    return expected in m.get("message", "")


def check_messages(report, test, section, done):
    messages, others = read_messages(done.err)
    left = check_diagnostics(report, test, messages)
    for line, expected in section.messages:
        found = [m for m in messages + others if message_fits(expected, m)]
        report.check(found, lambda l=line, e=expected: "%s:%d: expected message '%s' in\n%s" % (
            test.path, l, e, indent(done.err)))
        left = [m for m in left if m not in found]
        others = [o for o in others if o not in found]
    # Examples of interfaces cannot say which warnings they mean.
    if "gen/examples/" not in test.path:
        report.check(not left, lambda: "unexpected:\n%s" % "\n".join(show_message(m) for m in left))


def run_graph(context, what, section, folder, name):
    """One run: its process, and the GLB that it wrote (None where it wrote none)."""
    glb = os.path.join(folder, name + ".glb")
    done = Process([context.pcgc, "run", what, *section.options, "--json", "--entities",
                    "--message-format=json", "-o", glb])
    model = None
    if os.path.exists(glb):
        with open(glb, "rb") as f:
            model = f.read()
    return done, model


def check_same(report, first, second, what):
    """Two runs must agree in code, results and model, to the byte."""
    (a, model_a), (b, model_b) = first, second
    if b.crashed():
        report.fail(b.describe())
        return
    report.check(a.code == b.code and a.out == b.out, lambda: "%s: not the same results\n%s\n%s" % (
        what, b.describe(), difference(a.out, b.out)))
    report.check(model_a == model_b, "%s: not the same GLB" % what)


def difference(a, b):
    lines_a, lines_b = text_of(a).split("\n"), text_of(b).split("\n")
    for i, (x, y) in enumerate(zip(lines_a, lines_b)):
        if x != y:
            return "    line %d\n    %s\n    %s" % (i + 1, x[:200], y[:200])
    return "    one has more lines: %d and %d" % (len(lines_a), len(lines_b))


def check_section(context, report, test, section, shared, folder):
    first = run_graph(context, test.path, section, folder, "first")
    done = first[0]
    if done.crashed():
        report.fail(done.describe())
        return
    code = section.exit_code if section.exit_code is not None else 1 if test.expects_errors() else 0
    report.check(done.code == code, lambda: "expected exit code %d\n%s" % (code, done.describe()))
    check_messages(report, test, section, done)
    if section.values:
        try:
            check_values(report, test, section, json.loads(done.out))
        except ValueError as e:
            report.fail("stdout is no JSON: %s\n%s" % (e, done.describe()))
    again = run_graph(context, test.path, section, folder, "again")
    check_same(report, first, again, "a second run")
    if shared:
        check_same(report, first, run_graph(context, shared, section, folder, "shared"),
                   "the shared object of cc -O2")
    context.keep_model("%s-%d" % (test.path[:-4], section.line), first[1])


def test_run(context, path):
    """run/, limits/, regress/, examples: by libtcc, again, and by cc -O2."""
    report = Report()
    test = TestFile(path)
    with tempfile.TemporaryDirectory(prefix="pcgc-test-") as folder:
        shared = None
        if not test.expects_errors():
            shared = os.path.join(folder, os.path.basename(path)[:-4] + ".so")
            made = Process([context.pcgc, path, "--cc=" + context.cc, "-o", shared])
            if not report.check(made.code == 0 and os.path.exists(shared), made.describe):
                shared = None
        for section in test.sections:
            check_section(context, report, test, section, shared, folder)
    return report


# ---- programs ------------------------------------------------------------------------------------

LINE = re.compile(r"^(not )?ok\b")
TOTAL = re.compile(r"^(\d+) passed, (\d+) failed$")


def test_program(context, path):
    """unit/, api/, tool/: lines `ok what` and `not ok what: why`, or a total as the last line."""
    report = Report()
    with tempfile.TemporaryDirectory(prefix="pcgc-test-") as folder:
        env = dict(os.environ, PCGC=context.pcgc, BUILD=context.build, ROOT=ROOT, CC=context.cc,
                   LC_ALL="C.UTF-8", PATH=context.path)
        command = ["sh", os.path.join(ROOT, path)] if path.endswith(".sh") else [path]
        done = Process(command, cwd=folder, env=env)
    lines = text_of(done.out).splitlines()
    total = TOTAL.match(lines[-1]) if lines else None
    counted = int(total[1]) + int(total[2]) if total else 0
    if total:
        report.passed += int(total[1])
    if total and int(total[2]):
        report.fail(done.describe() + "\n" + indent(done.out, 200), int(total[2]))
    for i, line in enumerate(lines):
        result = LINE.match(line)
        if result and not total:
            counted += 1
            details = list(itertools.takewhile(lambda x: x.startswith((" ", "\t", "#")),
                                               lines[i + 1:i + 40]))
            report.check(not result[1], "\n".join([line] + details) + "\n" + indent(done.err))
    bad_exit = done.code != 0 and not report.failed
    report.check(not done.crashed() and not bad_exit and counted > 0,
                 lambda: "%d results\n%s" % (counted, done.describe()))
    return report


# ---- all of them ---------------------------------------------------------------------------------

class Context:
    """What the tests share."""

    def __init__(self, build, cc, sanitize):
        self.build = os.path.abspath(build)
        self.pcgc = os.path.join(self.build, "pcgc")
        self.cc, self.path = cc, os.environ["PATH"]
        if sanitize:
            self.sanitize(sanitize)
        self.models = os.path.join(self.build, "models")
        shutil.rmtree(self.models, ignore_errors=True)
        os.makedirs(self.models)

    def sanitize(self, kinds):
        """What is linked with a sanitized runtime must be sanitized: `cc` becomes what does so. A
        compiler cache looks for the compiler on the path, and must not find `cc` there again."""
        folder = os.path.join(self.build, "bin")
        os.makedirs(folder, exist_ok=True)
        wrapper = os.path.join(folder, "cc")
        with open(wrapper, "w", encoding="utf-8") as f:
            f.write('#!/bin/sh\nPATH=%s\nexec %s -fsanitize=%s -fno-sanitize-recover=all "$@"\n' % (
                shlex.quote(self.path), shlex.quote(shutil.which(self.cc) or self.cc), kinds))
        os.chmod(wrapper, 0o755)
        self.cc, self.path = wrapper, folder + os.pathsep + self.path
        os.environ["SANITIZE"] = kinds
        # What loads a sanitized library without being sanitized has this loaded first.
        for name in ("libasan.so", "libclang_rt.asan-%s.so" % os.uname().machine):  # clang knows both
            runtime = subprocess.run([wrapper, "-print-file-name=" + name], stdout=subprocess.PIPE,
                                     check=False).stdout.decode().strip()
            if "address" in kinds and os.path.isabs(runtime):
                os.environ["ASAN_LIBRARY"] = runtime

    def keep_model(self, name, model):
        """The GLBs of all runs are kept for the validator (tests/tool/validate_glb.mjs)."""
        if model is not None:
            with open(os.path.join(self.models, name.replace("/", "_") + ".glb"), "wb") as f:
                f.write(model)


def find_tests(build):
    """(function, path) of each, by path."""
    tests = []

    def add(function, pattern):
        for path in sorted(glob.glob(os.path.join(ROOT, pattern))):
            tests.append((function, os.path.relpath(path, ROOT)))

    for name in PASSES:
        add(test_pass, "tests/%s/*.pcg" % name)
    for name in RUNS:
        add(test_run, "tests/%s/*.pcg" % name)
    for folder in ("", "lessons/", "figures/"):
        add(test_run, "examples/%s*.pcg" % folder)
    add(test_run, os.path.join(os.path.abspath(build), "gen/examples/*.pcg"))
    add(test_program, "tests/tool/*.sh")
    for kind in ("unit", "api"):
        for source in sorted(glob.glob(os.path.join(ROOT, "tests", kind, "*.c"))):
            program = os.path.basename(source)[:-2]
            path = os.path.join(os.path.abspath(build), "tests", kind, program)
            tests.append((test_program, path))
    return tests


def run_test(function, context, path):
    try:
        return function(context, path)
    except Failure as e:
        report = Report()
        report.fail(str(e))
        return report


def parse_arguments():
    parser = argparse.ArgumentParser(description="Runs the tests.")
    parser.add_argument("--build", default="build", help="the build folder (build)")
    parser.add_argument("-k", default="", metavar="WORD", help="only tests whose path holds it")
    parser.add_argument("-j", type=int, default=os.cpu_count() or 2, help="at the same time")
    parser.add_argument("-v", action="store_true", help="name the tests that passed, too")
    parser.add_argument("--list", action="store_true", help="print their paths, run nothing")
    parser.add_argument("--cc", default=os.environ.get("CC", "cc"), help="compiler behind --cc")
    parser.add_argument("--sanitize", default="", metavar="KINDS",
                        help="what the build is sanitized with")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    tests = [t for t in find_tests(arguments.build) if arguments.k in t[1]]
    if arguments.list:
        print("\n".join(path for _, path in tests))
        return 0
    context = Context(arguments.build, arguments.cc, arguments.sanitize)
    passed = failed = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.j) as pool:
        reports = [pool.submit(run_test, function, context, path) for function, path in tests]
        for (_, path), future in zip(tests, reports):
            report = future.result()
            passed += report.passed
            failed += report.failed
            for message in report.messages:
                print("FAILED %s: %s\n" % (path, message), flush=True)
            if arguments.v and not report.failed:
                print("ok %s (%d)" % (path, report.passed), flush=True)
    if not tests:
        print("no test's path holds '%s'" % arguments.k)
        failed += 1
    print("%d passed, %d failed" % (passed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
