"""chart.py - growth over the size, and speed over threads, as one SVG."""

import html
import math

WIDTH, HEIGHT, MARGIN, GAP, COLUMNS = 300, 200, 46, 34, 3
COLOURS = ("#1f6fb2", "#c8553d", "#7a8b3c")


class Panel:
    """Lines over a size, both axes by powers of ten (or plain, of threads)."""

    def __init__(self, title, across, up, logarithmic=True):
        self.title, self.across, self.up, self.logarithmic = title, across, up, logarithmic
        self.lines = []

    def add(self, name, points):
        points = [(x, y) for x, y in points if x > 0 and y > 0]
        if len(points) > 1:
            self.lines.append((name, points))

    def place(self, x, y):
        """From values to the panel's pixels."""
        scale = math.log10 if self.logarithmic else float
        (x0, x1), (y0, y1) = self.range
        across = (scale(x) - x0) / (x1 - x0)
        up = (scale(y) - y0) / (y1 - y0)
        return MARGIN + across * (WIDTH - MARGIN - 10), HEIGHT - MARGIN + 12 - up * (HEIGHT - MARGIN - 18)

    def bound(self):
        xs = [x for _, line in self.lines for x, _ in line]
        ys = [y for _, line in self.lines for _, y in line]
        if not self.logarithmic:
            self.range = (min(xs), max(xs)), (0, max(ys + xs) * 1.1)
            return
        low, high = math.floor(math.log10(min(ys))), math.ceil(math.log10(max(ys)))
        self.range = (math.log10(min(xs)), math.log10(max(xs))), (low, max(high, low + 1))

    def ticks(self):
        (_, _), (y0, y1) = self.range
        if self.logarithmic:
            return [10 ** k for k in range(int(y0), int(y1) + 1)]
        return list(range(0, int(y1) + 1))

    def drawn(self):
        self.bound()
        out = ['<text x="%d" y="12" class="title">%s</text>' % (MARGIN, html.escape(self.title))]
        for value in self.ticks():
            (x0, _), _ = self.range
            left = self.place(10 ** x0 if self.logarithmic else x0, value)
            out.append('<line x1="%.1f" y1="%.1f" x2="%d" y2="%.1f" class="grid"/>'
                       % (left[0], left[1], WIDTH - 10, left[1]))
            out.append('<text x="%.1f" y="%.1f" class="left">%s</text>' % (left[0] - 4, left[1] + 3, "%g" % value))
        seen = sorted({x for _, line in self.lines for x, _ in line})
        for x in seen:
            at = self.place(x, self.ticks()[0])
            out.append('<text x="%.1f" y="%d" class="below">%s</text>' % (at[0], HEIGHT - 20, format(x, ",")))
        out.append('<text x="%d" y="%d" class="below">%s</text>'
                   % ((WIDTH + MARGIN) // 2, HEIGHT - 7, html.escape(self.across)))
        for number, (name, line) in enumerate(self.lines):
            colour = COLOURS[number % len(COLOURS)]
            places = [self.place(x, y) for x, y in line]
            out.append('<polyline points="%s" stroke="%s"/>'
                       % (" ".join("%.1f,%.1f" % p for p in places), colour))
            out += ['<circle cx="%.1f" cy="%.1f" r="2.5" fill="%s"/>' % (x, y, colour) for x, y in places]
            out.append('<text x="%d" y="%d" fill="%s">%s</text>'
                       % (MARGIN + 8, 28 + 13 * number, colour, html.escape(name)))
        out.append('<text transform="translate(9 %d) rotate(-90)" class="below">%s</text>'
                   % (HEIGHT // 2, html.escape(self.up)))
        return "\n".join(out)


def panels(document):
    out = []
    for w in document["workloads"]:
        series = sorted({p["series"] or "" for p in w["points"]})
        fewest = min((p["threads"] for p in w["points"] if p["threads"]), default=None)
        for name in series:
            points = [p for p in w["points"] if (p["series"] or "") == name and p["size"] is not None]
            panel = Panel("%s %s" % (w["name"], name), w["unit"], "ms of processor time")
            for side in points[0]["sides"] if points else []:
                panel.add(side, [(p["size"], 1e3 * p["sides"][side]["cpu"]["median"])
                                 for p in points if p["threads"] == fewest])
            out.append(panel)
        speed = Panel("%s by threads" % w["name"], "threads", "times the speed of one", logarithmic=False)
        # The largest sizes: what is over in milliseconds says little of threads.
        for size in sorted({p["size"] for p in w["points"] if p["threads"]})[-COLUMNS:]:
            of_size = [p for p in w["points"] if p["size"] == size]
            side = next(iter(of_size[0]["sides"]))
            first = of_size[0]["sides"][side]["wall"]["median"]
            speed.add("%s %s" % (format(size, ","), w["unit"]),
                      [(p["threads"], first / p["sides"][side]["wall"]["median"]) for p in of_size])
        out.append(speed)
    return [p for p in out if p.lines]


def growth(document):
    drawn = [p.drawn() for p in panels(document)]
    rows = max(1, -(-len(drawn) // COLUMNS))
    out = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 %d %d" font-family="sans-serif" font-size="10">'
           % (COLUMNS * (WIDTH + GAP), rows * (HEIGHT + GAP)),
           "<style>polyline{fill:none;stroke-width:1.6}.grid{stroke:#ddd}.title{font-weight:bold;font-size:12px}"
           ".left{text-anchor:end;fill:#666}.below{text-anchor:middle;fill:#666}</style>",
           '<rect width="100%" height="100%" fill="white"/>']
    for number, panel in enumerate(drawn):
        out.append('<g transform="translate(%d %d)">' % (10 + number % COLUMNS * (WIDTH + GAP),
                                                         14 + number // COLUMNS * (HEIGHT + GAP)))
        out += [panel, "</g>"]
    return "\n".join(out + ["</svg>", ""])
