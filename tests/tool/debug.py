"""What pcgc debug shows of a round when it happens is what it shows later; Ctrl+C stops a run into the debugger."""

import glob
import os
import pty
import re
import select
import signal
import subprocess
import time

from expect import done_testing, report

PCGC, ROOT = os.environ["PCGC"], os.environ["ROOT"]
ROUNDS = 40
LOOK = ["queues", "print", "parameters", "where", "step"] * ROUNDS


def first_difference(one, other):
    for a, b in zip(one, other):
        if a != b:
            return a, b
    return ()


def look_twice(path):
    commands = "\n".join(LOOK + ["goto 1"] + LOOK) + "\n"
    done = subprocess.run([PCGC, "debug", os.path.basename(path), "--batch", "-"], input=commands.encode(),
                          cwd=os.path.dirname(path), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    before, _, after = done.stdout.decode().partition("(pcgc) goto 1\n")
    before = before.splitlines()
    after = re.sub(r" of \d+ so far", "", after).splitlines()
    difference = first_difference(before, after)
    report(done.returncode == 0 and len(before) > 20 and not difference and len(after) >= len(before) - 1,
           "%s looks the same afterwards" % os.path.basename(path), done.returncode, *difference)


def begin(commands):
    def default_signals():
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    run = subprocess.Popen([PCGC, "debug", "endless.pcg", "--history", "1M"], preexec_fn=default_signals,
                           stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    run.stdin.write(commands)
    run.stdin.flush()
    time.sleep(0.5)
    return run


def interrupt_running():
    run = begin(b"continue\n")
    run.send_signal(signal.SIGINT)
    time.sleep(0.2)
    out, err = run.communicate(b"print @turn\nback 3\nqueues\ngoto 2\n", timeout=60)
    text = out.decode()
    report(run.returncode == 0 and "interrupted: round " in text and "@turn = " in text, "Ctrl+C stops a run",
           run.returncode, text[-500:], err)
    report("are no longer recorded" in text, "what is old is given up", text[-500:])


def interrupt_waiting():
    run = begin(b"step\n")
    run.send_signal(signal.SIGINT)
    run.wait(timeout=60)
    out, err = run.communicate(timeout=60)
    report(run.returncode == 130 and b"interrupted" in err, "Ctrl+C while a command is waited for ends it",
           run.returncode, err)


def end_by_signal():
    run = begin(b"continue\n")
    run.send_signal(signal.SIGTERM)
    _, err = run.communicate(timeout=60)
    report(run.returncode == 130, "SIGTERM ends a run", run.returncode, err)


class Terminal:
    """The debugger at a terminal of its own."""

    def __init__(self, path):
        self.child, self.end = pty.fork()
        if self.child == 0:
            signal.signal(signal.SIGINT, signal.SIG_DFL)
            os.execv(PCGC, [PCGC, "debug", path])

    def read(self):
        """What is printed up to the next prompt, or the end."""
        text, until = b"", time.monotonic() + 30
        while not text.endswith(b"(pcgc) ") and time.monotonic() < until:
            if select.select([self.end], [], [], 0.1)[0]:
                try:
                    piece = os.read(self.end, 4096)
                except OSError:  # the other end is closed
                    break
                text += piece
                if not piece:
                    break
        return text.decode("utf-8", "replace")

    def answer(self, typed):
        os.write(self.end, typed)
        return self.read()

    def close(self):
        os.close(self.end)
        return os.waitstatus_to_exitcode(os.waitpid(self.child, 0)[1])


def at_terminal():
    try:
        for end in pty.openpty():
            os.close(end)
    except OSError:
        report(True, "there is no terminal to be had here: passed over")
        return
    t = Terminal("endless.pcg")
    report("round 1: 'rectangle'" in t.read(), "at a terminal it begins at the first round")
    report("round 2: 'again'" in t.answer(b"step\n"), "and asks for commands")
    report("round 3: 'more'" in t.answer(b"\n"), "an empty line steps again")
    report("endless:" in t.answer(b"queues\n"), "queues")
    os.write(t.end, b"continue\n")
    time.sleep(0.5)
    report("interrupted: round " in t.answer(b"\x03"), "Ctrl+C stops the run")
    report("@turn = " in t.answer(b"print @turn\n"), "and one can look around")
    report("(pcgc)" not in t.answer(b"\x04"), "the end of the input ends it")
    report(t.close() == 0, "cleanly")


for path in sorted(glob.glob(ROOT + "/examples/figures/figure_*.pcg")) + [ROOT + "/examples/house.pcg"]:
    look_twice(path)
at_terminal()
interrupt_running()
interrupt_waiting()
end_by_signal()
done_testing()
