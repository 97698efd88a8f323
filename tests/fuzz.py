#!/usr/bin/env python3
"""Runs the fuzz targets of tests/fuzz, each for its share of the time, on the kept corpora.

    tests/fuzz.py [--build build/fuzz] [--seconds 60]

A target NAME reads the corpus tests/fuzz/NAME/; what it finds new stays in the build folder. Ends
with the line `N passed, N failed`, which counts targets.
"""

import argparse
import glob
import os
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def run_target(build, name, seconds):
    """Whether the target survived; a crash leaves its input beside it."""
    program = os.path.join(build, "fuzz", name)
    corpus = os.path.join(build, "corpus", name)
    kept = os.path.join(ROOT, "tests", "fuzz", name)
    shutil.rmtree(corpus, ignore_errors=True)
    os.makedirs(corpus)
    command = [program, "-max_total_time=%d" % seconds, "-timeout=10", "-rss_limit_mb=2048",
               "-max_len=65536", "-seed=1", "-print_final_stats=1", "-verbosity=0",
               "-artifact_prefix=%s-" % program, corpus]
    if os.path.isdir(kept):
        command.append(kept)
    dictionary = os.path.join(ROOT, "tests", "fuzz", name + ".dict")
    if os.path.exists(dictionary):
        command.append("-dict=" + dictionary)
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    output = done.stdout.decode("utf-8", "replace")
    if done.returncode != 0:
        print("FAILED %s\n%s" % (name, output[-6000:]))
        return False
    executed = [x.split()[-1] for x in output.splitlines() if "number_of_executed_units" in x]
    print("ok %s (%s inputs)" % (name, executed[0] if executed else "?"))
    return True


def main():
    parser = argparse.ArgumentParser(description="Runs the fuzz targets.")
    parser.add_argument("--build", default="build/fuzz")
    parser.add_argument("--seconds", type=int, default=60, help="for all of them together")
    arguments = parser.parse_args()
    sources = sorted(glob.glob(os.path.join(ROOT, "tests", "fuzz", "*.c")))
    names = [os.path.basename(path)[:-2] for path in sources]
    seconds = max(1, arguments.seconds // max(1, len(names)))
    results = [run_target(os.path.abspath(arguments.build), n, seconds) for n in names]
    print("%d passed, %d failed" % (results.count(True), results.count(False)))
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
