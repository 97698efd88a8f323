#!/usr/bin/env python3
"""Measures pcgc: workloads beside rivals in C, in one run, as ratios.

    make bench [BENCH="w1 c1"] [BENCHFLAGS="--runs 9 --map town.osm.pbf"]
    bench/bench.py --build build [WORKLOAD…] [--quick] [--runs N] [--map FILE] [--json]

Prints a table, and writes bench.json and growth.svg into BUILD/bench. Nothing fails because it is slow; a
workload that does not run, or whose polygons are not those of its rival, is an error.
"""

import argparse
import json
import os
import platform
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.dont_write_bytecode = True

import chart      # noqa: E402
import measure    # noqa: E402
import report     # noqa: E402
import workloads  # noqa: E402


def read_arguments(argv):
    parser = argparse.ArgumentParser(description="Measures pcgc beside rivals in C.")
    parser.add_argument("workload", nargs="*", help="w1 w3 w4 w6 c1 micro; all when none is named")
    parser.add_argument("--build", default="build", help="the build's folder")
    parser.add_argument("--quick", action="store_true", help="one run at the smallest sizes: does it work")
    parser.add_argument("--runs", type=int, help="how often each point is measured; 5 when not given")
    parser.add_argument("--threads", help="numbers of threads: 1,2; when not given, 1 and one a processor")
    parser.add_argument("--map", help="of w6: a map of OpenStreetMap's; the village among the examples when not given")
    parser.add_argument("--without", action="append", default=[], help="leave a workload out")
    parser.add_argument("--json", action="store_true", help="print JSON instead of the table")
    return parser.parse_args(argv)


def choose(words, without):
    """The workloads that are meant, in their order."""
    unknown = [w for w in list(words) + without if w not in workloads.ALL]
    if unknown:
        raise measure.Broken("no workload '%s'; there are %s" % (unknown[0], " ".join(workloads.ALL)))
    return [w for w in workloads.ALL if (w in words or not words) and w not in without]


def thread_counts(given):
    if not given:
        return sorted({1, os.cpu_count() or 1})
    try:
        counts = sorted({int(n) for n in given.split(",")})
    except ValueError:
        counts = [0]
    if counts[0] < 1:
        raise measure.Broken("--threads takes numbers with commas between them, not '%s'" % given)
    return counts


def main(argv):
    arguments = read_arguments(argv)
    folder = os.path.join(arguments.build, "bench")
    os.makedirs(folder, exist_ok=True)
    runs = arguments.runs or (1 if arguments.quick else 5)
    tools = measure.Tools(os.path.join(arguments.build, "pcgc"), folder)
    settings = workloads.Settings(tools, arguments.quick, thread_counts(arguments.threads),
                                  os.path.abspath(arguments.map) if arguments.map else None)
    results = []
    for name in choose(arguments.workload, arguments.without):
        if not arguments.json:
            print("measuring %s …" % name, file=sys.stderr)
        workload = workloads.ALL[name](settings)
        measure.measure(workload, runs, 0 if arguments.quick else 1)
        results.append(workload.result(name))
    document = {"version": 1, "quick": arguments.quick, "runs": runs,
                "machine": {"processors": os.cpu_count(), "kind": platform.machine()},
                "workloads": results}
    with open(os.path.join(folder, "bench.json"), "w", encoding="utf-8") as out:
        json.dump(document, out, indent=1)
        out.write("\n")
    with open(os.path.join(folder, "growth.svg"), "w", encoding="utf-8") as out:
        out.write(chart.growth(document))
    print(json.dumps(document) if arguments.json else report.table(document))
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except measure.Broken as broken:
        print("bench: %s" % broken, file=sys.stderr)
        sys.exit(1)
