"""Random well-typed programs of the language: nodes of all kinds with cycles, encapsulated graphs and
surrogates, collective gates, references, blocked and conditional ways. Most cycles end, since each
leads over a choice that asks for the steps that an entity has made.

A Program is a list of Graphs, of which the last is the main one, and each encapsulates only those
before it, and itself. The same seed gives the same program on every machine."""
import random

MOST_STEPS = 5
KEYS = ("k", "l")
NAMES = ("trail", "steps", "number")  # of the attributes


class Kind:
    """What a node runs, as text, and its ports. `{n}` is what it leaves in the trail of an entity. Ports
    hold shapes, but those of `takes` and `gives`: a Group, an Impulse, or any of them."""

    def __init__(self, text, inputs="in", outputs="out", collective="", optional="", takes=None,
                 gives=None):
        self.text, self.inputs, self.outputs = text, tuple(inputs.split()), tuple(outputs.split())
        self.collective, self.optional = tuple(collective.split()), tuple(optional.split())
        self.takes, self.gives = takes or {}, gives or {}


KINDS = {
    "source": Kind("rectangle()", inputs=""),
    "impulse": Kind("impulse(count = 2, index => @number)", inputs="", gives={"out": "Impulse"}),
    "step": Kind('set {{ assign(@trail, @trail + "{n}"); assign(@steps, @steps + 1) }}'),
    "mark": Kind('set {{ assign(@trail, @trail + "{n}") }}'),
    "number": Kind("count(index => @number)", collective="in"),
    "counter": Kind("counter(start = 3, step = 2, value => @number)"),
    "choice": Kind("condition(@steps < %d)" % MOST_STEPS, outputs="yes no"),
    "odd": Kind("switch {{ odd: case(@steps % 2 == 1); third: case(@steps % 3 == 2) }}",
                outputs="otherwise odd third"),
    "reverse": Kind("reverse()", collective="in"),
    "sort": Kind("order_by {{ descending(@steps); ascending(@number) }}", collective="in"),
    "filter": Kind("amount_filter(amount = 2, start = 1)", outputs="picked rest", collective="in"),
    "copy": Kind("copy(count = 2)"),
    "share": Kind("copy(count = 2, clone = false, index => @number)"),
    "log": Kind('log(message = "{n}:" + @trail + "," + @number)'),
    "twice": Kind("sequence {{ a: step; b: step }}", outputs="a b"),
    "combine": Kind("combine()", "a b", "first second", "a b"),
    "pair": Kind("pair(of = {pairing})", outputs="first second", collective="in"),
    "group": Kind("group(size => @number) {{ by(@steps) }}", collective="in", gives={"out": "Group"}),
    "ungroup": Kind("ungroup {{ shape }}", outputs="out shape", takes={"in": "Group"}),
    "wait": Kind("wait()", "in until", collective="in until", takes={"until": "any"}),
    "from": Kind("set_from {{ assign(@number, @number + other@steps); other: source }}", "in other",
                 takes={"other": "any"}),
    "swap": Kind("swap {{ exchange(@trail, @trail) }}", "a b", "first second"),
    "transfer": Kind("copy_attributes {{ only(@number) }}", "in from", "out source"),
    "nearest": Kind("nearest(index => @number)", "in to", collective="in to", optional="to"),
    "store": Kind('store(key = "{key}", reach = {reach})'),
    "load": Kind('load(key = "{key}", take = {take}) {{ shape }}', "", "out shape"),
    "broadcast": Kind('broadcast(message = "{key}")'),
    "receive": Kind('receive(message = "{key}") {{ shape }}', "", "out shape"),
    "raise": Kind('set_parameter(parameter = "level", value = (level * 3 + @steps) % 101)'),
    "shut": Kind('set_parameter(parameter = "open", value = @steps % 2 == 0)'),
    "read": Kind('get_parameter {{ read(parameter = "level", to = @number) }}'),
    "constant": Kind("set {{ assign(@number, tenfold + level) }}"),
    "deeper": Kind("condition(depth > 0)", outputs="yes no"),
}
# Ports of type Entity, which nothing ever leaves: what is kept are shapes.
UNUSED = (("ungroup", "out"), ("load", "out"), ("receive", "out"))
LINKS = ("", "trail => @trail", "trail <=> @trail", "trail = @trail", "number <=> @number",
         "trail = @trail, number => @number", "number = @steps, trail <=> @trail")
