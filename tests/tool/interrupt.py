"""Interrupts pcgc at random moments while it compiles, runs, writes and has a compiler work for it.

Each time the exit code is 130 (or 0, where it was done before), it ends in time, and every file in the folder and
in the folder for temporary files is one that was to be made, whole. In time is what it still works for: what a busy
machine lets it wait is not its own.
"""

import os
import random
import shutil
import signal
import subprocess
import time

from expect import done_testing, report

PCGC = os.environ["PCGC"]
SIGNALS = (signal.SIGINT, signal.SIGTERM)
# The promise is a tenth of a second. A sanitizer makes all slow. The clock on the wall only says that it did not hang.
SECONDS, LATE_ALLOWED, PATIENCE = 0.1, 0.1, 20
TICK = 1 / os.sysconf("SC_CLK_TCK")
SANITIZED = bool(os.environ.get("SANITIZE"))
SIZE = 5 if SANITIZED else 1  # so many times smaller are the graphs

GRAPHS = {
    "endless.pcg": "graph endless {\n    rectangle() -> again\n    again: translate(x = 1m) -> again\n}\n",
    "towers.pcg": """graph towers {
    attr i: int
    impulse(count = %d, index => @i)
        -> rectangle(width = 3m, height = 3m)
        -> translate(x = 4m * (@i %% 60), y = 4m * (@i / 60))
        -> extrude(amount = rand(2m, 20m))
        -> decompose()
        -> split(axis = y, repeat = true) { absolute(1m) }
}
""" % (2000 // SIZE),
}


def long_graph(count):
    """A graph whose compilation takes a while."""
    lines = ["graph long {", "    rectangle()"]
    lines += ["        -> n%d: translate(x = %dm + 2m * sin(%ddeg))" % (i, i, i) for i in range(count)]
    return "\n".join(lines + ["}", ""])


def start(folder, arguments):
    def default_signals():
        for which in SIGNALS:
            signal.signal(which, signal.SIG_DFL)
    environment = dict(os.environ, TMPDIR=os.path.join(folder, "tmp"), CCACHE_DISABLE="1")
    return subprocess.Popen([PCGC] + arguments, cwd=folder, env=environment, preexec_fn=default_signals,
                            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def contents(folder):
    found = {}
    for root, _, files in os.walk(folder):
        for name in files:
            path = os.path.join(root, name)
            with open(path, "rb") as f:
                found[os.path.relpath(path, folder)] = f.read()
    return found


def fresh_folder():
    folder = os.path.join(os.getcwd(), "work")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(os.path.join(folder, "tmp"))
    for name, text in GRAPHS.items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as f:
            f.write(text)
    return folder


def worked(process):
    """The seconds that a process has worked so far, as the system counts them, in ticks."""
    with open("/proc/%d/stat" % process.pid, encoding="utf-8", errors="replace") as f:
        fields = f.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) * TICK


def has_ended(process):
    """Whether it has; it is left there, so that one can still ask how long it worked."""
    return os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT | os.WNOHANG) is not None


def wait_until_it_listens(process):
    """A signal that comes while the process is still being started ends it as it ends any other."""
    listens = False
    while not listens and not has_ended(process):
        with open("/proc/%d/status" % process.pid, encoding="utf-8", errors="replace") as f:
            blocked = [int(line.split()[1], 16) for line in f if line.startswith("SigBlk:")]
        listens = all(blocked[0] >> (which - 1) & 1 for which in SIGNALS)  # a thread waits for them
        time.sleep(0.001)


def result_of(process):
    """What it said, its exit code, and the seconds that it worked in all, without its children."""
    said = process.stderr.read().decode("utf-8", "replace")
    os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
    seconds = worked(process)
    process.wait()
    process.stderr.close()
    return said, process.returncode, seconds


def interrupt_once(arguments, delay, again):
    """How long it worked until it ended, and waited, its exit code, what it said, what is in the folder then."""
    folder = fresh_folder()
    process = start(folder, arguments)
    wait_until_it_listens(process)
    time.sleep(delay)
    sent, before = time.monotonic(), worked(process)
    which = random.choice(SIGNALS)
    os.kill(process.pid, which)
    if again:
        time.sleep(random.uniform(0, 0.01))
        os.kill(process.pid, which)
    said, code, seconds = result_of(process)
    return seconds - before, time.monotonic() - sent, code, said, contents(folder)


def interrupts(what, arguments, times, expected, longest):
    wrong, late, stopped = [], 0, 0
    times = times // 3 + 1 if SANITIZED else times
    for k in range(times):
        delay = random.uniform(0, longest)
        seconds, waited, code, said, found = interrupt_once(arguments, delay, k % 4 == 3)
        late += seconds > SECONDS + TICK or waited > PATIENCE
        stopped += code == 130
        if code not in (0, 130) or (code == 130 and "pcgc: interrupted\n" not in said):
            wrong.append("after %.3f s: exit code %d, %s" % (delay, code, said))
        for name, content in found.items():
            if expected.get(name) != content:
                wrong.append("after %.3f s: left %s, %d bytes" % (delay, name, len(content)))
    report(not wrong, "%s: nothing half-written is left" % what, *wrong[:8])
    report(stopped > times // 8, "%s: was interrupted" % what, "%d of %d" % (stopped, times))
    report(SANITIZED or late <= LATE_ALLOWED * times, "%s: ended in time" % what, "%d of %d were late" % (late, times))


def complete(arguments):
    """What is in the folder when nobody interrupts, and how long that takes."""
    folder = fresh_folder()
    began = time.monotonic()
    process = start(folder, arguments)
    said = process.communicate()[1].decode("utf-8", "replace")
    report(process.returncode == 0, "uninterrupted: " + " ".join(arguments), said)
    return contents(folder), time.monotonic() - began


def main():
    random.seed(1)
    GRAPHS["long.pcg"] = long_graph(3000 // SIZE)
    GRAPHS["longer.pcg"] = long_graph(30000 // SIZE)
    cases = [
        ("compiling", ["check", "longer.pcg"], 10),
        ("to a shared object", ["long.pcg", "-o", "long.so"], 10),
        ("to C", ["long.pcg", "-o", "long.c"], 10),
        ("writing a model", ["run", "towers.pcg", "-q", "-o", "towers.glb"], 15),
        ("writing two files at once", ["run", "towers.pcg", "-q", "-o", "towers.obj"], 15),
        ("writing a picture", ["run", "towers.pcg", "-q", "-o", "towers.png", "--size", "400x300"], 15),
        ("in a C compiler", ["towers.pcg", "--cc", "-o", "towers.so"], 15),
        ("linking", ["towers.pcg", "-o", "towers"], 10),
    ]
    for what, arguments, times in cases:
        if what == "writing a picture" and "png" in os.environ.get("LEFT_OUT", "").split():
            continue
        expected, seconds = complete(arguments)
        interrupts(what, arguments, times, expected, max(0.05, seconds))
    untouched = contents(fresh_folder())
    interrupts("running", ["run", "endless.pcg", "-o", "endless.glb"], 10, untouched, 0.3)
    done_testing()


main()
