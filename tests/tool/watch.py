"""Watches a graph while its files are saved as editors save them."""

import os
import queue
import signal
import subprocess
import threading
import time

from expect import done_testing, report

PCGC = os.environ["PCGC"]
PATIENCE = 30  # seconds for one run, on a machine that has other things to do
CALM = 0.7     # after which nothing more is expected

HOUSE = """import part from "parts/part.pcg"
graph house {
    attr file: path
    rectangle(width = 2m) -> part() -> random_file_from_folder(folder = "skins", file => @file)
        -> texture(file = "skins/wall.jpg")
}
"""
PART = "graph part {\n    in in: Shape = rectangle()\n    out out: Shape\n    in -> extrude(amount = %dm) -> out\n}\n"


def write(name, text):
    with open(name, "w", encoding="utf-8") as f:
        f.write(text)


class Watcher:
    def __init__(self, *arguments):
        self.process = subprocess.Popen([PCGC, "watch", *arguments], stderr=subprocess.PIPE, text=True,
                                        stdout=subprocess.DEVNULL,
                                        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        self.lines = queue.Queue()
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        for line in self.process.stderr:
            self.lines.put(line.rstrip("\n"))

    def round(self):
        """What it says up to the line that sums a run up."""
        said, until = [], time.monotonic() + PATIENCE
        while time.monotonic() < until:
            try:
                said.append(self.lines.get(timeout=0.1))
            except queue.Empty:
                continue
            if " ms" in said[-1] and " error" in said[-1]:
                return said
        return said + ["(nothing more came)"]

    def calm(self):
        """What it says although nothing has happened."""
        time.sleep(CALM)
        said = []
        while not self.lines.empty():
            said.append(self.lines.get())
        return said

    def stop(self):
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(PATIENCE)


def expect(watcher, what, *parts):
    said = watcher.round()
    report(all(any(part in line for line in said) for part in parts), what, *said)
    calm = watcher.calm()
    report(not calm, what + ": once", *calm)


def saves():
    w = Watcher("house.pcg", "-o", "house.obj", "-o", "skins/own.json")
    expect(w, "the first run", "house.pcg: 1 entity, 6 faces, 0 errors")
    before = os.stat("house.obj").st_ino

    write("parts/part.pcg", PART % 4)
    expect(w, "an import, in place", "changed: parts/part.pcg", "house.pcg: 1 entity")
    report(os.stat("house.obj").st_ino != before, "what it writes appears anew, whole")

    write("new.tmp", HOUSE.replace("width = 2m", "width = 3m"))
    os.rename("new.tmp", "house.pcg")
    expect(w, "the graph, another file in its place", "changed: house.pcg", "0 errors")

    os.rename("house.pcg", "house.pcg~")
    time.sleep(0.05)
    write("house.pcg", HOUSE)
    os.remove("house.pcg~")
    expect(w, "the graph, written anew after it was moved away", "changed: house.pcg", "0 errors")

    for i in range(5):
        write("house.pcg", HOUSE.replace("2m", "%dm" % (3 + i)))
        time.sleep(0.01)
    expect(w, "several writes in one save", "changed: house.pcg")

    write("skins/wall.jpg", "no image, but another one")
    expect(w, "a texture", "skins/wall.jpg")

    write("skins/second.jpg", "")
    expect(w, "a file that is new in a folder", "changed:", "skins")

    write("house.pcg", HOUSE.replace("width", "widht"))
    expect(w, "an error", "did you mean 'width'?", "^~~~~", "house.pcg: 1 error, 0 warnings")
    write("house.pcg", HOUSE)
    expect(w, "and mended", "changed: house.pcg", "6 faces, 0 errors")

    os.remove("parts/part.pcg")
    expect(w, "an import that is gone", "there is no such file", "1 error")
    write("parts/part.pcg", PART % 5)
    expect(w, "and is back", "changed: parts/part.pcg", "0 errors")

    write("beside.pcg", "graph beside { box() }\n")
    report(not w.calm(), "other files do not count")
    report(w.stop() == 130, "Ctrl+C ends it", w.process.returncode)
    left = [name for _, _, files in os.walk(".") for name in files if "part-" in name or name.endswith(".part")]
    report(not left, "nothing half-written is left", *left)


def stops_while_it_runs():
    write("endless.pcg", "graph endless {\n    rectangle() -> again\n    again: translate(x = 1m) -> on: condition(true)\n"
          "    on.yes -> again\n}\n")
    w = Watcher("endless.pcg")
    time.sleep(0.5)
    report(w.stop() == 130, "Ctrl+C ends it while it runs", w.process.returncode)


def refuses():
    done = subprocess.run([PCGC, "watch", "-"], stderr=subprocess.PIPE, text=True, check=False)
    report(done.returncode == 2 and "cannot be watched" in done.stderr, "standard input", done.stderr)


def waits_for_a_file():
    w = Watcher("later/late.pcg")
    said = w.lines.get(timeout=PATIENCE)
    report("cannot read 'later/late.pcg'" in said, "a file that is not there yet", said)
    expect(w, "is waited for", "waiting")
    os.mkdir("later")
    time.sleep(0.2)
    write("later/late.pcg", "graph late { box() }\n")
    expect(w, "and run when it comes", "changed: later/late.pcg", "6 faces")
    report(w.stop() == 130, "until Ctrl+C", w.process.returncode)


def main():
    os.makedirs("parts")
    os.makedirs("skins")
    write("house.pcg", HOUSE)
    write("parts/part.pcg", PART % 3)
    write("skins/wall.jpg", "no image")
    saves()
    stops_while_it_runs()
    refuses()
    waits_for_a_file()
    done_testing()


main()
