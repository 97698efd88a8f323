"""Rule 1: the order of a graph's nodes, as the rule and the fine print behind it are written, by trying
everything. A demand is a pair of nodes, of which the first is to come before the second."""


def edges_that_count(graph):
    """All but disabled ones; by node in order of appearance, by port, by line."""
    return [e for node in graph.nodes for port in node.outputs for e in graph.edges
            if (e.node, e.port) == (node, port) and e.way != "disabled"]


def cyclic_edges(graph):
    """Those that lead back to where a depth-first search came through."""
    edges, cyclic, path, done = edges_that_count(graph), [], [], set()

    def search(node):
        path.append(node)
        for edge in edges:
            if edge.node is not node:
                continue
            if edge.to in path:
                cyclic.append(edge)
            elif edge.to not in done:
                search(edge.to)
        done.add(path.pop())

    for node in graph.nodes:
        if node not in done:
            search(node)
    return cyclic


def leads(demands, first, last):
    """Whether the demands already say that `first` comes before `last`."""
    reached = [first]
    for node in reached:
        reached += [b for a, b in demands if a is node and b not in reached]
    return last in reached


def demands_of(graph, edges):
    """In the order of their weight; one that contradicts an earlier one is void."""
    wanted = [(e.node, e.to) for e in edges]
    for node in graph.nodes:
        ports = [[e.to for e in edges if (e.node, e.port) == (node, port)] for port in node.outputs]
        ports = [p for p in ports if p]
        for earlier, later in zip(ports, ports[1:]):
            wanted += [(a, b) for a in earlier for b in later]
    for node in graph.nodes:
        for port in node.inputs or ("impulse",):
            feeders = [e.node for e in graph.edges if (e.to, e.at) == (node, port) and e in edges]
            wanted += zip(feeders, feeders[1:])
    demands = []
    for first, last in wanted:
        if first is not last and not leads(demands, last, first):
            demands.append((first, last))
    return demands


def order_of(graph):
    """The nodes in order. `piles` hold what has become possible, what the last node's first port made
    possible on top; where nothing there may come next, it falls to what lies below."""
    cyclic = cyclic_edges(graph)
    edges = [e for e in edges_that_count(graph) if e not in cyclic]
    demands, order = demands_of(graph, edges), []
    piles = [[n for n in graph.nodes if all(e.to is not n for e in edges)]]

    def may_come(node):
        return all(a in order for a, b in demands if b is node)

    while len(order) < len(graph.nodes):
        possible = [n for n in graph.nodes if n in piles[-1] and may_come(n)]
        if not possible:
            left = piles.pop()
            piles[-1] += left
            continue
        node = possible[0]
        piles[-1].remove(node)
        order.append(node)
        made = {}
        for edge in [e for e in edges if e.node is node]:
            if all(e.node in order for e in edges if e.to is edge.to):
                made[edge.to] = edge.port
        ports = [p for p in node.outputs if any((e.node, e.port) == (node, p) for e in edges)]
        if len(ports) > 1:
            piles += [[n for n in made if made[n] == port] for port in reversed(ports)]
        else:
            piles[-1] += made
    return order
