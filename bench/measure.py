"""measure.py - points, their sides, and how they are measured: in turns, so that what else the machine does meets
all of them alike; each sample in a process of its own."""

import json
import os
import statistics
import subprocess

TIMEOUT = 900  # seconds, of one sample


class Broken(Exception):
    """A workload that does not work."""


def call(command):
    """What a program prints as JSON."""
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=TIMEOUT,
                              check=False)
    except (OSError, subprocess.TimeoutExpired) as why:
        raise Broken("%s: %s" % (" ".join(command), why)) from why
    said = done.stderr.decode("utf-8", "replace")
    if done.returncode != 0:
        raise Broken("%s: exit code %d\n%s" % (" ".join(command), done.returncode, said))
    try:
        return json.loads(done.stdout)
    except ValueError as why:
        raise Broken("%s: no JSON: %s" % (" ".join(command), why)) from why


class Written:
    """A file that is written and measured. It goes at once: to give up the pages of an old one is no part of
    writing, and what the system still has to bring to the disk would be in the next one's way."""

    def __init__(self, path):
        self.path = path

    def remove(self):
        if self.path and os.path.exists(self.path):
            os.remove(self.path)

    def __enter__(self):
        self.remove()

    def __exit__(self, *_):
        self.remove()


class Tools:
    """How the compiler and the rivals are called; both give samples: dictionaries of wall, cpu (seconds), memory
    (bytes), counts, and parts (wall and cpu each)."""

    def __init__(self, pcgc, folder):
        self.pcgc, self.folder = os.path.abspath(pcgc), os.path.abspath(folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def graph(self, file, parts, graph=None, threads=None, output=None, **parameters):
        """A sample of a graph: `parts` are those that count as its time (compile, run, write)."""
        command = [self.pcgc, "bench", file, "--json", "--runs", "1", "--warmups", "0"]
        command += ["--graph", graph] if graph else []
        command += ["--threads", str(threads)] if threads else []
        command += ["--output", self.path(output)] if output else []
        for name, value in parameters.items():
            command += ["--parameter", "%s=%s" % (name, value)]

        def take():
            with Written(self.path(output) if output else None):
                told = call(command)
            point = told["points"][0]
            all_parts = {p["name"]: p for p in told["passes"]}
            all_parts.update({name: point[name] for name in ("compile", "run", "write")})
            flat = {name: {"wall": p["wall"]["median"], "cpu": p["cpu"]["median"]}
                    for name, p in all_parts.items()}
            return {"wall": sum(flat[p]["wall"] for p in parts), "cpu": sum(flat[p]["cpu"] for p in parts),
                    "user": point["process"]["user"]["median"], "system": point["process"]["system"]["median"],
                    "memory": point["memory"]["median"], "parts": flat,
                    "counts": {k: point[k] for k in ("rounds", "sent", "entities", "faces")}}
        return take

    def rival(self, program, part, *arguments, output=None):
        """A sample of a program of ours in C: `part` is the one that counts. A file that it writes is named last."""
        command = [self.path(program)] + [str(a) for a in arguments]
        command += [self.path(output)] if output else []

        def take():
            with Written(self.path(output) if output else None):
                told = call(command)
            parts = told.pop("parts")
            return {"wall": parts[part]["wall"], "cpu": parts[part]["cpu"], "memory": parts[part]["memory"],
                    "parts": parts, "counts": told}
        return take

    def emit(self, file, name):
        """The path of the C that a graph becomes."""
        out = self.path(name)
        done = subprocess.run([self.pcgc, file, "-o", out], stderr=subprocess.PIPE, timeout=TIMEOUT, check=False)
        if done.returncode != 0:
            raise Broken("%s does not compile:\n%s" % (file, done.stderr.decode("utf-8", "replace")))
        return out


def spread(values):
    return {"median": statistics.median(values), "least": min(values), "most": max(values)}


class Point:
    """A size, and what is measured there: sides by name, the first one ours, the second its rival."""

    def __init__(self, size, sides, threads=None, agree=None, series=None):
        self.size, self.sides, self.threads = size, sides, threads
        self.agree = agree      # the count that the first two sides must have in common
        self.series = series    # what the growth of this point belongs to
        self.samples = {name: [] for name in sides}

    def label(self):
        words = [self.series] if self.series else []
        words += ["%s" % self.size] if self.size is not None else []
        words += ["%d thread%s" % (self.threads, "" if self.threads == 1 else "s")] if self.threads else []
        return " ".join(words)

    def values(self, side, key="cpu", part=None):
        return [(s["parts"][part] if part else s)[key] for s in self.samples[side]]

    def median(self, side, key="cpu", part=None):
        return statistics.median(self.values(side, key, part))

    def count(self, side, name):
        return self.samples[side][0]["counts"][name]

    def ratios(self, key="cpu", ours=None, rival=None, ours_part=None):
        """Ours over the rival's, sample by sample: both were taken one right after the other."""
        names = list(self.sides)
        mine = self.values(ours or names[0], key, ours_part)
        other = self.values(rival or names[1], key)
        return [a / max(b, 1e-9) for a, b in zip(mine, other)]

    def check(self):
        names = list(self.sides)[:2]
        if self.agree and len({self.count(n, self.agree) for n in names}) > 1:
            raise Broken("%s: %s" % (self.label(), ", ".join(
                "%s makes %d %s" % (n, self.count(n, self.agree), self.agree) for n in names)))

    def result(self):
        out = {"size": self.size, "threads": self.threads, "series": self.series, "sides": {}}
        for name, samples in self.samples.items():
            parts = {p: {k: spread([s["parts"][p][k] for s in samples]) for k in ("wall", "cpu")}
                     for p in samples[0]["parts"]}
            side = {"wall": spread([s["wall"] for s in samples]), "cpu": spread([s["cpu"] for s in samples]),
                    "memory": spread([s["memory"] for s in samples]), "counts": samples[0]["counts"],
                    "parts": parts}
            for key in ("user", "system"):
                if key in samples[0]:
                    side[key] = spread([s[key] for s in samples])
            out["sides"][name] = side
        if len(self.sides) > 1:
            out["ratio"] = {"cpu": spread(self.ratios("cpu")), "wall": spread(self.ratios("wall"))}
        return out


class Figure:
    """One number that there is an aim for; `aim` NULL: it is told without one."""

    def __init__(self, what, value, unit, aim=None, at_least=False):
        self.what, self.value, self.unit, self.aim, self.at_least = what, value, unit, aim, at_least

    def result(self):
        met = None if self.aim is None else (
            self.value >= self.aim if self.at_least else self.value <= self.aim)
        return {"what": self.what, "value": self.value, "unit": self.unit, "aim": self.aim,
                "at_least": self.at_least, "met": met}


class Workload:
    """Points, and what is read off them once they are measured: `figures` gives a list of Figure. What is over in
    milliseconds is measured `often` times as many times."""

    def __init__(self, title, unit, points, figures, often=1):
        self.title, self.unit, self.points, self.figures, self.often = title, unit, points, figures, often

    def result(self, name):
        return {"name": name, "title": self.title, "unit": self.unit,
                "points": [p.result() for p in self.points],
                "figures": [f.result() for f in self.figures(self.points)]}


def measure(workload, runs, warmups):
    for run in range(warmups + runs * workload.often):
        for point in workload.points:
            for name, take in point.sides.items():
                sample = take()
                if run >= warmups:
                    point.samples[name].append(sample)
    for point in workload.points:
        point.check()