TYPES = {"trail": "string", "number": "int"}
USUAL = [k for k in KINDS if k != "deeper"]
TOGETHER = {"store": "load", "load": "store", "broadcast": "receive", "receive": "broadcast",
            "group": "ungroup", "choice": "step"}


class Node:
    def __init__(self, name, kind, inputs, outputs, collective=(), optional=(), graph=None):
        self.name, self.kind, self.graph = name, kind, graph
        self.inputs, self.outputs = inputs, outputs
        self.collective, self.optional = collective, optional
        self.letter = name[-1]
        self.words = {"n": self.letter}

    def takes(self, port):
        if port == "impulse":
            return "any"
        return KINDS[self.kind].takes.get(port, "Shape") if self.kind in KINDS else "Shape"

    def gives(self, port):
        return KINDS[self.kind].gives.get(port, "Shape") if self.kind in KINDS else "Shape"

    def text(self):
        if self.kind == "in":
            return "in %s: Shape%s%s" % (self.name, self.brackets("in"), self.graph)
        if self.kind in ("out", "rest"):
            return "out %s: Shape%s" % (self.name, " = *" if self.kind == "rest" else "")
        return "%s: %s" % (self.name, KINDS[self.kind].text.format(**self.words))

    def brackets(self, port):
        return "[]?" if port in self.optional else "[]" if port in self.collective else ""


class Inner(Node):
    """A node that runs one of `graphs`: encapsulated where `procedure` is empty, else a surrogate, that
    takes the first or, where there are more, the one that it picks. `links` and `handed` (parameters)
    are texts; `rest` is the port that takes what the outputs have none for."""

    def __init__(self, name, procedure, graphs, links):
        gates, outputs = graphs[0].inputs(), [g.outputs() for g in graphs]
        common = tuple(n for n in outputs[0] if all(n in others for others in outputs))
        super().__init__(name, "graph", tuple(n.name for n in gates), common,
                         tuple(n.name for n in gates if n.collective),
                         tuple(n.name for n in gates if n.optional), graphs[0])
        self.procedure, self.graphs, self.links = procedure, graphs, links
        self.handed, self.rest, self.loop, self.times, self.index = "", None, None, 1, False

    def picks(self):
        return ("@steps" if self.inputs else "level") + " % 2 == 0"

    def name_text(self):
        if len(self.graphs) == 1:
            return '"%s"' % self.graphs[0].name
        return '%s ? "%s" : "%s"' % (self.picks(), self.graphs[0].name, self.graphs[1].name)

    def braces(self):
        items = ["in %s: Shape%s" % (p, self.brackets(p)) for p in self.inputs]
        items += ["out %s: Shape%s" % (p, " = *" if p == self.rest else "") for p in self.outputs]
        items += ["param level: int = 0"] if self.handed.startswith("level") or self.index else []
        items += ["attr %s: %s" % (l.split(" ")[0], TYPES[l.split(" ")[0]])
                  for l in self.links.split(", ") if l]
        items += ["loop %s -> %s" % self.loop] if self.loop else []
        return " { %s }" % "; ".join(items)

    def text(self):
        given = [self.handed] if self.handed else []
        if self.procedure == "iterate":
            given = ["times = %d" % self.times] + (["index = level"] if self.index else []) + given
        given += [self.links] if self.links else []
        if not self.procedure:
            return "%s: %s(%s)" % (self.name, self.graph.name, ", ".join(given))
        return "%s: %s(%s)%s" % (self.name, self.procedure,
                                 ", ".join(["graph = " + self.name_text()] + given), self.braces())


class Edge:
    def __init__(self, node, port, to, at, way=""):
        self.node, self.port, self.to, self.at, self.way = node, port, to, at, way

    def text(self):
        if self.to.kind == "in":  # from its stand-in, in the gate's own line
            return ""
        arrow = "-/>" if self.way == "disabled" else "->"
        condition = {"if open": " if open", "if not open": " if !open"}.get(self.way, "")
        return "%s %s %s%s" % (end(self.node, self.port, self.node.outputs), arrow,
                               end(self.to, self.at, self.to.inputs), condition)


def end(node, port, ports):
    return node.name if node.kind in ("in", "out", "rest") or len(ports) < 2 else node.name + "." + port


