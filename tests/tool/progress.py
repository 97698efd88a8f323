"""The line of progress, as a real terminal gets it."""

import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import termios
import time

from expect import done_testing, report

PCGC = os.environ["PCGC"]
ERASE = "\r\x1b[K"


class Terminal:
    """Runs a command whose stderr is a terminal; keeps what it writes there, each piece with its time."""

    def __init__(self, command, columns=80, environment=None, interrupt_after=None):
        master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        variables = {k: v for k, v in os.environ.items() if k != "NO_COLOR"}
        variables.update({"TERM": "xterm"}, **(environment or {}))
        began = time.monotonic()
        process = subprocess.Popen(command, env=variables, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=slave, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        os.close(slave)
        self.pieces = []
        while True:
            ready = select.select([master], [], [], 0.05)[0]
            passed = time.monotonic() - began
            if interrupt_after and passed > interrupt_after:
                process.send_signal(signal.SIGINT)
                interrupt_after = None
            try:
                piece = os.read(master, 65536) if ready else None
            except OSError:
                break
            if piece == b"":
                break
            if piece:
                self.pieces.append((passed, piece))
        os.close(master)
        self.output = process.communicate()[0]
        self.code = process.returncode
        self.text = b"".join(p for _, p in self.pieces).decode("utf-8", "replace")

    def lines(self):
        """The lines of progress, in the order in which they were drawn."""
        return re.findall(r"\r([^\r\n\x1b]+)\x1b\[K", self.text)

    def left(self):
        """What the terminal shows in the end."""
        shown = ""
        for part in re.split(r"(\r\x1b\[K|\r\n|\r|\n)", self.text):
            if part == ERASE or part == "\r":
                shown = shown[:shown.rfind("\n") + 1]
            elif part in ("\n", "\r\n"):
                shown += "\n"
            else:
                shown += part.replace("\x1b[K", "")
        return shown


def write(name, text):
    with open(name, "w", encoding="utf-8") as f:
        f.write(text)


def shows_a_run():
    t = Terminal([PCGC, "run", "endless.pcg", "--max-seconds", "1500ms"])
    lines = t.lines()
    report(t.code == 4, "the limit on time was hit", t.text)
    report(len(lines) >= 5, "a line, drawn again and again", lines)
    report(all(re.fullmatch(r"[|/\\-] \d+\.\d s  .*", line) for line in lines), "with the time", lines)
    report(any(re.search(r"(again|on)  [\d,]+ rounds  1 entity$", line) for line in lines),
           "with node, rounds and entities", lines)
    report(t.pieces[0][0] >= 0.5, "not in the first half second", t.pieces[0])
    report("error: the run took longer" in t.left() and "rounds  " not in t.left(), "gone in the end", t.left())
    report(t.text.count(ERASE) < len(lines), "erased at its end, not between", t.text)


def fits_narrow_terminals():
    for columns in (12, 24):
        t = Terminal([PCGC, "run", "endless.pcg", "--max-seconds", "900ms"], columns=columns)
        lines = t.lines()
        report(lines and all(len(line) < columns for line in lines), "%d columns are enough" % columns, lines)


def stays_away():
    endless = [PCGC, "run", "endless.pcg", "--max-seconds", "900ms"]
    for what, variables in (("NO_COLOR", {"NO_COLOR": "1"}), ("TERM=dumb", {"TERM": "dumb"})):
        t = Terminal(endless, environment=variables)
        report(not t.lines() and "\x1b" not in t.text, what + ": no line", t.text)
    t = Terminal(endless + ["-q"])
    report(not t.lines(), "--quiet: no line", t.text)
    done = subprocess.run(endless, stderr=subprocess.PIPE, check=False)
    report(b"\r" not in done.stderr and b"\x1b" not in done.stderr, "no terminal: no line", done.stderr)
    t = Terminal([PCGC, "run", "quick.pcg"])
    report(t.code == 0 and not t.lines(), "a short run: no line", t.text)


def leaves_messages_alone():
    t = Terminal([PCGC, "run", "talking.pcg", "--max-seconds", "2s"])
    said = [line for line in t.left().split("\n") if "still here" in line]
    report(len(said) >= 2 and all(re.match(r"(talking\.pcg|note)", line) for line in said),
           "messages stand on lines of their own", said[:5], t.lines()[:3])


def is_cleared_by_an_interrupt():
    t = Terminal([PCGC, "run", "endless.pcg"], interrupt_after=0.9)
    report(t.code == 130 and t.lines(), "Ctrl+C", t.code, t.text)
    report(t.left() == "pcgc: interrupted\n", "clears the line", t.left())


def shows_writing():
    if "png" in os.environ.get("LEFT_OUT", "").split():
        return
    t = Terminal([PCGC, "run", "towers.pcg", "-o", "towers.png", "--size", "800x600"])
    report(t.code == 0 and any("writing towers.png" in line for line in t.lines()), "a picture", t.lines()[:5])
    report(t.left() == "", "nothing is left of it", t.left())


def shows_a_map():
    """Skipped where GDAL is missing: its graph cannot run then."""
    nodes, ways = [], []
    for i in range(60000):
        x, y = 9.5 + 0.0002 * (i % 300), 47.1 + 0.0002 * (i // 300)
        for k, (dx, dy) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1))):
            nodes.append('<node id="%d" lat="%.6f" lon="%.6f"/>' % (4 * i + k + 1, y + 1e-4 * dy, x + 1e-4 * dx))
        refs = "".join('<nd ref="%d"/>' % (4 * i + k % 4 + 1) for k in range(5))
        ways.append('<way id="%d">%s<tag k="building" v="yes"/></way>' % (i + 1, refs))
    write("map.osm", '<osm version="0.6">' + "".join(nodes + ways) + "</osm>")
    write("map.pcg", 'graph map {\n    m: read_map(file = "map.osm") { houses: polygons(where = "building") }\n}\n')
    t = Terminal([PCGC, "run", "map.pcg"])
    if "GDAL was left out" in t.text or "cannot be loaded" in t.text:
        return
    report(t.code == 0 and any(re.search(r" s  m\b", line) for line in t.lines()), "reading a map", t.lines()[:5],
           t.text[-300:])


def has_terminals():
    """Whether a terminal can be had: a chroot without /dev/pts has none."""
    try:
        for end in pty.openpty():
            os.close(end)
        return True
    except OSError:
        return False


def main():
    if not has_terminals():
        print("ok there is no terminal to be had here")
        return
    write("endless.pcg", "graph endless {\n    rectangle() -> again\n    again: translate(x = 1m) -> on: condition(true)\n    on.yes -> again\n}\n")
    write("quick.pcg", "graph quick { rectangle() }\n")
    write("talking.pcg", "graph talking {\n    attr i: int\n    rectangle() -> again\n    again: set { assign(@i, @i + 1) }"
          " -> slow: condition(@i % 200000 == 0)\n    slow.yes -> log(message = \"still here\") -> again\n"
          "    slow.no -> again\n}\n")
    write("towers.pcg", "graph towers {\n    attr i: int\n    impulse(count = 900, index => @i)\n        -> rectangle()\n"
          "        -> translate(x = 2m * (@i % 30), y = 2m * (@i / 30))\n        -> extrude(amount = 9m)\n"
          "        -> decompose()\n        -> split(axis = y, repeat = true) { absolute(0.5m) }\n}\n")
    shows_a_run()
    fits_narrow_terminals()
    stays_away()
    leaves_messages_alone()
    is_cleared_by_an_interrupt()
    shows_writing()
    shows_a_map()
    done_testing()


main()
