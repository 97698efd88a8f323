# trace and profile: their forms, what stops them, and that a trace is the same each time.
. "$ROOT/tests/tool/expect.inc"

cat >row.pcg <<'END'
graph row {
    param count: int = 3
    rectangle(width = 4m) -> copies: copy(count = count) -> part: tower(levels = 2)
    part -> a: color(color = #ff0000)
    part -> b: color(color = #00ff00)
}
graph tower {
    param levels: int = 1
    in base: Shape = rectangle()
    out top: Shape
    base -> up: extrude(amount = 3m * levels) -> top
    up.out -> height: log(message = "up")
}
END
printf 'graph bad { rectangle() -> assert(area(in) > 9m2, "small") }\n' >bad.pcg

# ---- lines ----
run "$PCGC" trace row.pcg -p count=2
expect_code 0 "trace"
expect_out '"node":"copies","number":1,"procedure":"copy","graph":"row","line":3,"inside":null,"inputs":{"in":[1]},"parameters":{"count":2,'
expect_out '"copy_of":'
cp "$out" first.ndjson
run "$PCGC" trace row.pcg -p count=2 -o second.ndjson
expect_empty "$out" "with -o nothing goes to stdout"
expect "the same bytes each time" cmp first.ndjson second.ndjson
cat >lines.py <<'PY'
import json, sys
rounds = {}
for line in open(sys.argv[1]):
    r = json.loads(line)
    assert r["round"] not in rounds
    rounds[r["round"]] = r
assert sorted(rounds) == list(range(1, len(rounds) + 1))
made = set()
for number in sorted(rounds):
    r = rounds[number]
    assert r["inside"] is None or r["inside"] < number
    if r["inside"] is not None:
        assert rounds[r["inside"]]["procedure"] == r["graph"]
PY
expect "every line is JSON, every round is there once, inside one that began before" python3 lines.py first.ndjson

# ---- for a viewer ----
run "$PCGC" trace row.pcg -o rounds.json
expect_code 0 "trace for a viewer"
cat >nest.py <<'PY'
import json
depth = last = count = 0
for e in json.load(open("rounds.json"))["traceEvents"]:
    depth += {"B": 1, "E": -1}[e["ph"]]
    count += e["ph"] == "B"
    assert depth >= 0 and e["ts"] >= last
    last = e["ts"]
assert depth == 0 and count > 10
PY
expect "it parses, events nest, time does not run backwards" python3 nest.py

# ---- profile ----
run "$PCGC" profile row.pcg --stacks stacks
expect_code 0 "profile"
expect_out "tower/up "
expect "stacks name the way down" grep -q '^run;part;up [0-9]*$' stacks
run "$PCGC" profile row.pcg --json
cat >sums.py <<'PY'
import json, sys
p = json.load(open(sys.argv[1]))
nodes = {n["node"]: n for n in p["nodes"]}
assert nodes["up"]["rounds"] == 3 and nodes["part"]["in"] == 3 and nodes["copies"]["out"] == 3
graphs = {g["graph"]: g for g in p["graphs"]}
assert graphs["tower"]["rounds"] == sum(n["rounds"] for n in p["nodes"] if n["graph"] == "tower")
assert all(0 <= n["own"] <= n["total"] + 1e-9 for n in p["nodes"])
PY
expect "rounds, entities and sums are right" python3 sums.py "$out"
cat >shrink.pcg <<'END'
graph shrink {
    attr n: int
    rectangle() -> copy(count = 20000, index => @n) -> translate(x = 2m * @n) -> merge() -> small: box()
}
END
run "$PCGC" profile shrink.pcg --json
cat >shrunk.py <<'PY'
import json, sys
nodes = {n["node"]: n["memory"] for n in json.load(open(sys.argv[1]))["nodes"]}
assert -2**28 < nodes["small"] < 0 < nodes["merge"] < 2**28, nodes
PY
expect "what a node gives back is less than nothing" python3 shrunk.py "$out"

# ---- paths ----
run "$PCGC" run row.pcg --json --entities
expect_out '"path":["rectangle.out","copies.out","tower/up.out","part.top","a.out"]'
run "$PCGC" run row.pcg --json
expect "without --entities no path" test "$(grep -c '"path"' "$out")" = 0

# ---- what goes wrong ----
run "$PCGC" trace bad.pcg -o bad.ndjson
expect_code 3 "a run that fails"
expect "is traced as far as it came" grep -q '"node":"rectangle"' bad.ndjson
run "$PCGC" trace row.pcg --max-rounds 3
expect_code 4 "a limit"
expect_out '"round":1,'
run "$PCGC" trace row.pcg -o missing/x.ndjson
expect_code 2 "a folder that is not there"
expect_err "cannot write 'missing/x.ndjson'"
run "$PCGC" trace row.pcg --format xml
expect_code 2 "an unknown format"
run "$PCGC" trace
expect_code 2 "no file"
expect_err "which file?"
run "$PCGC" row.pcg -o row.so
run "$PCGC" profile row.so
expect_code 2 "a compiled graph"
expect_err "it needs the source"
printf 'graph wrong { lgo() }\n' >wrong.pcg
run "$PCGC" trace wrong.pcg -o wrong.ndjson
expect_code 1 "errors in the source"
expect "leave no file" test ! -e wrong.ndjson -a -z "$(ls | grep part)"
done_testing
