"""workloads.py - what is measured, at which sizes, beside what, and the aims."""

import os
import statistics

import generate
from measure import Figure, Point, Workload

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(os.path.dirname(HERE), "examples")
VILLAGE = os.path.join(EXAMPLES, "assets", "maps", "village.osm")


class Settings:
    """What the command line says of all workloads."""

    def __init__(self, tools, quick, threads, town=None):
        self.tools, self.quick, self.threads, self.map = tools, quick, threads, town or VILLAGE
        self.often = 1 if quick else 3  # as many times, of what is over in milliseconds

    def sizes(self, quick, full):
        return quick if self.quick else full

    def written(self, name, text):
        path = self.tools.path(name)
        with open(path, "w", encoding="utf-8") as out:
            out.write(text)
        return path


def here(name):
    return os.path.join(HERE, name)


# ---- w1 ------------------------------------------------------------------------------------------

def facade_city(s):
    sizes = s.sizes([4, 40], [100, 1000, 10000])
    points = [Point(n, {"pcgc": s.tools.graph(here("facade_city.pcg"), ("run", "write"), threads=t,
                                              output="pcgc.glb", lots=n),
                        "limit": s.tools.rival("limit", "stream", n, output="limit.glb")},
                    threads=t, agree="faces") for n in sizes for t in s.threads]

    def figures(measured):
        out = []
        for n in sizes[1:]:
            of_size = {p.threads: p for p in measured if p.size == n}
            one, most = of_size[min(of_size)], of_size[max(of_size)]
            out.append(Figure("%d lots, generated and written, CPU time over the limit's" % n,
                              statistics.median(one.ratios()), "x", 2))
            out.append(Figure("%d lots, generated only, CPU time over the limit's" % n,
                              statistics.median(one.ratios(ours_part="run")), "x"))
            out.append(Figure("%d lots, peak memory a polygon" % n,
                              one.median("pcgc", "memory") / one.count("pcgc", "faces"), "bytes", 200))
            if most is not one:
                out.append(Figure("%d lots, speed of %d threads over %d" % (n, most.threads, one.threads),
                                  one.median("pcgc", "wall") / most.median("pcgc", "wall"), "x",
                                  1.7 if most.threads == 2 else None, at_least=True))
        return out
    return Workload("Facade city: lots, split and extruded, written as GLB", "lots", points, figures)


# ---- w3 ------------------------------------------------------------------------------------------

def recursion(s):
    points = [Point(n, {"pcgc": s.tools.graph(here("fruit_tree.pcg"), ("run",), levels=n),
                        "C": s.tools.rival("fruit_tree", "grow", n)}, agree="faces")
              for n in s.sizes([2, 4], [6, 8, 10, 12])]

    def figures(measured):
        last = measured[-1]
        rounds = last.count("pcgc", "rounds")
        return [Figure("%d rounds, CPU time over a function's that recurses" % rounds,
                       statistics.median(last.ratios()), "x"),
                Figure("a round", 1e9 * last.median("pcgc") / rounds, "ns")]
    return Workload("Recursion: a tree that grows in a cycle", "levels", points, figures)


# ---- w4 ------------------------------------------------------------------------------------------

LISTS = ("aggregated", "ordered", "grouped", "clustered")


def lists(s):
    points = []
    for kind in LISTS:
        for n in s.sizes([100, 1000], [1000, 10000, 100000, 1000000]):
            sides = {"pcgc": s.tools.graph(here("lists.pcg"), ("run",), graph=kind, n=n),
                     "C": s.tools.rival("lists", kind, n),
                     "made": s.tools.graph(here("lists.pcg"), ("run",), graph="made", n=n)}
            points.append(Point(n, sides, series=kind))

    def figures(measured):
        out = []
        for kind in LISTS:
            last = [p for p in measured if p.series == kind][-1]
            beyond = [max(a - b, 0) for a, b in zip(last.values("pcgc"), last.values("made"))]
            ratios = [a / max(b, 1e-9) for a, b in zip(beyond, last.values("C"))]
            out.append(Figure("%s %d, beyond making them, CPU time over C's" % (kind, last.size),
                              statistics.median(ratios), "x"))
            out.append(Figure("%s %d, an entity" % (kind, last.size),
                              1e9 * statistics.median(beyond) / last.size, "ns"))
        return out
    return Workload("Lists: aggregate, order_by, group, cluster", "entities", points, figures)


# ---- w6 ------------------------------------------------------------------------------------------

