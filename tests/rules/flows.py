#!/usr/bin/env python3
"""Random programs of the kind that flows are made of: trees of single nodes, with what ends them
between: queues that several nodes fill, collective nodes, references, conditions, what is told.

usage: flows.py FIRST LAST

Writes the programs of these seeds as records that flows.c reads."""
import random
import sys

KINDS = {
    "mark": ('set {{ assign(@trail, @trail + "{n}") }}', ("out",)),
    "step": ('set {{ assign(@trail, @trail + "{n}"); assign(@steps, @steps + 1) }}', ("out",)),
    "copy": ("copy(count = {k}, index => @number)", ("out",)),
    "share": ("copy(count = 2, clone = false, index => @number)", ("out",)),
    "odd": ("condition(@number % 2 == 1)", ("yes", "no")),
    "case": ("switch {{ odd: case(@steps % 2 == 1); third: case(@number % 3 == 2) }}",
             ("odd", "third", "otherwise")),
    "warn": ("translate(x = sqrt(@number - {k}.0) * 1m)", ("out",)),
    "part": ("inner(trail <=> @trail, number = @number)", ("left", "right")),
    "deep": ("outer(trail <=> @trail)", ("left", "right")),
    "chance": ("condition(rand_bool(50%))", ("yes", "no")),
    "count": ("counter(value => @number)", ("out",)),
    "dice": ("random {{ value(@number, 0, 9) }}", ("out",)),
    "again": ("random(again = true) {{ value(@number, 0, 9) }}", ("out",)),
    "meet": ("meet()", ("out",)),
    "log": ('log(message = "{n}:" + @trail)', ("out",)),
    "sort": ("order_by {{ descending(@steps) }}", ("out",)),
    "twice": ("sequence {{ a: step; b: step }}", ("a", "b")),
}
# How often a kind is taken: what ends a flow is rare.
WEIGHTS = {"mark": 6, "step": 4, "copy": 4, "share": 1, "odd": 4, "case": 3, "warn": 2, "part": 3,
           "deep": 2, "chance": 2, "count": 1, "dice": 1, "meet": 2,
           "again": 1, "log": 1, "sort": 1, "twice": 1}

GRAPHS = """
graph inner {
    attr trail: string
    attr number: int
    in tile: Shape
    out left: Shape
    out right: Shape
    tile -> a: copy(count = 2, index => @number) -> b: set { assign(@trail, @trail + "i") }
         -> c: condition(@number == 1)
    c.yes -> left
    c.no -> d: translate(x = sqrt(@number - 1.0) * 1m) -> right
}

graph meet {
    attr number: int
    in tile: Shape
    out out: Shape
    tile -> a: copy(count = 3, index => @number) -> b: condition(rand_bool(60%))
    s: set_from { assign(@number, other@number); other: source }
    b.yes -> s.in
    b.no -> s.other
    s.out -> out
}

graph outer {
    attr trail: string
    in tile: Shape
    out left: Shape
    out right: Shape
    tile -> a: inner(trail <=> @trail)
    a.left -> left
    a.right -> b: set { assign(@trail, @trail + "o") } -> right
}
"""


def program(seed):
    dice = random.Random(seed)
    lines = ["graph main {", "    attr trail: string", "    attr steps: int",
             "    attr number: int", "    na: rectangle() -> nb: copy(count = %d, index => @number)"
             % dice.randint(2, 9)]
    ports = ["nb.out"]
    for i in range(dice.randint(3, 12)):
        kind = dice.choices(list(WEIGHTS), WEIGHTS.values())[0]
        text, outputs = KINDS[kind]
        name = "n" + chr(ord("c") + i)
        lines.append("    %s: %s" % (name, text.format(n=name[1], k=dice.randint(1, 3))))
        feeders = [dice.choice(ports[-4:])]
        while dice.random() < 0.15:
            feeders.append(dice.choice(ports))
        for port in dict.fromkeys(feeders):
            way = " if true" if dice.random() < 0.1 else ""
            lines.append("    %s -> %s%s" % (port, name, way))
        ports += ["%s.%s" % (name, port) for port in outputs]
    lines.append("}")
    return "\n".join(lines) + "\n" + GRAPHS


def main():
    for seed in range(int(sys.argv[1]), int(sys.argv[2]) + 1):
        text = program(seed)
        sys.stdout.write("%d\n%s" % (len(text), text))


main()
