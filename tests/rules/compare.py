"""Compares what the compiler makes of random programs with what the rules say.

usage: compare.py RUNNER FIRST LAST             all seeds, in memory
       compare.py RUNNER FIRST LAST PCGC CC     each through a .so that CC compiles, too
       compare.py --show SEED                   prints a program, and what the rules say of it"""
import collections
import concurrent.futures
import json
import os
import re
import subprocess
import sys
import tempfile

from graphs import NAMES, Program
from interpreter import Run, TooLong

BATCH = 250
# In one of so many programs each feature must have been at work, at least.
RARE = 250
LEFT = re.compile(r"(\d+) entit(?:y was|ies were) left at '([^']*)'")


def orders_of(dump):
    """{graph: its nodes in order} out of what --dump=order prints."""
    orders, graph = {}, None
    for line in dump.splitlines():
        words = line.split()
        if words[0] == "graph":
            graph = orders.setdefault(words[1], [])
        elif words[0].isdigit():
            graph.append(words[1])
    return orders


def left_of(messages):
    """How many entities were left waiting, by node and port, out of the warnings."""
    left = collections.Counter()
    for count, port in (LEFT.search(m).groups() for m in messages):
        left[port] += int(count)
    return left


def run_many(runner, texts):
    """What the runner says of each: a dictionary with order, log, left, results, or error."""
    records = b"".join(b"%d\n%s" % (len(t), t) for t in (text.encode() for text in texts))
    done = subprocess.run([runner], input=records, capture_output=True)
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    if done.returncode or len(answers) != len(texts):
        raise SystemExit("not ok the runner ended with %d behind program %d of %d\n%s" % (
            done.returncode, len(answers), len(texts), done.stderr.decode()[-2000:]))
    return answers


def without_profiles(log):
    """Times differ from run to run."""
    return [line for line in log if not line.startswith("graph '")]


def found_by(answer):
    return without_profiles(answer["log"]), left_of(answer["left"]), {k: v for k, v in answer["results"].items() if v}


def run_shared(pcgc, cc, text):
    """The same of a program as a .so."""
    with tempfile.TemporaryDirectory() as folder:
        source, shared = os.path.join(folder, "main.pcg"), os.path.join(folder, "main.so")
        with open(source, "w") as file:
            file.write(text)
        subprocess.run([pcgc, source, "--cc=" + cc, "-o", shared], check=True, capture_output=True)
        done = subprocess.run([pcgc, "run", shared, "--json", "--entities", "--threads", "4"],
                              check=True, capture_output=True)
    answer = json.loads(done.stdout)
    said = answer["diagnostics"]
    results = {o["port"]: [[e["attributes"][a] for a in NAMES] for e in o["entities"]]
               for o in answer["outputs"] if o["entities"]}
    return (without_profiles(m["message"] for m in said if m["severity"] == "note"),
            left_of(m["message"] for m in said if m.get("code") == "W0702"), results)


def compare(program, answer, shared):
    """What happened, and a sentence on what differs; both empty where it takes too long to say."""
    try:
        expected = Run(program)
    except TooLong:
        return set(), ""
    if "error" in answer:
        return expected.features, "pcgc says " + answer["error"]
    orders = orders_of(answer["order"])
    by_rule = {g: [n.name for n in nodes] for g, nodes in expected.orders.items() if g in orders}
    if orders != by_rule:
        return expected.features, "order: %s\nby the rules: %s" % (orders, by_rule)
    wanted = expected.log, expected.left, expected.results
    for where, found in [("in memory", found_by(answer))] + ([("as .so", shared())] if shared else []):
        for what, one, other in zip(("log", "left waiting", "results"), found, wanted):
            if one != other:
                return expected.features, "%s, %s:\n  %s\nby the rules:\n  %s" % (
                    where, what, one, other)
    return expected.features, ""


def compare_batch(runner, seeds, pcgc, cc):
    """How many programs each feature was at work in, and what to say of those that differ."""
    programs = [Program(seed) for seed in seeds]
    seen, differences = collections.Counter(), []
    answers = run_many(runner, [p.text() for p in programs])
    for seed, program, answer in zip(seeds, programs, answers):
        shared = (lambda: run_shared(pcgc, cc, program.text())) if pcgc else None
        features, difference = compare(program, answer, shared)
        seen.update(features)
        if difference:
            differences.append((seed, difference))
    return seen, differences


def show(seed):
    program = Program(seed)
    print(program.text())
    run = Run(program)
    for graph, nodes in run.orders.items():
        print("//", graph, *[n.name for n in nodes])
    print("//", run.log, run.left, run.results)
    return 0


def main():
    if sys.argv[1] == "--show":
        return show(int(sys.argv[2]))
    runner, first, last = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    pcgc, cc = (sys.argv[4:6] + [None, None])[:2]
    seeds = range(first, last + 1)
    batches = [seeds[i:i + BATCH] for i in range(0, len(seeds), BATCH)]
    seen, differences = collections.Counter(), []
    with concurrent.futures.ProcessPoolExecutor() as pool:
        for future in [pool.submit(compare_batch, runner, b, pcgc, cc) for b in batches]:
            features, different = future.result()
            seen += features
            differences += different
    for seed, what in differences[:5]:
        print("not ok program of seed %d: %s" % (seed, what))
    compared = seen.pop("a program", 0)
    rare = [f for f in seen if seen[f] * RARE < compared] if compared > 1000 else []
    bad = differences or rare or compared < len(seeds) * 0.9
    print("%s %d of %d programs run as the rules say%s" % (
        "not ok" if bad else "ok", compared - len(differences), len(seeds),
        " as a .so, too" if pcgc else ""))
    if not pcgc:
        print("    of them so many with %s" % ", ".join("%s %d" % f for f in seen.most_common()))
        print("".join("    too few with %s\n" % f for f in rare), end="")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
