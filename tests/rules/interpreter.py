"""The rules of how a graph runs, as they are written, for the programs of graphs.py: slow and plain,
so that it can be read beside the language's own text. Rule 1 is in order.py.

An Entity holds what was written to its attributes by depth: those of the main graph at 0, those of a
graph that it has entered behind them. References to one entity are references to one Entity."""
from graphs import NAMES, is_stand_in
from order import order_of

MOST_ROUNDS, MOST_SENT = 1000, 4000


class TooLong(Exception):
    pass


class Entity:
    def __init__(self, attributes, members=()):
        self.attributes, self.members = attributes, list(members)

    def copy(self):
        return Entity([dict(a) for a in self.attributes], [m.copy() for m in self.members])

    def descendant(self, members=()):
        return Entity([dict(a) for a in self.attributes], members)


class Frame:
    """A graph where it stands: what stays from one execution to the next."""

    def __init__(self, graph, parent):
        self.graph, self.parent = graph, parent
        self.depth = parent.depth + 1 if parent else 0
        self.parameters = {"open": True, "level": 1, "depth": 2}
        self.rounds, self.received, self.inner = {}, {}, {}
        self.pool = {}      # rule 11; emptied behind each execution
        self.messages = {}  # those of the main graph count

    def outermost(self):
        return self.parent.outermost() if self.parent else self

    def of(self, node, graph):
        return self.inner.setdefault((node.name, graph.name), Frame(graph, self))