def town(s):
    graph = s.tools.graph
    point = Point(None, {"town": graph(os.path.join(EXAMPLES, "town.pcg"), ("run",), map=s.map),
                         "GDAL": s.tools.rival("map", "read", s.map),
                         "reading": graph(here("town_map.pcg"), ("run",), map=s.map)},
                  series=os.path.basename(s.map))

    def figures(measured):
        p = measured[0]
        generated = [a - b for a, b in zip(p.values("town"), p.values("reading"))]
        return [Figure("generated, beyond reading, CPU time", 1e3 * statistics.median(generated), "ms", 100),
                Figure("a face", 1e9 * statistics.median(generated) / max(1, p.count("town", "faces")), "ns"),
                Figure("reading, CPU time over GDAL's alone",
                       statistics.median(p.ratios(ours="reading", rival="GDAL")), "x")]
    return Workload("A real town out of OpenStreetMap", "", [point], figures)


# ---- c1 ------------------------------------------------------------------------------------------

FRONT = ("read", "parse", "resolve", "check", "order", "emit")


def compiling(s):
    files = [("house", None, os.path.join(EXAMPLES, "house.pcg"))]
    for n in s.sizes([40, 80], [1000, 10000]):
        files.append(("nodes", n, s.written("generated_%d.pcg" % n, generate.nodes(n))))
    points = [Point(n, {"pcgc": s.tools.graph(path, ("compile",)),
                        "libtcc": s.tools.rival("compile", "compile",
                                                s.tools.emit(path, "%s_%s.c" % (name, n)))}, series=name)
              for name, n, path in files]

    def front(p):
        return [sum(sample["parts"][f]["cpu"] for f in FRONT) for sample in p.samples["pcgc"]]

    def figures(measured):
        house, small, large = measured
        out = [Figure("the house, text to running code, CPU time", 1e3 * house.median("pcgc"), "ms", 5)]
        for p in measured:
            ratios = [a / b for a, b in zip(front(p), p.values("pcgc", "cpu", "libtcc"))]
            out.append(Figure("%s: all before libtcc over libtcc" % p.label(), statistics.median(ratios), "x", 1))
        each = [p.median("pcgc") / p.size for p in (small, large)]
        out.append(Figure("a node of %d" % large.size, 1e6 * each[1], "us"))
        out.append(Figure("a node of %d over one of %d: 1 is linear" % (large.size, small.size),
                          each[1] / each[0], "x", 1.2))
        return out
    return Workload("Compiling: the house, and graphs of many nodes", "nodes", points, figures, s.often)


# ---- micro ---------------------------------------------------------------------------------------

def micro(s):
    tools, entities, turns = s.tools, 2000 if s.quick else 200000, 10000 if s.quick else 1000000
    attributes = s.written("attributes.pcg", generate.attributes(64, 1000))
    points = [
        Point(entities, {"pcgc": tools.graph(here("rounds.pcg"), ("run",), graph="rounds", entities=entities),
                         "made": tools.graph(here("rounds.pcg"), ("run",), graph="made", entities=entities)},
              series="rounds"),
        Point(turns, {"pcgc": tools.graph(here("turns.pcg"), ("run",), turns=turns)}, series="turns"),
        Point(64, {"pcgc": tools.graph(attributes, ("compile", "run"))}, series="attributes"),
        Point(None, {"pcgc": tools.rival("process", "process", tools.pcgc, "--version"),
                     "nothing": tools.rival("process", "process", tools.path("nothing"))}, series="start")]

    def figures(measured):
        rounds, cycle, nodes, start = measured
        beyond = rounds.median("pcgc") - rounds.median("made")
        return [Figure("a round of set, beyond making and testing the entities",
                       1e9 * beyond / (2 * entities), "ns", 20),
                Figure("a round of set, set, condition, with making the entities",
                       1e9 * rounds.median("pcgc") / rounds.count("pcgc", "rounds"), "ns"),
                Figure("a turn of a loop", 1e9 * cycle.median("pcgc") / turns, "ns", 50),
                Figure("64 attribute nodes on 1,000 entities, compile included", 1e3 * nodes.median("pcgc"), "ms", 10),
                Figure("pcgc --version, whole process, by the clock", 1e3 * start.median("pcgc", "wall"), "ms", 5),
                Figure("the same over an empty program's", statistics.median(start.ratios("wall")), "x")]
    return Workload("Single costs", "", points, figures, often=s.often)


ALL = {"w1": facade_city, "w3": recursion, "w4": lists, "w6": town, "c1": compiling, "micro": micro}
