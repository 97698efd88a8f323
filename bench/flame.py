#!/usr/bin/env python3
"""Draws a flame graph: how wide a box is, is how much time was spent in it and in what it called.

    perf record -g -o w1.perf build/pcgc run bench/facade_city.pcg -p lots=10000 -q -o city.glb
    perf script -i w1.perf | bench/flame.py --title "W1" >w1.svg
    pcgc profile house.pcg --stacks house.folded && bench/flame.py <house.folded >house.svg

Reads what `perf script` prints, or folded stacks: lines of frames with semicolons between them, and a number.
"""

import argparse
import html
import re
import sys

WIDTH, ROW, CHARACTER = 1180, 17, 6.3  # pixels
FRAME = re.compile(r"^\s+[0-9a-f]+\s+(.*?)\s+\((.*)\)$")
# What the machine code is called that libtcc has made of a graph: it has no names.
GRAPH, KERNEL = "(the graph's code)", "(the kernel)"


class Box:
    def __init__(self, name):
        self.name, self.weight, self.inside = name, 0, {}

    def add(self, frames, weight):
        box = self
        box.weight += weight
        for name in frames:
            box = box.inside.setdefault(name, Box(name))
            box.weight += weight

    def depth(self, least):
        return 1 + max((b.depth(least) for b in self.inside.values() if b.weight >= least), default=0)


def frame_name(line):
    """Of a line of perf's; None where it tells nothing."""
    found = FRAME.match(line)
    if not found:
        return None
    symbol, module = found[1], found[2]
    if module.startswith("[kernel"):
        return KERNEL
    if symbol == "[unknown]":
        return GRAPH if "anon" in module or "/perf-" in module else None
    return re.sub(r"\+0x[0-9a-f]+$", "", symbol).split(".")[0]


def perf_stacks(text):
    """Of each sample: the frames from the outermost on, and a weight of 1."""
    for sample in re.split(r"\n\s*\n", text):
        names = [frame_name(line) for line in sample.splitlines()[1:]]
        frames = []
        for name in reversed([n for n in names if n]):
            if not (frames and frames[-1] == name and name in (GRAPH, KERNEL)):
                frames.append(name)
        if frames:
            yield frames, 1


def folded_stacks(text):
    for line in text.splitlines():
        stack, _, weight = line.rpartition(" ")
        if stack:
            yield stack.split(";"), float(weight)


def read(text, top):
    """Frames above the one called `top` are left out, where there is one."""
    folded = re.match(r"^\S[^\n]* \d+(\.\d+)?$", text.split("\n", 1)[0])
    root = Box("all")
    for frames, weight in (folded_stacks if folded else perf_stacks)(text):
        root.add(frames[frames.index(top):] if top in frames else frames, weight)
    return root


def colour(name):
    """The same for the same name: warm, the kernel's and the library's no different."""
    value = sum((i + 1) * ord(c) for i, c in enumerate(name))
    return "hsl(%d,%d%%,%d%%)" % (18 + value % 34, 62 + value % 17, 62 + value % 13)


def draw(box, x, width, level, rows, total, least, out):
    if width < 0.4 or box.weight < least:
        return
    y = (rows - level) * ROW + 24
    share = "%s: %.1f%%" % (box.name, 100 * box.weight / total)
    out.append('<g><title>%s</title><rect x="%.1f" y="%d" width="%.1f" height="%d" fill="%s"/>'
               % (html.escape(share), x, y, max(width - 0.5, 0.3), ROW - 1, colour(box.name)))
    room = int((width - 4) / CHARACTER)
    if room >= 4:
        name = box.name if len(box.name) <= room else box.name[:room - 1] + "…"
        out.append('<text x="%.1f" y="%d">%s</text>' % (x + 3, y + 12, html.escape(name)))
    out.append("</g>")
    for inner in sorted(box.inside.values(), key=lambda b: b.name):
        inner_width = width * inner.weight / box.weight
        draw(inner, x, inner_width, level + 1, rows, total, least, out)
        x += inner_width


def svg(root, title, least):
    smallest = root.weight * least
    rows = root.depth(smallest) - 1
    out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" font-family="monospace" font-size="10.5">'
           % (WIDTH + 20, (rows + 1) * ROW + 34),
           '<rect width="100%" height="100%" fill="white"/>',
           '<text x="10" y="16" font-size="13" font-family="sans-serif">%s</text>' % html.escape(title)]
    draw(root, 10, WIDTH, 0, rows, root.weight, smallest, out)
    return "\n".join(out + ["</svg>", ""])


def main():
    parser = argparse.ArgumentParser(description="Draws a flame graph of what stands in standard input.")
    parser.add_argument("--title", default="")
    parser.add_argument("--least", type=float, default=0.002, help="boxes below this share are left out")
    parser.add_argument("--top", help="leave out what is above this frame")
    arguments = parser.parse_args()
    root = read(sys.stdin.read(), arguments.top)
    if not root.weight:
        sys.exit("flame: no stacks")
    sys.stdout.write(svg(root, arguments.title, arguments.least))


if __name__ == "__main__":
    main()