class Execution:
    """One execution of a graph, from its inputs to its end."""

    def __init__(self, run, frame, before, impulse):
        """`before`: of the time before in an iteration; `impulse`: what set off the graph; or None."""
        graph = frame.graph
        self.run, self.frame, self.graph, self.impulse = run, frame, graph, impulse
        self.depth, self.parameters = frame.depth, frame.parameters
        self.nodes = run.orders[graph.name]
        self.seen = before.seen if before else set()  # entities that were here
        self.came = {}      # what came to the output gates and left leaf ports
        # What is decided when the graph starts: defaults of attributes, which ways are open.
        self.defaults = {"trail": "", "steps": 0,
                         "number": self.parameters["level"] if graph.default else 0}
        self.is_open = {"": True, "disabled": False, "if open": self.parameters["open"],
                        "if not open": not self.parameters["open"]}
        self.edges = [e for e in graph.edges if self.is_open[e.way]]
        self.blocked = {port for port, condition in graph.blocked.items()
                        if condition == "" or self.is_open[condition.strip().replace("!", "not ")]}
        if frame.parent:    # a supergraph runs no stand-in
            self.edges = [e for e in self.edges if e.to.kind != "in"]
            self.nodes = [n for n in self.nodes if not is_stand_in(n)]
        self.ways = {}
        for edge in self.edges:
            self.ways.setdefault((edge.node, edge.port), []).append(edge)
        self.impulses = {e.to.name for e in self.edges if e.at == "impulse"}
        self.queues = {(n.name, p): [] for n in self.nodes for p in self.ports(n)}

    # ---- rule 2: presence ------------------------------------------------------------------------

    def ports(self, node):
        return node.inputs or (("impulse",) if node.name in self.impulses else ())

    def ready(self, node):
        ports = self.ports(node)
        return bool(ports) and all(self.queues[(node.name, p)] for p in ports
                                   if p not in node.optional or node.kind == "in")

    def execute(self, entered, came):
        """Puts what enters into the queues of the gates, runs, and adds to `came` what comes out."""
        self.came = came
        for gate, entities in entered.items():
            self.queues[(gate, "in")] += entities
        waiting = {n.name for n in self.nodes if not self.ports(n)}
        while True:
            node = next((n for n in self.nodes if n.name in waiting or self.ready(n)), None)
            if not node:
                break
            if node.name in waiting:
                waiting.remove(node.name)
                self.round(node, {})
            elif node.collective:
                self.round(node, self.take(node))
            else:
                while self.ready(node):
                    self.round(node, self.take(node))
        self.gather()
        self.run.leave_waiting(self.queues)
        self.frame.pool = {}

    def take(self, node):
        taken = {}
        for port in self.ports(node):
            queue = self.queues[(node.name, port)]
            if port in node.collective:
                taken[port], queue[:] = queue[:], []
            else:
                taken[port] = [queue.pop(0)]
        return taken

    # ---- rules 3 and 4: what leaves a port -------------------------------------------------------

    def emit(self, node, port, entity):
        self.run.count_sent()
        if (node.name, port) in self.blocked:
            self.run.saw("a blocked port")
            return
        edges = self.ways.get((node, port), [])
        carried = [entity] + [entity.copy() for _ in edges[1:]]
        for edge, each in zip(edges, carried):
            self.queues[(edge.to.name, edge.at)].append(each)
            self.seen.add(each)
            self.run.saw_edge(self, edge)
        if not edges and node.kind != "in":
            self.came.setdefault((node.name, port), []).append(entity)

    def gather(self):
        """The leaf ports by node and port, behind the gates; into the gate that gathers, if there is one."""
        ports = [(node.name, port) for node in self.graph.nodes for port in node.outputs]
        leaves = {port: self.came.pop(port) for port in ports if port in self.came}
        gate = [n.name for n in self.graph.nodes if n.kind == "rest"]
        if not gate:
            self.came.update(leaves)
        elif leaves:
            self.run.saw("a gate that gathers")
            self.came.setdefault(gate[0], []).extend(sum(leaves.values(), []))

    # ---- rule 7: attributes ----------------------------------------------------------------------

    def written(self, entity):
        """What was written to this graph's attributes of an entity, which has what it had further out."""
        entity.attributes += [{} for _ in range(self.depth + 1 - len(entity.attributes))]
        self.seen.add(entity)
        return entity.attributes[self.depth]

    def read(self, entity, name):
        return self.written(entity).get(name, self.defaults[name])

    def write(self, entity, **values):
        self.written(entity).update(values)

    # ---- rounds ----------------------------------------------------------------------------------

    def round(self, node, taken):
        self.run.count_round()
        self.run.saw_round(self, node, taken)
        for entities in taken.values():
            self.seen.update(entities)
        self.frame.rounds[node.name] = self.frame.rounds.get(node.name, 0) + 1
        getattr(self, "run_" + node.kind)(node, **{"into_" + p: e for p, e in taken.items()})

    def run_in(self, node, into_in):
        for entity in into_in:
            self.emit(node, "out", entity)

    def run_out(self, node, into_in):
        for entity in into_in:
            self.came.setdefault(node.name, []).append(entity)

    run_rest = run_out

    # ---- sources: rule 8 -------------------------------------------------------------------------

    def made(self, into_impulse):
        from_whom = into_impulse[0] if into_impulse else self.impulse
        return from_whom.descendant() if from_whom else Entity([])

    def run_source(self, node, into_impulse=()):
        self.emit(node, "out", self.made(into_impulse))

    def run_impulse(self, node, into_impulse=()):
        for i in range(2):
            made = self.made(into_impulse)
            self.write(made, number=i)
            self.emit(node, "out", made)

    # ---- single nodes ----------------------------------------------------------------------------

    def run_step(self, node, into_in):
        self.write(into_in[0], steps=self.read(into_in[0], "steps") + 1)
        self.run_mark(node, into_in)

    def run_mark(self, node, into_in):
        self.write(into_in[0], trail=self.read(into_in[0], "trail") + node.letter)
        self.emit(node, "out", into_in[0])

    def run_counter(self, node, into_in):
        self.write(into_in[0], number=3 + 2 * (self.frame.rounds[node.name] - 1))
        self.emit(node, "out", into_in[0])

    def run_choice(self, node, into_in):
        self.emit(node, "yes" if self.read(into_in[0], "steps") < 5 else "no", into_in[0])

    def run_deeper(self, node, into_in):
        self.emit(node, "yes" if self.parameters["depth"] > 0 else "no", into_in[0])

    def run_odd(self, node, into_in):
        steps = self.read(into_in[0], "steps")
        port = "odd" if steps % 2 == 1 else "third" if steps % 3 == 2 else "otherwise"
        self.emit(node, port, into_in[0])

    def run_copy(self, node, into_in):
        copy = into_in[0].copy()
        self.emit(node, "out", into_in[0])
        self.emit(node, "out", copy)

    def run_share(self, node, into_in):
        for i in range(2):
            self.write(into_in[0], number=i)
            self.emit(node, "out", into_in[0])

    def run_log(self, node, into_in):
        own = [self.read(into_in[0], name) for name in ("trail", "number")]
        self.run.log.append("%s:%s,%d" % (node.letter, *own))
        self.emit(node, "out", into_in[0])

    def run_twice(self, node, into_in):
        for port in ("a", "b"):
            self.emit(node, port, into_in[0])

    def run_from(self, node, into_in, into_other):
        number = self.read(into_in[0], "number") + self.read(into_other[0], "steps")
        self.write(into_in[0], number=number)
        self.emit(node, "out", into_in[0])

    def run_swap(self, node, into_a, into_b):
        trails = self.read(into_a[0], "trail"), self.read(into_b[0], "trail")
        self.write(into_a[0], trail=trails[1])
        self.write(into_b[0], trail=trails[0])
        self.emit(node, "first", into_a[0])
        self.emit(node, "second", into_b[0])

    def run_transfer(self, node, into_in, into_from):
        self.write(into_in[0], number=self.read(into_from[0], "number"))
        self.emit(node, "out", into_in[0])
        self.emit(node, "source", into_from[0])

    # ---- collective nodes ------------------------------------------------------------------------

    def run_number(self, node, into_in):
        for i, entity in enumerate(into_in):
            self.write(entity, number=i)
            self.emit(node, "out", entity)

    def run_reverse(self, node, into_in):
        for entity in reversed(into_in):
            self.emit(node, "out", entity)

    def run_sort(self, node, into_in):
        for entity in sorted(into_in, key=lambda e: (-self.read(e, "steps"), self.read(e, "number"))):
            self.emit(node, "out", entity)

    def run_filter(self, node, into_in):
        for i, entity in enumerate(into_in):
            self.emit(node, "picked" if 1 <= i < 3 else "rest", entity)

    def run_wait(self, node, into_in, into_until):
        for entity in into_in:
            self.emit(node, "out", entity)

    def run_nearest(self, node, into_in, into_to):
        """All are in one place: the first is as near as any."""
        for entity in into_in:
            self.write(entity, number=0 if into_to else -1)
            self.emit(node, "out", entity)

    def run_combine(self, node, into_a, into_b):
        self.emit_pairs(node, [(a, b) for a in into_a for b in into_b])

    def run_pair(self, node, into_in):
        n, numbers = len(into_in), range(len(into_in))
        pairs = {"all": [(i, k) for i in numbers for k in numbers if i < k],
                 "neighbours": [(i, i + 1) for i in numbers if i + 1 < n],
                 "ring": [(i, (i + 1) % n) for i in numbers if n > 1],
                 "twos": [(i, i + 1) for i in numbers if i + 1 < n and i % 2 == 0]}
        self.emit_pairs(node, [(into_in[i], into_in[k]) for i, k in pairs[node.words["pairing"]]])

    def emit_pairs(self, node, pairs):
        for first, second in pairs:
            self.emit(node, "first", first)
            self.emit(node, "second", second)

    def run_group(self, node, into_in):
        groups = {}
        for entity in into_in:
            groups.setdefault(self.read(entity, "steps"), []).append(entity)
        for members in groups.values():
            for entity in members:
                self.write(entity, number=len(members))
            self.emit(node, "out", members[0].descendant(members))

    def run_ungroup(self, node, into_in):
        for entity in into_in[0].members:
            self.emit(node, "shape", entity)

    # ---- rule 11: content pool; rule 12: reflection ----------------------------------------------

    def run_store(self, node, into_in):
        around = self.frame.parent or self.frame
        owner = {"inside": self.frame, "around": around, "everywhere": self.frame.outermost()}
        pool = owner[node.words["reach"]].pool
        pool.setdefault(node.words["key"], []).append(into_in[0])
        self.emit(node, "out", into_in[0])

    def run_load(self, node, into_impulse=()):
        owner = self.frame
        while owner and node.words["key"] not in owner.pool:
            owner = owner.parent
        for entity in owner.pool[node.words["key"]] if owner else []:
            self.run.saw("load of something")
            self.emit(node, "shape", entity)
        if owner and node.words["take"] == "true":
            owner.pool[node.words["key"]] = []

    def run_broadcast(self, node, into_in):
        sent = self.frame.outermost().messages
        sent.setdefault(node.words["key"], []).append(into_in[0])
        self.emit(node, "out", into_in[0])

    def run_receive(self, node, into_impulse=()):
        sent = self.frame.outermost().messages.get(node.words["key"], [])
        begin = self.frame.received.get(node.name, 0)
        self.frame.received[node.name] = len(sent)
        for entity in sent[begin:]:
            self.run.saw("receive of something")
            self.emit(node, "shape", entity)

    def run_raise(self, node, into_in):
        level = self.parameters["level"] * 3 + self.read(into_in[0], "steps")
        self.parameters["level"] = level % 101
        self.emit(node, "out", into_in[0])

    def run_shut(self, node, into_in):
        self.parameters["open"] = self.read(into_in[0], "steps") % 2 == 0
        self.emit(node, "out", into_in[0])

    def run_read(self, node, into_in):
        self.write(into_in[0], number=self.parameters["level"])
        self.emit(node, "out", into_in[0])

    def run_constant(self, node, into_in):
        self.write(into_in[0], number=11 * self.parameters["level"])
        self.emit(node, "out", into_in[0])

    # ---- rule 6: encapsulation; surrogates -------------------------------------------------------

    def run_graph(self, node, **taken):
        first = [entities[0] for entities in taken.values() if entities][:1]
        links = [link.split(" ") for link in node.links.split(", ") if link]
        frame = self.frame.of(node, self.choose(node, first))
        self.hand_in(node, frame)
        for port, entities in taken.items():
            at_first = port == "into_impulse" or port == "into_" + node.inputs[0]
            for entity in entities:
                self.enter(entity, links, entity if at_first else first[0])
        waiting = {gate: taken["into_" + gate] for gate in node.inputs}
        inside, made = None, {gate: [] for gate in frame.graph.outputs()}
        for time in range(node.times):
            if time and node.loop:
                waiting = {node.loop[1]: made[node.loop[0]]}
                made[node.loop[0]] = []
            if node.index:
                frame.parameters["level"] = time
            impulse = taken.get("into_impulse", [self.impulse])[0]
            inside = Execution(self.run, frame, inside, None if node.inputs else impulse)
            inside.execute(waiting if not time or node.loop else {}, made)
        self.leave(node, links, inside, made if inside else self.pass_by(node, waiting))

    def choose(self, node, first):
        if len(node.graphs) == 1:
            return node.graphs[0]
        self.run.saw("a graph by a computed name")
        number = self.read(first[0], "steps") if node.inputs else self.parameters["level"]
        return node.graphs[number % 2]

    def hand_in(self, node, frame):
        mine = self.parameters
        values = {"level = level + 1": ("level", mine["level"] + 1),
                  "open = level % 2 == 0": ("open", mine["level"] % 2 == 0),
                  "depth = depth - 1": ("depth", mine["depth"] - 1)}
        if node.handed:
            name, value = values[node.handed]
            frame.parameters[name] = value

    def enter(self, entity, links, read):
        """What is handed in is read from the entity itself, but from the one at the first input for those
        that enter elsewhere; what is shared is its own."""
        inner = {name: self.read(read if sign == "=" else entity, to[1:])
                 for name, sign, to in links if sign != "=>"}
        self.written(entity)
        entity.attributes[self.depth + 1:] = [inner]

    def pass_by(self, node, waiting):
        """Not once: what entered where a loop ends leaves where it begins."""
        return {node.loop[0]: waiting[node.loop[1]]} if node.loop else {}

    def leave(self, node, links, inside, made):
        """What is linked is written, the graph's own attributes go, and what came to its gates moves on,
        gate by gate; what has no port of its own through the one for the rest."""
        left = [(port, entity) for port in node.outputs if port != node.rest
                for entity in made.pop(port, [])]
        left += [(node.rest, entity) for entities in made.values() for entity in entities if node.rest]
        for _, entity in left:
            for name, sign, to in links if inside else ():
                if sign != "=":
                    self.run.saw("a link " + sign)
                    self.write(entity, **{to[1:]: inside.read(entity, name)})
        self.seen |= inside.seen if inside else set()
        for entity in inside.seen if inside else [entity for _, entity in left]:
            del entity.attributes[self.depth + 1:]
        for port, entity in left:
            self.emit(node, port, entity)


