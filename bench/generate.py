"""generate.py - graphs of a given number of nodes, for what compiling costs."""

# Eight nodes; what leaves `top_N` begins the next unit.
UNIT = """
    {begin}
        -> body_{n}: extrude(amount = storey * (1 + @floor % 3) + {n} * 1cm)
        -> mass_{n}: select {{ top; walls: side; bottom }}
    block mass_{n}.bottom
    mass_{n}.walls
        -> decompose()
        -> split(axis = y, repeat = true, slice_index => @floor) {{ absolute(storey) }}
        -> set {{ assign(@width, @width + 10cm * @floor); assign(@shade, @floor % 2 == 0 ? 0.5 : 0.25) }}
        -> translate(z = 1cm * {n})
        -> color(color = hsv({n} % 360, 0.3, @shade))
    mass_{n}.top -> top_{n}: scale(x = 0.9, y = 0.9)
"""

HEAD = """graph generated {
    param on: bool = false
    param storey: length = 3m range [1m, 10m]
    attr floor: int = 0
    attr width: length = 1m
    attr shade: float = 0.5

    rectangle(width = 10m, height = 8m) -> gate: condition(on)
    block gate.no
"""


def nodes(count):
    """A graph of about so many nodes of all kinds, through which nothing runs."""
    parts = [HEAD]
    for n in range(max(1, count // 8)):
        parts.append(UNIT.format(n=n, begin="gate.yes" if n == 0 else "top_%d" % (n - 1)))
    return "".join(parts) + "}\n"


def attributes(count, entities):
    """So many nodes that compute attributes, one behind the other, and entities that go through."""
    names = "abcdefgh"
    lines = ["graph attributes {"]
    lines += ["    attr %s: int = %d" % (name, i) for i, name in enumerate(names)]
    lines += ["    impulse()", "        -> copy(count = %d, index => @a)" % entities]
    for i in range(count):
        to, left, right = names[(i + 1) % 8], names[i % 8], names[(i + 3) % 8]
        lines.append("        -> set { assign(@%s, @%s * %d + @%s) }" % (to, left, i % 5 + 1, right))
    return "\n".join(lines + ["}", ""])