class Graph:
    """`nodes` and `edges` stand in the order of their lines; `blocked` holds (node, port)."""

    def __init__(self, choose, name, callees, is_main):
        self.name, self.is_main = name, is_main
        self.nodes, self.edges, self.blocked = [], [], {}
        self.default = choose.choice(("", "", " = level"))
        self.palette = self.choose_palette(choose)
        self.add_input_gates(choose)
        if not self.nodes or choose.random() < 0.1:
            self.nodes.append(Node("nz", "source", (), ("out",)))
        self.gates = self.choose_output_gates(choose)
        if not is_main and self.inputs() and choose.random() < 0.15:
            self.add_self(choose)
        for i in range(choose.randint(2, 11 if is_main else 6)):
            self.add_node(choose, "n" + chr(97 + i), callees)
        self.nodes += self.gates
        self.add_edges(choose)
        self.add_blocks(choose)

    def choose_palette(self, choose):
        """A few kinds, so that those that go together meet."""
        kinds = choose.sample(USUAL, 4) + choose.choice((["source", "copy"], ["choice", "choice", "step"]))
        return kinds + [TOGETHER[k] for k in kinds if k in TOGETHER]

    def inputs(self):
        return [n for n in self.nodes if n.kind == "in"]

    def outputs(self):
        return [n.name for n in self.gates]

    def add_input_gates(self, choose):
        for i in range(choose.choice((0, 0, 0, 1)) if self.is_main else choose.choice((0, 1, 1, 1, 2))):
            collective = ("in",) if choose.random() < 0.3 else ()
            others_collective = all(n.collective for n in self.inputs())
            optional = collective if i > 0 and others_collective and choose.random() < 0.7 else ()
            gate = Node("p" + chr(97 + i), "in", ("in",), ("out",), collective, optional, "")
            if self.is_main or choose.random() < 0.5:
                stand_in = Node("s" + chr(97 + i), "source", (), ("out",))
                gate.graph = " = " + stand_in.text()
                self.edges.append(Edge(stand_in, "out", gate, "in"))
                self.nodes.append(stand_in)
            self.nodes.append(gate)

    def choose_output_gates(self, choose):
        rest = choose.random() < (0.3 if self.is_main else 0.4)
        count = choose.choice((0, 1, 2)) if self.is_main or rest else choose.choice((1, 1, 2))
        gates = [Node("q" + chr(97 + i), "out", ("in",), ()) for i in range(count)]
        return gates + ([Node("qz", "rest", ("in",), ())] if rest else [])

    def add_self(self, choose):
        """A way into the graph itself, a level deeper, behind the choice that ends it."""
        ports = KINDS["deeper"]
        self.nodes.append(Node("nx", "deeper", ports.inputs, ports.outputs))
        inner = Inner("ny", "", [self], choose.choice(LINKS))
        inner.handed = "depth = depth - 1"
        self.nodes.append(inner)

    def add_node(self, choose, name, callees):
        kind = "graph" if callees and choose.random() < 0.2 else choose.choice(self.palette)
        if kind == "ungroup" and all(n.kind != "group" for n in self.nodes):
            kind = "group"
        if kind == "graph":
            self.nodes.append(self.inner_node(choose, name, callees))
            return
        ports = KINDS[kind]
        node = Node(name, kind, ports.inputs, ports.outputs, ports.collective, ports.optional)
        node.words.update(key=choose.choice(KEYS), take=choose.choice(("false", "false", "true")),
                          reach=choose.choice(("inside", "inside", "around", "everywhere")),
                          pairing=choose.choice(("all", "neighbours", "ring", "twos")))
        self.nodes.append(node)

    def inner_node(self, choose, name, callees):
        procedure = choose.choice(("", "", "dynamic", "dynamic", "iterate", "profile"))
        graphs = [choose.choice(callees)]
        alike = [g for g in callees if signature(g) == signature(graphs[0]) and g is not graphs[0]]
        if procedure == "dynamic" and alike:
            graphs.append(choose.choice(alike))
        node = Inner(name, procedure, graphs, choose.choice(LINKS))
        if not node.inputs:
            node.links = choose.choice([l for l in LINKS if " = " not in l])
        node.handed = choose.choice(("", "", "level = level + 1", "open = level % 2 == 0"))
        if procedure:
            node.handed = node.handed if node.handed.startswith("level") else ""
            if choose.random() < 0.4:
                node.outputs, node.rest = node.outputs[:1] + ("qr",), "qr"
        if procedure == "iterate":
            node.handed, node.times, node.index = "", choose.randint(0, 3), choose.random() < 0.5
            loops = [o for o in node.outputs if o != node.rest]
            if loops and node.inputs:
                node.loop = (choose.choice(loops), choose.choice(node.inputs))
        return node

    def add_edges(self, choose):
        first = len(self.edges)
        for i, node in enumerate(self.nodes):
            for port in node.outputs:
                for _ in range(choose.choice((0, 0, 1, 1, 1, 2))):
                    self.add_edge(choose, i, port)
        for j, node in enumerate(self.nodes):
            for at in node.inputs:
                self.feed(choose, j, at)
        for node in self.nodes:
            if node.kind == "choice" and choose.random() < 0.9:
                self.add_cycle(choose, node)
        lines = self.edges[first:]
        choose.shuffle(lines)
        self.edges[first:] = lines

    def may_lead(self, node, port, to, at):
        if is_stand_in(node) or is_stand_in(to) or to.kind == "in" or (node.kind, port) in UNUSED:
            return False
        if to.graph is self and (node.kind, port) != ("deeper", "yes"):
            return False
        return to.takes(at) in ("any", node.gives(port))

    def add_edge(self, choose, i, port):
        """To any node behind."""
        node = self.nodes[i]
        targets = [(to, at) for to in self.nodes[i + 1:]
                   for at in to.inputs or (() if to.kind in ("out", "rest") else ("impulse",))
                   if self.may_lead(node, port, to, at)]
        if targets:
            way = choose.choice([""] * 12 + ["disabled", "if open", "if not open"])
            self.edges.append(Edge(node, port, *choose.choice(targets), way))

    def before(self, nodes):
        """The nodes that lead to one of these, these included."""
        found = list(nodes)
        for node in found:
            found += [e.node for e in self.edges if e.to is node and e.node not in found]
        return found

    def add_cycle(self, choose, choice):
        """Back from a choice to a node that leads to it, over one that counts a step."""
        steps = [n for n in self.before([choice]) if n.kind == "step"]
        targets = [(to, at) for to in self.before(steps) for at in to.inputs
                   if self.may_lead(choice, "yes", to, at)]
        if targets:
            way = choose.choice([""] * 12 + ["if open", "if not open"])
            self.edges.append(Edge(choice, "yes", *choose.choice(targets), way))

    def feed(self, choose, j, at):
        """Something leads to every input, so that its type is known; at times it is closed."""
        node = self.nodes[j]
        if node.kind == "in" or any((e.to, e.at) == (node, at) and e.way != "disabled" and
                                    self.nodes.index(e.node) < j for e in self.edges):
            return
        ways = [(n, p) for n in self.nodes[:j] for p in n.outputs if self.may_lead(n, p, node, at)]
        if ways and node.kind != "rest":
            self.edges.append(Edge(*choose.choice(ways), node, at,
                                   choose.choice([""] * 12 + ["if open", "if not open"])))

    def add_blocks(self, choose):
        """Some ports; and those that may be leaves and hold no shape, since gates gather shapes."""
        for node in self.nodes:
            for port in node.outputs:
                open_always = any((e.node, e.port, e.way) == (node, port, "") for e in self.edges)
                if (node.kind, port) in UNUSED or (node.gives(port) != "Shape" and not open_always):
                    self.blocked[(node.name, port)] = ""
                elif node.kind not in ("in", "out", "rest") and choose.random() < 0.05 \
                        and not is_stand_in(node):
                    self.blocked[(node.name, port)] = choose.choice(("", " if open", " if !open"))

    def text(self):
        lines = ["graph %s {" % self.name, "    param open: bool = true", "    param level: int = 1",
                 "    param depth: int = 2", "    const tenfold = level * 10", "    attr trail: string",
                 "    attr steps: int", "    attr number: int" + self.default]
        lines += ["    " + n.text() for n in self.nodes if not is_stand_in(n)]
        lines += ["    block %s%s" % (end(n, port, n.outputs), self.blocked[(n.name, port)])
                  for n in self.nodes for port in n.outputs if (n.name, port) in self.blocked]
        lines += ["    " + e.text() for e in self.edges if e.text()]
        return "\n".join(lines) + "\n}\n"


def is_stand_in(node):
    return node.name[0] == "s"


def signature(graph):
    return [(n.name, n.collective, n.optional) for n in graph.inputs()]


class Program:
    def __init__(self, seed):
        choose = random.Random(seed)
        self.graphs = []
        for i in range(choose.choice((0, 0, 1, 2, 3))):
            self.graphs.append(Graph(choose, "inner" + chr(97 + i), self.graphs[:], False))
        self.graphs.append(Graph(choose, "main", self.graphs[:], True))

    def text(self):
        return "\n".join(g.text() for g in reversed(self.graphs))