class Run:
    """`log`: what log nodes said; `results`: by output, the attributes of what came out of it; `left`: how
    many entities were left waiting, by node and port; `features`: what happened."""

    def __init__(self, program):
        self.log, self.left, self.features, self.rounds, self.sent = [], {}, {"a program"}, 0, 0
        self.orders = {graph.name: order_of(graph) for graph in program.graphs}
        main, made = program.graphs[-1], {}
        execution = Execution(self, Frame(main, None), None, None)
        execution.execute({}, made)
        self.results = {port if isinstance(port, str) else "%s.%s" % port:
                        [[execution.read(e, name) for name in NAMES] for e in entities]
                        for port, entities in made.items() if entities}

    def count_round(self):
        self.rounds += 1
        if self.rounds > MOST_ROUNDS:
            raise TooLong()

    def count_sent(self):
        self.sent += 1
        if self.sent > MOST_SENT:
            raise TooLong()

    def leave_waiting(self, queues):
        for (node, port), queue in queues.items():
            if queue:
                self.saw("entities left waiting")
                key = "%s.%s" % (node, port)
                self.left[key] = self.left.get(key, 0) + len(queue)

    # ---- what happened ---------------------------------------------------------------------------

    def saw(self, feature):
        self.features.add(feature)

    def saw_round(self, execution, node, taken):
        self.saw(node.kind if node.kind != "graph" else node.procedure or "encapsulation")
        if node.collective and set(node.collective) != set(node.inputs):
            self.saw("a mixed node")
        if any(p in node.optional and not entities for p, entities in taken.items()):
            self.saw("an optional input without entities")
        if execution.frame.parent and execution.frame.parent.graph is execution.graph:
            self.saw("a graph in itself")
        if node.name in execution.impulses:
            self.saw("an impulse")
        if node.kind == "graph" and node.loop and node.times > 1:
            self.saw("a loop of iterate")

    def saw_edge(self, execution, edge):
        if edge.way:
            self.saw("a conditional edge")
        rank = execution.nodes.index
        if rank(edge.to) > rank(edge.node):
            return
        self.saw("a cycle")
        span = execution.nodes[rank(edge.to):rank(edge.node) + 1]
        if any(n.kind == "graph" for n in span):
            self.saw("a cycle through a graph")
        if execution.frame.parent:
            self.saw("a cycle in a graph")
        if any(e is not edge and e.node in span and e.to in span and rank(e.to) <= rank(e.node)
               for e in execution.edges):
            self.saw("nested cycles")
